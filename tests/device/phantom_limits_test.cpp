// SPDX-License-Identifier: BSD-3-Clause
// No limit becomes wider than the one that the driver should have given, whatever it states of its device.

#include "device/phantom/phantom_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace forceshade::device {
namespace {

using Box = std::array<double, 6>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();

// A Premium 1.5's, of sorts.
const DriversLimits kRight{
    .peak = 8.5, .continuous = 1.4, .speed = 2000, .impulse = 1.2, .workspace = Box{-190, -95, -130, 191, 96, 137}};

// Values that a driver may give instead of a number; NaN also stands for one that it did not write.
const std::vector<std::optional<double>> kWrong{std::nullopt, 0.0, -0.0, -1.0, kNan, kInfinite, -kInfinite, 1e300, -1e300};

PhantomLimits limits_of(const DriversLimits& driver) {
  const auto limits = phantom_limits(driver);
  if (const auto* why = std::get_if<std::string>(&limits)) {
    ADD_FAILURE() << *why;
    return {};
  }
  return std::get<PhantomLimits>(limits);
}

TEST(phantom_limits, are_the_drivers_or_a_little_below_what_it_ends_a_run_for) {
  const PhantomLimits limits = limits_of(kRight);
  EXPECT_NEAR(limits.peak, 0.95 * 8.5, 1e-12);
  EXPECT_EQ(limits.continuous, 1.4);
  EXPECT_NEAR(limits.speed, 1900, 1e-9);
  EXPECT_NEAR(limits.slew, 1140, 1e-9);
  EXPECT_EQ(limits.low, Eigen::Vector3f(-190, -137, -95));
  EXPECT_EQ(limits.high, Eigen::Vector3f(191, 130, 96));
  EXPECT_EQ(limits.words, "");
  DriversLimits always = kRight;
  always.continuous = always.peak;
  EXPECT_EQ(limits_of(always).continuous, limits.peak) << "it is no higher than ours";
}

TEST(phantom_limits, without_a_peak_that_is_one_there_are_none) {
  std::vector<std::optional<double>> wrong = kWrong;
  wrong.insert(wrong.end(), {40.1, std::nextafter(40.0, 50)});
  for (const auto& peak : wrong) {
    DriversLimits driver = kRight;
    driver.peak = peak;
    const auto limits = phantom_limits(driver);
    ASSERT_TRUE(std::holds_alternative<std::string>(limits)) << peak.value_or(0);
    EXPECT_NE(std::get<std::string>(limits).find("highest force: expected"), std::string::npos);
  }
  EXPECT_NE(
      std::get<std::string>(phantom_limits({.peak = {}, .continuous = 1, .speed = {}, .impulse = {}})).find("does not say"),
      std::string::npos);
  for (const double peak : {0.1, 40.0}) {
    DriversLimits driver = kRight;
    driver.peak = peak;
    EXPECT_NEAR(limits_of(driver).peak, 0.95 * peak, 1e-12);
    EXPECT_LE(limits_of(driver).continuous, limits_of(driver).peak);
  }
}

TEST(phantom_limits, without_a_continuous_force_take_the_lowest_of_all_sheets_and_say_so) {
  std::vector<std::optional<double>> wrong = kWrong;
  wrong.push_back(8.6);  // above the peak
  for (const auto& continuous : wrong) {
    DriversLimits driver = kRight;
    driver.continuous = continuous;
    EXPECT_EQ(limits_of(driver).continuous, 0.88) << continuous.value_or(0);
    EXPECT_EQ(limits_of(driver).words.starts_with("continuous force: the driver "), true) << limits_of(driver).words;
    driver.peak = 0.5;
    EXPECT_NEAR(limits_of(driver).continuous, 0.475, 1e-12) << "never above the peak";
  }
}

TEST(phantom_limits, without_speed_or_impulse_leave_both_to_the_supervisor_and_say_so) {
  for (const auto& wrong : kWrong) {
    DriversLimits driver = kRight;
    driver.speed = driver.impulse = wrong;
    EXPECT_EQ(limits_of(driver).speed, kInfinite) << wrong.value_or(0);
    EXPECT_EQ(limits_of(driver).slew, kInfinite) << wrong.value_or(0);
    EXPECT_TRUE(limits_of(driver).words.starts_with("highest velocity: the driver ")) << limits_of(driver).words;
    EXPECT_NE(limits_of(driver).words.find("\nhighest change of force: the driver "), std::string::npos);
  }
}

TEST(phantom_limits, without_a_workspace_that_is_a_box_take_the_smallest_of_all_sheets_and_say_so) {
  std::vector<std::optional<Box>> wrong{std::nullopt, Box{}, Box{190, 95, 130, -191, -96, -137}};
  for (std::size_t i = 0; i < 6; ++i)
    for (const double value : {kNan, kInfinite, -kInfinite, 1e300, -1e300}) {
      wrong.push_back(kRight.workspace);
      (*wrong.back())[i] = value;
    }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    wrong.push_back(kRight.workspace);
    (*wrong.back())[axis] = (*wrong.back())[axis + 3] - 9.9;
  }
  for (const auto& box : wrong) {
    DriversLimits driver = kRight;
    driver.workspace = box;
    const PhantomLimits limits = limits_of(driver);
    EXPECT_EQ(limits.low, Eigen::Vector3f(-80, -35, -60));
    EXPECT_EQ(limits.high, Eigen::Vector3f(80, 35, 60));
    EXPECT_TRUE(limits.words.starts_with(box ? "workspace: the driver gives no box;" : "workspace: the driver does not say;"))
        << limits.words;
  }
  DriversLimits narrow = kRight;
  (*narrow.workspace)[0] = (*narrow.workspace)[3] - 10;
  EXPECT_EQ(limits_of(narrow).words, "");
}

}  // namespace
}  // namespace forceshade::device
