// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "device/simulated/friction.h"

namespace forceshade::device {
namespace {

// Joints 2 and 3 strongly coupled: more than any PHANToM's.
const Eigen::Matrix3d kMass{{2, 0, 0}, {0, 3, 1.5}, {0, 1.5, 2}};
const Joints kCoulomb{1, 2, 3};
const Joints kRest{0, 0, 0};

TEST(friction, holds_a_joint_up_to_its_limit_and_not_beyond) {
  EXPECT_EQ(slip_of(kMass, {0.999, 0, 0}, kRest, kCoulomb), Slip(0, 0, 0));
  EXPECT_EQ(slip_of(kMass, {1.001, 0, 0}, kRest, kCoulomb), Slip(1, 0, 0));
  EXPECT_EQ(slip_of(kMass, {-1.001, 0, 0}, kRest, kCoulomb), Slip(-1, 0, 0));
}

TEST(friction, opposes_a_joint_that_moves) {
  EXPECT_EQ(slip_of(kMass, {50, 0, 0}, {-1e-12, 0, 0}, kCoulomb), Slip(-1, 0, 0));
  EXPECT_EQ(acceleration(kMass, kRest, {-1, 0, 0}, kCoulomb), Joints(0.5, 0, 0));
}

TEST(friction, of_a_resting_joint_carries_what_its_neighbour_pushes_through_the_mass) {
  // Joint 2 accelerates at (14 - 2)/3 = 4 if joint 3 stays, which takes 1.5 · 4 = 6 N·m: more than its 3.
  EXPECT_EQ(slip_of(kMass, {0, 14, 0}, kRest, kCoulomb), Slip(0, 1, -1));
  // 2 · 1.5 = 3 just breaks it loose; half of that does not.
  EXPECT_EQ(slip_of(kMass, {0, 5, 0}, kRest, kCoulomb), Slip(0, 1, 0));
}

TEST(friction, never_holds_a_joint_that_has_none) {
  for (const double torque : {-1.0, 0.0, 1e-300, 1.0}) EXPECT_NE(slip_of(kMass, {torque, 0, 0}, kRest, {0, 2, 3})[0], 0);
  EXPECT_EQ(stopped_where_reversed(kMass, {-1, 0, 0}, {1, 0, 0}, {0, 2, 3}), Joints(-1, 0, 0));
}

// The laws of friction, whatever the torque: a joint that sticks is not pulled beyond its limit; one that slips from rest
// is accelerated the way of its slip.
TEST(friction, of_three_joints_at_once_obeys_its_law_at_each) {
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> size(-8, 8);
  std::uniform_int_distribution<int> way(-2, 2);
  std::array<int, 27> seen{};
  for (int i = 0; i < 100'000; ++i) {
    const Joints torque{size(bits), size(bits), size(bits)};
    Joints velocity;
    for (double& v : velocity) v = std::max(-1, std::min(1, way(bits) / 2));
    const Slip slip = slip_of(kMass, torque, velocity, kCoulomb);
    const Joints a = acceleration(kMass, torque, slip, kCoulomb);
    const Joints friction = kMass * a - torque;
    for (int j = 0; j < 3; ++j) {
      if (velocity[j] != 0) {
        ASSERT_EQ(slip[j], velocity[j]);
      } else if (slip[j] == 0) {
        ASSERT_EQ(a[j], 0);
        ASSERT_LE(std::abs(friction[j]), kCoulomb[j] * (1 + 1e-9));
      } else {
        ASSERT_GE(a[j] * slip[j], -1e-9);
      }
    }
    ++seen[static_cast<std::size_t>(slip[0] + 1 + 3 * (slip[1] + 1) + 9 * (slip[2] + 1))];
  }
  for (std::size_t k = 0; k < 27; ++k) EXPECT_GT(seen[k], 0) << k;
}

TEST(friction, stops_a_joint_that_reversed_and_takes_energy_doing_so) {
  const Joints velocity{1, -0.5, 2};
  const Joints stopped = stopped_where_reversed(kMass, velocity, {1, 1, 1}, kCoulomb);
  EXPECT_EQ(stopped[0], 1);
  EXPECT_EQ(stopped[1], 0);
  EXPECT_EQ(stopped[2], (kMass * velocity)[2] / kMass(2, 2));  // joint 3 keeps its momentum
  EXPECT_LT(stopped.dot(kMass * stopped), velocity.dot(kMass * velocity));
  EXPECT_EQ(stopped_where_reversed(kMass, velocity, {1, -1, 1}, kCoulomb), velocity);
}

}  // namespace
}  // namespace forceshade::device
