// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/hand.h"

#include <gtest/gtest.h>

#include <cmath>

namespace forceshade::device {
namespace {

using Between = Intention::Between;

TEST(intention, by_minimum_jerk_passes_its_points_at_rest) {
  const Intention intention({{1, {0, 0, 0}}, {3, {10, 0, -4}}, {4, {0, 5, 0}}}, Between::minimum_jerk);
  EXPECT_EQ(intention.at(0).position, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(intention.at(3).position, Eigen::Vector3d(10, 0, -4));
  EXPECT_EQ(intention.at(9).position, Eigen::Vector3d(0, 5, 0));
  for (const double time : {0.0, 1.0, 3.0, 4.0, 9.0}) EXPECT_EQ(intention.at(time).velocity, Eigen::Vector3d(0, 0, 0)) << time;
  EXPECT_EQ(intention.at(2).position, Eigen::Vector3d(5, 0, -2));
  EXPECT_NEAR(intention.at(2).velocity.x(), 1.875 * 10 / 2, 1e-12);  // 15/8 of the mean, as Flash and Hogan have it
  EXPECT_EQ(intention.end(), 4);
}

TEST(intention, velocity_is_the_slope_of_its_position) {
  for (const Between between : {Between::minimum_jerk, Between::straight}) {
    const Intention intention({{0, {0, 1, 0}}, {0.7, {3, -2, 1}}, {1.5, {-1, 0, 4}}}, between);
    for (double time = 0.01; time < 1.5; time += 0.0213) {
      constexpr double h = 1e-5;
      const Eigen::Vector3d slope = (intention.at(time + h).position - intention.at(time - h).position) / (2 * h);
      EXPECT_LE((slope - intention.at(time).velocity).norm(), 1e-7) << time;
    }
  }
}

TEST(intention, from_a_recording_goes_straight_from_point_to_point_and_takes_points_at_the_same_time) {
  const Intention intention({{0, {0, 0, 0}}, {1, {4, 0, 0}}, {1, {5, 0, 0}}, {2, {5, 8, 0}}}, Between::straight);
  EXPECT_EQ(intention.at(0.25).position, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(intention.at(1).position, Eigen::Vector3d(5, 0, 0));
  EXPECT_EQ(intention.at(1.5).position, Eigen::Vector3d(5, 4, 0));
}

TEST(intention, strokes_cross_the_bump_below_the_plane) {
  const Intention intention = strokes();
  double left = 0, right = 0;
  for (double time = 1; time < 600; time += 0.01) {
    const Eigen::Vector3d position = intention.at(time).position;
    left = std::min(left, position.x());
    right = std::max(right, position.x());
    ASSERT_GE(position.z(), -3);
    ASSERT_LE(position.z(), -1);
  }
  EXPECT_NEAR(left, -20, 0.01);
  EXPECT_NEAR(right, 20, 0.01);
}

TEST(tremor, is_the_same_for_the_same_seed_and_another_for_another) {
  const Tremor a(1, 0.03), again(1, 0.03), other(2, 0.03);
  EXPECT_EQ(a.at(1.23).position, again.at(1.23).position);
  EXPECT_NE(a.at(1.23).position, other.at(1.23).position);
  EXPECT_NE(a.at(1.23).position.x(), a.at(1.23).position.y());
}

// Its power outside 8 to 12 Hz is 0: every tone lies within; its size is what was asked for.
TEST(tremor, has_the_size_asked_for_and_beats_at_8_to_12_Hz) {
  const Tremor tremor(7, 0.03);
  constexpr int kSamples = 400'000;  // 400 s
  Eigen::Vector3d squares = Eigen::Vector3d::Zero(), last = tremor.at(0).position;
  Eigen::Array3i crossings = Eigen::Array3i::Zero();
  for (int k = 1; k <= kSamples; ++k) {
    const Eigen::Vector3d now = tremor.at(k * 1e-3).position;
    squares += now.cwiseProduct(now);
    for (int i = 0; i < 3; ++i) crossings[i] += (now[i] > 0) != (last[i] > 0);
    last = now;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::sqrt(squares[i] / kSamples), 0.03, 0.001);
    EXPECT_NEAR(crossings[i] / 2.0 / 400, 10, 2);
  }
  constexpr double h = 1e-5;
  EXPECT_LE(((tremor.at(1 + h).position - tremor.at(1 - h).position) / (2 * h) - tremor.at(1).velocity).norm(), 1e-6);
}

}  // namespace
}  // namespace forceshade::device
