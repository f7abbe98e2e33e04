// SPDX-License-Identifier: BSD-3-Clause
// Samples that were repeated, beside hands at rest and sensors with coarse steps, whose positions stay, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "properties/conformance/recordings/invariants.h"

namespace forceshade::conformance {
namespace {

using Path = std::function<Eigen::Vector3d(double)>;

Eigen::Vector3d stroke(double time) {
  return {60 * std::sin(3 * time), 30 * std::cos(2 * time), 2 - 3.5 * std::pow(std::sin(5 * time), 2)};
}
Eigen::Vector3d circle(double time) {
  return {20 * std::cos(4 * time), 20 * std::sin(4 * time), -1};
}
// The hand comes to rest for a tenth of a second, and goes on.
Eigen::Vector3d pause(double time) {
  return stroke(std::min(time, 0.5) + std::max(time - 0.6, 0.0) * std::min(1.0, std::max(time - 0.6, 0.0) / 0.2));
}

// 2 s at 1000 Hz; of each sample the path is taken at the time that `held` gives.
Measurements recorded(const Path& path, const std::function<double(int)>& held) {
  Measurements measured{"made.csv", {}};
  for (int i = 0; i < 2000; ++i)
    measured.samples.push_back(
        {i / 1000.0, path(held(i)), Eigen::Vector3d::Zero(), static_cast<std::size_t>(i) + 2, i == 0 ? 0 : 0.001});
  return measured;
}

struct Recorded {
  const Measurements measured;
  const Stays stays{measured};
};

std::size_t stale_of(const Stays& stays) {
  return static_cast<std::size_t>(std::ranges::count_if(stays.all(), [&](const Stay& stay) { return stays.is_stale(stay); }));
}

TEST(stays, are_stale_where_every_sample_is_copied) {
  for (const Path& path : {Path(stroke), Path(circle)})
    for (const int hold : {2, 3, 7, 10, 17, 50}) {
      const Recorded stays{recorded(path, [&](int i) { return i / hold * hold / 1000.0; })};
      EXPECT_GT(stale_of(stays.stays), stays.stays.all().size() / 4) << hold;
      EXPECT_NEAR(stays.stays.rate(), 1000.0 / hold, 1e-6);
    }
}

TEST(stays, are_stale_where_the_rates_are_no_multiples_or_the_holds_differ) {
  const Recorded sixty{recorded(stroke, [](int i) { return std::floor(i * 0.06) / 60; })};
  EXPECT_GT(stale_of(sixty.stays), sixty.stays.all().size() / 4);
  EXPECT_NEAR(sixty.stays.rate(), 60, 1);
  std::mt19937 random(1);
  double last = 0;
  const Recorded lost{recorded(stroke, [&](int i) { return last = random() % 3 == 0 ? last : i / 1000.0; })};
  EXPECT_GT(stale_of(lost.stays), 100U);
}

// As a filter or a second program leaves it.
Path with_noise(const Path& path, double size) {
  return [=, random = std::mt19937(1)](double time) mutable {
    std::normal_distribution<double> noise(0, size);
    return Eigen::Vector3d(path(time) + Eigen::Vector3d(noise(random), noise(random), noise(random)));
  };
}

TEST(stays, are_stale_where_noise_was_added_to_copies) {
  for (const double noise : {1e-12, 1e-7, 1e-5})
    for (const int hold : {2, 3, 7, 10, 17, 50}) {
      const Recorded stays{recorded(with_noise(stroke, noise), [&](int i) { return i / hold * hold / 1000.0; })};
      EXPECT_GT(stale_of(stays.stays), stays.stays.all().size() / 4) << noise << ' ' << hold;
      EXPECT_NEAR(stays.stays.rate(), 1000.0 / hold, 1) << "two copies are nearly at one position, too, where the hand turns";
    }
  const Recorded sixty{recorded(with_noise(stroke, 1e-7), [](int i) { return std::floor(i * 0.06) / 60; })};
  EXPECT_GT(stale_of(sixty.stays), sixty.stays.all().size() / 4);
}

TEST(stays, are_none_of_a_whole_recording) {
  for (const Path& path :
       {Path(stroke), Path(circle), with_noise(stroke, 1e-7), with_noise(stroke, 0.01), with_noise(pause, 1e-7)}) {
    const Recorded stays{recorded(path, [](int i) { return i / 1000.0; })};
    EXPECT_EQ(stale_of(stays.stays), 0U);
    EXPECT_NEAR(stays.stays.rate(), 1000, 1e-6);
  }
}

TEST(stays, are_not_stale_where_the_hand_rests) {
  const Recorded stays{recorded(pause, [](int i) { return i / 1000.0; })};
  EXPECT_EQ(stale_of(stays.stays), 0U);
  EXPECT_TRUE(std::ranges::any_of(stays.stays.all(), [&](const Stay& stay) { return stays.stays.is_long(stay); }));
  EXPECT_NEAR(stays.stays.rate(), 1000, 1e-6);
}

// A slow hand on a sensor with steps of 0.05 mm along each axis: at 3 to 40 mm/s its position stays for some samples.
TEST(stays, are_not_stale_between_the_steps_of_a_sensor) {
  for (const double size : {0.5, 1.0, 3.0}) {
    const Path coarse = [size](double time) {
      const Eigen::Vector3d exact = size * Eigen::Vector3d(std::sin(4 * time), std::cos(3 * time), std::sin(7 * time));
      return Eigen::Vector3d((exact / 0.05).array().round() * 0.05);
    };
    const Recorded stays{recorded(coarse, [](int i) { return i / 1000.0; })};
    EXPECT_LT(stays.stays.all().size(), 1900U);
    EXPECT_EQ(stale_of(stays.stays), 0U) << size;
  }
  // At one speed along one line, the positions of such a sensor stay for equally many samples.
  const Path line = [](double time) { return Eigen::Vector3d(0, 0, std::floor(time * 250 + 0.1) * 0.05); };
  EXPECT_EQ(stale_of(Recorded{recorded(line, [](int i) { return i / 1000.0; })}.stays), 0U);
}

// From the first sample to the next new position: ten intervals of 1 ms, which add up to a little more than 10 ms.
TEST(stays, are_long_above_10_ms) {
  for (const int hold : {10, 11}) {
    const Measurements measured = recorded(stroke, [&](int i) { return i / hold * hold / 1000.0; });
    const Stays stays(measured);
    EXPECT_EQ(stays.is_long(stays.all()[3]), hold > 10);
  }
}

}  // namespace
}  // namespace forceshade::conformance
