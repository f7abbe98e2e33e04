// SPDX-License-Identifier: BSD-3-Clause
// Positions between samples.
#include "properties/conformance/recordings/path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace forceshade::conformance {
namespace {

Eigen::Vector3d hand(double time) {
  const double turns = 2 * std::numbers::pi * time;
  return {12 * std::sin(3 * turns), 1.5 * std::cos(15 * turns), 7 + 40 * time};
}

// 1 s at 250 Hz, where every third interval is half as long.
std::vector<Measured> recorded() {
  std::vector<Measured> samples;
  double time = 0;
  for (std::size_t i = 0; i < 250; ++i) {
    samples.push_back({time, hand(time), Eigen::Vector3d::Zero(), i + 2, 0});
    time += i % 3 == 0 ? 0.002 : 0.004;
  }
  return samples;
}

TEST(path, meets_the_positions_between_samples) {
  const std::vector<Measured> samples = recorded();
  const Path path(samples);
  double worst = 0;
  for (std::size_t i = 20; i + 20 < samples.size(); ++i)
    for (const double lag : {-0.013, -0.0007, 0.0, 0.0011, 0.004, 0.0217})
      worst = std::max(worst, (path.position(samples[i], lag) - hand(samples[i].time - lag)).norm());
  std::printf("off by %.3g mm at most\n", worst);
  EXPECT_LT(worst, 5e-4);
  for (const Measured& each : samples) EXPECT_EQ(path.position(each, 0), each.position);
}

TEST(path, reaches_from_its_first_sample_to_its_last) {
  const std::vector<Measured> samples = recorded();
  const Path path(samples);
  EXPECT_TRUE(path.reaches(samples.front(), 0));
  EXPECT_FALSE(path.reaches(samples.front(), 1e-9));
  EXPECT_FALSE(path.reaches(samples.back(), -1e-9));
  EXPECT_TRUE(path.reaches(samples.back(), 0.1));
}

// A time that goes back, and one that is repeated, are not on the path; the sample itself is where it is.
TEST(path, leaves_out_times_that_do_not_increase) {
  std::vector<Measured> samples = recorded();
  const Path whole(samples);
  Measured back = samples[100], again = samples[120];
  back.time -= 0.05;
  back.position.setConstant(1000);
  again.position.setConstant(-1000);
  samples.insert(samples.begin() + 121, again);
  samples.insert(samples.begin() + 101, back);
  const Path path(samples);
  EXPECT_EQ(path.position(back, 0), back.position);
  for (std::size_t i = 50; i < 200; ++i) {
    if (samples[i].position.norm() >= 500) continue;
    EXPECT_EQ(path.position(samples[i], 0.0015), whole.position(samples[i], 0.0015)) << i;
  }
}

}  // namespace
}  // namespace forceshade::conformance
