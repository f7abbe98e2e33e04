// SPDX-License-Identifier: BSD-3-Clause
// A servo loop and a device with a clock of its own: which positions are used, how often, and when the forces come.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "device/simulated/arm.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "system/system.h"
#include "tests/device/stand_in_hd/phantom_fixture.h"
#include "tests/support/kept_samples.h"

namespace forceshade::device {
namespace {

using Numbers = std::array<float, 3>;

Numbers in_law(const Eigen::Vector3d& v) {
  const Eigen::Vector3f turned = turned_to_law(v).cast<float>();
  return {turned.x(), turned.y(), turned.z()};
}

struct Paced {
  ServoResult result;
  std::vector<Sample> samples;
  std::vector<stand_in_hd::Frame> frames;
  std::size_t repeated = 0, skipped = 0;  // positions, between the first that was used and the last
  std::vector<std::size_t> lags;          // frames from a position to its force, sorted
};

// A hand that strokes into a wall and out again.
Paced paced(double frame_hz, bool follows) {
  tell({.frame_hz = frame_hz});
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  tests::KeptSamples kept;
  Paced it;
  {
    Phantom device("", kPatient);
    it.result =
        run_servo_loop(device, law, {.max_seconds = 0.9, .follows_device = follows, .watchdog_timeout = 10, .sinks = {&kept}},
                       std::atomic<bool>(false));
  }
  it.samples = std::move(kept.samples);
  it.samples.pop_back();  // the zero force that ends the run
  it.frames = seen().frames;
  std::set<double> times;
  for (const Sample& sample : it.samples) times.insert(sample.device_time);
  it.repeated = it.samples.size() - times.size();

  // The frame of each position: the next that has it.
  std::size_t next = 0, used = 0, first = 0;
  double last = -1;
  for (const Sample& sample : it.samples) {
    if (sample.device_time == last) continue;
    last = sample.device_time;
    while (next < it.frames.size() && in_law(it.frames[next].position) != sample.position) ++next;
    if (used++ == 0) first = next;
    ++next;
  }
  EXPECT_LE(next, it.frames.size()) << "a position that no frame gave";
  it.skipped = next - first - used;

  std::set<std::pair<Numbers, Numbers>> commanded;
  for (const Sample& sample : it.samples) commanded.emplace(sample.position, sample.force);
  for (std::size_t k = 0; k < it.frames.size(); ++k) {
    if (it.frames[k].force.isZero(0)) continue;
    std::size_t lag = 1;
    while (lag < k && !commanded.contains({in_law(it.frames[k - lag].position), in_law(it.frames[k].force)})) ++lag;
    EXPECT_LT(lag, k) << "frame " << k << " sent a force that no position explains";
    it.lags.push_back(lag);
  }
  std::sort(it.lags.begin(), it.lags.end());
  return it;
}

void print(const char* what, double frame_hz, const Paced& it) {
  std::printf(
      "  %4.0f frames/s, paced by the %s: %zu ticks, %zu positions repeated, %zu skipped; a force is sent %zu frames after its "
      "position (median), %zu (99 %%)\n",
      frame_hz, what, it.samples.size(), it.repeated, it.skipped, it.lags[it.lags.size() / 2],
      it.lags[it.lags.size() * 99 / 100]);
}

TEST_F(phantom, frames_are_followed_one_tick_each_at_whatever_rate_they_come) {
  for (const double frame_hz : {977.0, 1000.0, 1013.0}) {
    SCOPED_TRACE(frame_hz);
    stand_in_hd::reset();
    const Paced it = paced(frame_hz, true);
    EXPECT_EQ(it.result.end_reason, EndReason::time_up) << it.result.fault;
    EXPECT_TRUE(it.result.supervised);
    EXPECT_TRUE(it.result.followed_device);
    EXPECT_GE(it.result.peak_force_N, 0.1);
    EXPECT_EQ(it.repeated, 0U);
    // A busy machine keeps the loop waiting while frames go by, but not for most of them.
    EXPECT_LT(it.skipped, it.samples.size());
    ASSERT_GE(it.lags.size(), 100U);
    EXPECT_EQ(it.lags[it.lags.size() / 2], 1U);
    print("device", frame_hz, it);
  }
}

// The two clocks beat: some 23 ticks a second see a position that another has seen.
TEST_F(phantom, frames_that_are_slower_than_this_machines_clock_are_used_twice_where_the_loop_follows_that) {
  const Paced it = paced(977, false);
  EXPECT_FALSE(it.result.followed_device);
  EXPECT_GE(it.repeated, 10U);
  ASSERT_GE(it.lags.size(), 100U);
  print("clock", 977, it);
}

}  // namespace
}  // namespace forceshade::device
