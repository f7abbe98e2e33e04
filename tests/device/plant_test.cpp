// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/plant.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "device/simulated/model.h"

namespace forceshade::device {
namespace {

const Joints kResetPose{0, 0, 0};

constexpr double kTick = 1e-3;  // s
constexpr int kSteps = 20;      // to a tick: 20 kHz

Plant free_arm() {
  return {premium_1_5().arm, Joints::Zero(), Joints::Zero(), std::nullopt};
}

// As a share of the kinetic energy that it began with.
TEST(plant, keeps_the_energy_of_the_free_arm_to_1e_9_for_ten_seconds) {
  const Plant plant = free_arm();
  Motion motion{.angles = {0.2, 0.3, -0.1}, .velocity = {4, -3, 5}};
  const double begin = plant.arm.energy(motion.angles, motion.velocity);
  const double kinetic = begin - plant.arm.energy(motion.angles, Joints::Zero());
  double worst = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    motion = plant.advanced(motion, Joints::Zero(), {}, kTick, kSteps);
    worst = std::max(worst, std::abs(plant.arm.energy(motion.angles, motion.velocity) - begin) / kinetic);
  }
  EXPECT_LE(worst, 1e-9);
}

TEST(plant, a_motor_gives_the_work_of_its_torque) {
  Plant plant = free_arm();
  Motion motion{.angles = {0, 0.1, -0.1}};
  const Joints torque{0.01, 0.02, -0.005};
  const double begin = plant.arm.energy(motion.angles, motion.velocity);
  const Joints from = motion.angles;
  motion = plant.advanced(motion, torque, {}, 0.2, 4000);
  EXPECT_NEAR(plant.arm.energy(motion.angles, motion.velocity) - begin, torque.dot(motion.angles - from), 1e-12);
}

TEST(plant, viscous_friction_slows_joint_1_as_an_exponential) {
  const Plant plant{counterbalanced(premium_1_5()).arm, {0, 1, 1}, {5e-3, 0, 0}, std::nullopt};
  const Motion motion = plant.advanced({.velocity = {1, 0, 0}}, Joints::Zero(), {}, 0.5, 10'000);
  EXPECT_NEAR(motion.velocity[0], std::exp(-5e-3 / plant.arm.mass(kResetPose)(0, 0) * 0.5), 1e-9);
}

TEST(plant, coulomb_friction_stops_joint_1_where_a_brick_would_stop) {
  const Plant plant{counterbalanced(premium_1_5()).arm, {0.01, 1, 1}, Joints::Zero(), std::nullopt};
  Motion motion{.angles = {0, 0, 0}, .velocity = {1, 0, 0}};
  const double mass = plant.arm.mass(motion.angles)(0, 0);
  motion = plant.advanced(motion, Joints::Zero(), {}, 1, 20'000);
  EXPECT_EQ(motion.velocity, Joints::Zero());
  EXPECT_NEAR(motion.angles[0], mass / (2 * 0.01), 1e-8);
}

TEST(plant, never_gains_energy_by_friction) {
  const Model model = counterbalanced(premium_1_5());  // so that all energy is kinetic
  const Plant plant{model.arm, model.coulomb, Joints::Zero(), std::nullopt};
  for (const Joints& velocity : {Joints(4, -3, 5), Joints(0, 0.5, 0.4), Joints(0.1, 0, 1), Joints(0, 1e-9, -1e-3)}) {
    Motion motion{.angles = {0.2, 0.5, -0.1}, .velocity = velocity};
    double last = plant.arm.energy(motion.angles, motion.velocity);
    for (int step = 0; step < 40'000; ++step) {
      motion = plant.advanced(motion, Joints::Zero(), {}, kTick / kSteps, 1);
      const double now = plant.arm.energy(motion.angles, motion.velocity);
      ASSERT_LE(now, last * (1 + 1e-14)) << step;
      last = now;
    }
    EXPECT_EQ(motion.velocity, Joints::Zero());
  }
}

// To the bit, not to a band: a sticking joint does not creep, chatter or drift, whatever torque it holds against.
TEST(plant, rests_exactly_below_breakaway_and_moves_above) {
  const Model model = premium_1_5();
  Plant plant = free_arm();
  plant.coulomb = model.coulomb;
  const Joints angles{0.1, 0.2, 0.05};
  const Joints balance = plant.arm.gravity(angles);
  for (const double share : {-0.999, -0.5, 0.0, 0.5, 0.999}) {
    const Motion motion = plant.advanced({.angles = angles}, balance + share * plant.coulomb, {}, 2, 40'000);
    EXPECT_EQ(motion.angles, angles) << share;
    EXPECT_EQ(motion.velocity, Joints::Zero()) << share;
  }
  for (int joint = 0; joint < 3; ++joint)
    for (const double share : {-1.001, 1.001}) {
      const Joints torque = balance + share * plant.coulomb[joint] * Joints::Unit(joint);
      const Motion motion = plant.advanced({.angles = angles}, torque, {}, 0.1, 2000);
      EXPECT_GT((motion.angles - angles)[joint] * share, 1e-7) << joint;
    }
}

// A held hand on a sticking arm: the spring between them oscillates and dies down, and then nothing moves any more.
TEST(plant, comes_to_rest_in_a_hand) {
  const Model model = premium_1_5();
  const Plant plant{model.arm, model.coulomb, model.viscous, Grip{}};
  HermiteStep way;
  way.from = way.to = {0.001, 0.0005, -0.0003};
  Motion motion;
  motion = plant.advanced(motion, Joints::Zero(), way, 5, 100'000);
  const Motion later = plant.advanced(motion, Joints::Zero(), way, 1, 20'000);
  EXPECT_EQ(motion.velocity, Joints::Zero());
  EXPECT_EQ(later.angles, motion.angles);
  EXPECT_LE(later.hand_velocity.norm(), 1e-9);
}

TEST(plant, hand_gives_way_like_its_two_springs_in_series) {
  const Plant plant{counterbalanced(premium_1_5()).arm, Joints::Zero(), Joints::Constant(5e-3), Grip{}};
  const Eigen::Vector3d force(0.1, 0.2, -0.1);
  const Motion motion = plant.advanced({}, plant.arm.jacobian(kResetPose).transpose() * force, {}, 10, 200'000);
  const Grip& grip = *plant.grip;
  const Eigen::Vector3d expected = force * (1 / grip.flesh_stiffness + 1 / grip.arm_stiffness);
  // The torque is held while the pose turns a little.
  EXPECT_LE((plant.arm.forward(motion.angles) - expected).norm(), 0.02 * expected.norm());
  EXPECT_LE((motion.hand - plant.arm.jacobian(motion.angles).transpose().inverse() *
                               plant.arm.jacobian(kResetPose).transpose() * force / grip.arm_stiffness)
                .norm(),
            1e-9);
}

// A cubic cut in two is the same cubic.
TEST(plant, follows_a_target_along_the_cubic_through_its_ends) {
  const Model model = premium_1_5();
  const Plant plant{model.arm, Joints::Zero(), model.viscous, Grip{}};
  const Eigen::Vector3d a(0.3, -0.1, 0.2), b(4, 2, -3), c(-50, 30, 20);
  const auto position = [&](double t) -> Eigen::Vector3d { return t * (a + t * (b + t * c)); };
  const auto velocity = [&](double t) -> Eigen::Vector3d { return a + t * (2 * b + t * 3 * c); };
  const auto way = [&](double begin, double end) -> HermiteStep {
    return {position(begin), velocity(begin), position(end), velocity(end)};
  };
  const Motion whole = plant.advanced({}, Joints::Zero(), way(0, 0.1), 0.1, 2000);
  const Motion half = plant.advanced({}, Joints::Zero(), way(0, 0.05), 0.05, 1000);
  const Motion halves = plant.advanced(half, Joints::Zero(), way(0.05, 0.1), 0.05, 1000);
  EXPECT_LE((whole.hand - halves.hand).norm(), 1e-12);
  EXPECT_LE((whole.hand_velocity - halves.hand_velocity).norm(), 1e-11);
  EXPECT_LE((whole.angles - halves.angles).norm(), 1e-11);
}

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
