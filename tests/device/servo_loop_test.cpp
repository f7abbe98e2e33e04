// SPDX-License-Identifier: BSD-3-Clause
// A run of the servo loop: forces, energy, how it ends, and what it requests of the device.

#include "forceshade/servo_loop.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "rendering/control_words.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

using tests::vector;

TEST(servo_loop, commands_the_force_of_every_recorded_position) {
  const auto law = law_of(LawId::bump_2p_shaded, 0.5F);
  std::vector<Eigen::Vector3f> positions;
  for (int i = -40; i <= 40; ++i) positions.emplace_back(0.5F * static_cast<float>(i), 1.0F, 0.1F * static_cast<float>(i % 7));
  Replay replay(path_of(positions));
  const Kept result(replay, law, unpaced());

  EXPECT_EQ(result.end_reason, EndReason::end_of_data);
  EXPECT_FALSE(result.supervised);
  ASSERT_EQ(result.ticks, positions.size());
  for (std::size_t k = 0; k < result.ticks; ++k) {
    const Sample& sample = result.samples[k];
    EXPECT_EQ(sample.tick, k);
    EXPECT_EQ(vector(sample.position), positions[k]);
    EXPECT_EQ(sample.device_time, 0.001 * static_cast<double>(k));
    EXPECT_EQ(vector(sample.force), law.force(positions[k]));
    EXPECT_EQ(sample.law_force, sample.force);
    EXPECT_EQ(sample.status, static_cast<int>(law.evaluate(positions[k]).status));
    EXPECT_GE(sample.compute_ns, 0);
    EXPECT_EQ(sample.wakeup_ns, 0) << "nothing is due";
  }
  expect_ends_at_zero_force(result);
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(0, 0, 0));
  EXPECT_GT(result.achieved_rate_hz, 0);
  EXPECT_LE(result.compute_us.p50, result.compute_us.p99);
  EXPECT_LE(result.compute_us.p99, result.compute_us.p999);
  EXPECT_LE(result.compute_us.p999, result.compute_us.p9999);
  EXPECT_LE(result.compute_us.p9999, result.compute_us.max);
  EXPECT_LE(result.compute_us.max, result.tick_us.max);
  EXPECT_TRUE(result.wakeup_us.histogram.empty());
}

// A count that the device no longer gives is absent, and not the one before.
TEST(servo_loop, records_the_counts_of_the_encoders_where_its_device_gives_them) {
  auto path = path_of({{0, 0, -1}, {0, 0, -1}});
  for (Reading& reading : path) reading.encoder = {7, -8, 9};
  path[1].encoder.reset();
  Replay replay(path);
  const Kept result(replay, wall(), unpaced());
  EXPECT_EQ(result.samples[0].encoder, (std::array<std::int64_t, 3>{7, -8, 9}));
  EXPECT_EQ(result.samples[1].encoder, Sample{}.encoder);
}

// By hand, K = 0.5 N/mm. Forces held, in N along z: 0, 0.5, 1, 1.5, 0.5, 0. Steps along z, in mm: -2, -1, -1, +2, +3.
// Work in mJ: 0, -0.5, -1, +3, +1.5.
TEST(servo_loop, counts_the_energy_of_a_held_force) {
  Replay replay(path_of({{0, 0, 1}, {5, 0, -1}, {-3, 2, -2}, {-3, 2, -3}, {0, 0, -1}, {9, 9, 2}}));
  const Kept result(replay, wall(), unpaced());
  EXPECT_EQ(result.energy_given_mJ(), 4.5);
  EXPECT_EQ(result.energy_taken_mJ(), 1.5);
  std::vector<double> energies;
  for (const Sample& sample : result.samples) energies.push_back(sample.energy);
  EXPECT_EQ(energies, (std::vector<double>{0, 0, -0.5, -1.5, 1.5, 3, 3}));
  EXPECT_EQ(result.peak_force_N, 1.5);
  EXPECT_EQ(result.invalid_positions, 0U);
}

// The step into z = NaN is counted as the longest there is, 1 mm at 1 kHz, straight along 1 N, and so is the one out of z = -1
// into 2e4, which no law answers, with 0.5 N. The one from z = -2 to z = -1 gives 1 N times 1 mm.
TEST(servo_loop, counts_invalid_positions_and_goes_on) {
  const float nan = std::nanf("");
  Replay replay(path_of({{0, 0, -2}, {0, 0, nan}, {0, 0, -2}, {0, 0, -1}, {2e4F, 0, -1}, {0, 0, -1}}));
  const Kept result(replay, wall(), unpaced());
  EXPECT_EQ(result.ticks, 6U);
  EXPECT_EQ(result.invalid_positions, 2U);
  EXPECT_EQ(vector(result.samples[1].force), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(vector(result.samples[4].force), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(result.energy_given_mJ(), 2);
  EXPECT_EQ(result.energy_taken_mJ(), 0);
}

// A god-object that uses up its moves in three ticks, in which its force is too large.
TEST(servo_loop, counts_unfinished_ticks_and_holds_their_force) {
  struct Lagging final : fast::Session {
    fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
      if (position.z() > 0) return {};
      const bool lags = touching >= 1000 && touching < 1003;
      ++touching;
      return {{0, 0, lags ? 5.0F : 0.125F}, lags ? Status::unfinished : Status::contact};
    }
    int touching = 0;
  } session;
  class Long final : public Pushing {
  } device;
  tests::KeptSamples kept;
  ServoOptions options{.max_seconds = 1.2, .paced = false};
  options.sinks.push_back(&kept);
  const ServoResult result = run_servo_loop(device, session, options, kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::time_up);
  EXPECT_EQ(result.unfinished_ticks, 3U);
  EXPECT_EQ(result.limited_ticks[static_cast<std::size_t>(Rule::unfinished)], 3U);
  EXPECT_LE(result.peak_force_N, 0.1251);
  std::size_t held = 0;
  for (const Sample& sample : kept.samples)
    if ((sample.limited >> Rules::bit_of(Rule::unfinished) & 1U) != 0) held += sample.law_force[2] == 5 ? 1U : 0U;
  EXPECT_EQ(held, 3U);
}

TEST(servo_loop, counts_the_ticks_without_forces_and_the_fades_that_its_device_reports) {
  struct Fading final : Pushing {
    Fading(std::size_t off_from, std::size_t off_to) : from(off_from), to(off_to) {}
    State state() const noexcept override {
      const bool is_off = read >= from && read < to;
      return {.forces_on = !is_off, .forces_off = is_off ? "its power is off" : ""};
    }
    ReadResult at(std::size_t reading) noexcept override {
      read = reading;
      Reading its = place(reading);
      its.sent = Sent{.fades = static_cast<int>(reading) / 100, .faded = 0.001 * static_cast<double>(reading)};
      return its;
    }
    std::size_t from, to, read = 0;
  };
  struct Case {
    std::size_t from, to, ticks;
    const char* words;  // at the end
  };
  for (const Case& its : {Case{1000, 1000, 0, nullptr}, {0, 40, 40, nullptr}, {390, 400, 10, "its power is off"}}) {
    Fading device(its.from, its.to);
    const Kept run(device, wall(), {.max_seconds = 0.4, .paced = false});
    ASSERT_EQ(run.ticks, 400U);
    EXPECT_EQ(run.forces_off_ticks, its.ticks);
    EXPECT_STREQ(run.forces_off, its.words);
    EXPECT_EQ(run.fades, 3);
    EXPECT_DOUBLE_EQ(run.faded, 0.399);
  }
}

TEST(servo_loop, runs_for_the_nearest_whole_number_of_ticks_and_at_least_one) {
  Endless device;
  for (const auto& [seconds, rate, ticks] : {std::tuple{1e-9, 1000.0, 1U}, std::tuple{0.29, 1000.0, 290U},
                                             std::tuple{0.57, 100.0, 57U}, std::tuple{0.0126, 100.0, 1U}})
    EXPECT_EQ(run_servo_loop(device, wall(), {.rate_hz = rate, .max_seconds = seconds, .paced = false}, kNeverStop).ticks,
              ticks)
        << seconds;
  EXPECT_EQ(device.rates, (std::vector<double>{1000, 1000, 100, 100})) << "it is started once in each run";
}

TEST(servo_loop, reads_nothing_when_stopped_before_it_starts) {
  Endless device;
  const std::atomic<bool> stop = true;
  const Kept result(device, wall(), {.max_seconds = 0.5}, stop);
  EXPECT_EQ(result.ticks, 0U);
  EXPECT_EQ(device.commands.size(), 1U);
  EXPECT_TRUE(std::isnan(result.samples.back().position[2]));
  expect_ends_at_zero_force(result);
}

// The code of a device, or of its driver, runs in the loop's thread.
TEST(servo_loop, ends_where_its_device_has_changed_the_arithmetic) {
  struct Meddling final : Still {
    ReadResult at(std::size_t reading) noexcept override {
      ControlWords words = control_words();
      if (reading == 5) words.mxcsr |= 0x6000;  // towards 0
      set_control_words(words);
      return here();
    }
  } device;
  const KeptControlWords before;
  const Kept result(device, wall(), {.max_seconds = 0.01, .paced = false});
  EXPECT_EQ(result.ticks, 5U);
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, fast::arithmetic_fault());
  expect_ends_at_zero_force(result);
}

// Without it the device may go on pushing: a refusal is reported, whatever else has ended the run.
TEST(servo_loop, reports_a_device_that_refuses_the_zero_force_at_the_end) {
  struct Stubborn final : Still {
    ReadResult at(std::size_t) noexcept override { return here(); }
    std::optional<Fault> on_command() noexcept override {
      if (!commands.back().isZero(0)) return std::nullopt;
      return Fault{"the device does not answer"};
    }
  } device;
  const Kept result(device, wall(), {.max_seconds = 0.01, .paced = false});
  EXPECT_EQ(result.ticks, 10U);
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, "the device does not answer");
}

}  // namespace
}  // namespace forceshade::device
