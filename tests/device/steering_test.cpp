// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/steering.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "device/simulated/simulated.h"
#include "forceshade/device.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using Eigen::Vector3d;

constexpr double kPeriod = 1e-3;

// Has a mouse and nothing else.
struct Mouse final : Attendant {
  Steering* steering() noexcept override { return &hand; }
  Steering hand;
};

TEST(steering, rests_where_it_starts_until_it_is_aimed) {
  Steering steering({1, 2, 3});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(steering.next(kPeriod).position, Vector3d(1, 2, 3));
}

TEST(steering, reaches_its_aim_smoothly_and_never_faster_than_a_hand) {
  for (const double leap : {1.0, 10.0, 200.0}) {
    Steering steering({0, 0, 0});
    steering.next(kPeriod);
    steering.aim({leap, 0, 0});
    Target last{};
    double fastest = 0, roughest = 0, most = 0;
    for (int i = 0; i < 2000; ++i) {
      const Target now = steering.next(kPeriod);
      fastest = std::max(fastest, (now.position - last.position).norm() / kPeriod);
      roughest = std::max(roughest, ((now.position - last.position) / kPeriod - now.velocity).norm());
      most = std::max(most, now.position.x());
      last = now;
    }
    EXPECT_NEAR(last.position.x(), leap, 1e-9);
    EXPECT_LE(most, leap * (1 + 1e-12)) << "it does not overshoot";
    EXPECT_LE(fastest, Steering::kFastestSteered * (1 + 1e-9));
    // Half of what the largest acceleration changes in a period.
    EXPECT_LE(roughest, 0.5 * 30 * 30 * leap * kPeriod) << "its velocity is that of its path";
  }
}

TEST(steering, follows_a_leap_as_a_critically_damped_mass_does) {
  Steering steering({0, 0, 0});
  steering.next(kPeriod);
  steering.aim({0, 0, -1});
  for (int tick = 1; tick <= 300; ++tick) {
    const double t = 30 * kPeriod * tick;
    EXPECT_NEAR(steering.next(kPeriod).position.z(), -1 + (1 + t) * std::exp(-t), 1e-12);
  }
}

TEST(steering, stays_within_reach_and_ignores_what_is_no_place) {
  Steering steering({0, 0, 500});
  steering.stay_within({100, 50, 20});
  EXPECT_EQ(steering.next(kPeriod).position, Vector3d(0, 0, 20));
  steering.aim({1000, -1000, 0});
  steering.aim({NAN, 0, 0});
  steering.aim({0, HUGE_VAL, 0});
  Target target{};
  for (int i = 0; i < 3000; ++i) target = steering.next(kPeriod);
  EXPECT_LE((target.position - Vector3d(100, -50, 0)).norm(), 1e-9);
}

TEST(steering, is_refused_where_nobody_steers) {
  for (const char* name : {"mouse", "mouse:omni", "simulated:omni:mouse"})
    EXPECT_EQ(tests::thrown_by<Error>([&] { open_device(name); }),
              "the mouse as a device: expected a window in which it steers a hand, as 'forceshade drive' has; got none");
}

TEST(steering, takes_the_models_that_can_be_simulated_and_no_other) {
  Mouse mouse;
  EXPECT_EQ(open_device("mouse", mouse)->capabilities().model, open_device("simulated")->capabilities().model);
  EXPECT_EQ(open_device("mouse:omni", mouse)->capabilities().model, "omni");
  EXPECT_THROW(open_device("mouse:trackball", mouse), Error);
}

TEST(steering, by_another_thread_while_the_loop_runs_trips_nothing) {
  Mouse mouse;
  const auto device = open_device("simulated:premium-1.5:mouse", mouse);
  std::atomic<bool> stop = false;
  std::thread hand([&] {
    for (int i = 0; !stop; ++i) {
      const double side = i % 2 == 0 ? 1 : -1;
      mouse.hand.aim({60 * side, 30 * side, i % 3 == 0 ? -30.0 : 30.0});
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  });
  const Kept run(*device, wall(), {.max_seconds = 5, .paced = false});
  stop = true;
  hand.join();
  EXPECT_EQ(run.end_reason, EndReason::time_up) << (run.trip ? name_of(run.trip->rule) : "");
}

}  // namespace
}  // namespace forceshade::device
