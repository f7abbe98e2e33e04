// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/motor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "device/simulated/model.h"

namespace forceshade::device {
namespace {

const Motor kMotor = premium_1_5().motor;
const Eigen::Vector3d kGears{13.3, 11.2, 11.2};
const Eigen::Vector3d kStall = Eigen::Vector3d::Constant(kMotor.stall);

TEST(motor, shortens_what_is_too_much_and_keeps_its_direction) {
  Motor fine = kMotor;
  fine.amplifier_bits = 0;
  const Joints small{1, -0.5, 0.25}, large{5, -2.5, 1.25};
  EXPECT_LE((delivered(fine, kGears, kStall, small) - small).norm(), 1e-15);
  const Joints most = delivered(fine, kGears, kStall, large);
  EXPECT_NEAR(most[0], kMotor.stall * 13.3, 1e-15);
  EXPECT_LE((most.normalized() - large.normalized()).norm(), 1e-15);
}

TEST(motor, gives_nothing_at_a_limit_of_nothing) {
  EXPECT_EQ(delivered(kMotor, kGears, {0, 1, 1}, {1, 1, 1}), Joints(0, 0, 0));
  EXPECT_NE(delivered(kMotor, kGears, {0, 1, 1}, {0, 1, 1}), Joints(0, 0, 0));
}

TEST(motor, rounds_to_the_amplifiers_steps) {
  const double step = 2 * kMotor.stall * 13.3 / 4096;
  for (int i = -300; i <= 300; ++i) {
    const double wanted = 0.00413 * i;
    const double got = delivered(kMotor, kGears, kStall, {wanted, 0, 0})[0];
    EXPECT_LE(std::abs(got - wanted), step / 2 * (1 + 1e-12));
    EXPECT_NEAR(got / step, std::round(got / step), 1e-9);
  }
  EXPECT_EQ(delivered(kMotor, kGears, kStall, {0.49 * step, 0, 0})[0], 0);
}

TEST(motor, at_its_continuous_torque_ends_at_the_highest_temperature) {
  Heat heat;
  for (int second = 0; second < 20'000; ++second) heat = heated(kMotor, heat, kMotor.continuous, 1);
  EXPECT_NEAR(heat.total(), 1, 1e-9);
  EXPECT_NEAR(heat.winding, 3.1 / 17.1, 1e-12);
}

TEST(motor, warms_and_cools_with_two_time_constants) {
  const Heat after = heated(kMotor, {}, kMotor.continuous, 12);
  EXPECT_NEAR(after.winding, (1 - std::exp(-1)) * 3.1 / 17.1, 1e-12);
  EXPECT_NEAR(after.housing, (1 - std::exp(-12.0 / 612)) * 14 / 17.1, 1e-12);
  const Heat cooled = heated(kMotor, {0.2, 0.5}, 0, 612);
  EXPECT_NEAR(cooled.housing, 0.5 * std::exp(-1), 1e-12);
  // Steps of a period make no difference to the whole.
  Heat small;
  for (int i = 0; i < 12'000; ++i) small = heated(kMotor, small, kMotor.continuous, 1e-3);
  EXPECT_NEAR(small.total(), after.total(), 1e-12);
}

TEST(motor, gives_less_when_warm) {
  EXPECT_EQ(torque_limit(kMotor, {}), kMotor.stall);
  EXPECT_EQ(torque_limit(kMotor, {0.4, 0.5}), kMotor.stall);
  EXPECT_LT(torque_limit(kMotor, {0.45, 0.5}), kMotor.stall);
  EXPECT_NEAR(torque_limit(kMotor, {0.5, 0.5}), kMotor.continuous, 1e-15);
  EXPECT_EQ(torque_limit(kMotor, {0.5, 0.6}), 0);
}

}  // namespace
}  // namespace forceshade::device
