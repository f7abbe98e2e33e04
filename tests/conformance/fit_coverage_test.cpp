// SPDX-License-Identifier: BSD-3-Clause
// The share of fits whose stated errors hold the truth, over recordings with known stiffness, place, offset, lag and noise.
// FORCESHADE_DRAWS=20 makes a thousand recordings (properties/conformance/recordings/fit.md has what came of them).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "properties/conformance/recordings/fit.h"
#include "properties/conformance/recordings/solution.h"
#include "tests/conformance/made_recording.h"
#include "tests/support/drawn.h"

namespace forceshade::conformance {
namespace {

constexpr std::array kWhat{"stiffness", "offset x", "offset y", "offset z", "lag", "turn", "shift"};

// The true number less the fitted one, over the stated error; empty where the samples do not determine the number.
using Shares = std::array<std::optional<double>, kWhat.size()>;

bool is_undetermined(const Fit& fit, const std::string& name) {
  return std::ranges::find(fit.undetermined, name) != fit.undetermined.end();
}

// A bump is the same after half a turn about z, and along y; a plane after any turn about z.
Shares shares_of(const Fit& fit, LawId law, const Placement& truth, double stiffness) {
  Shares shares;
  shares[0] = std::fabs(fit.stiffness - stiffness) / fit.stiffness_error;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    shares[static_cast<std::size_t>(1 + axis)] =
        std::fabs(fit.placement.offset[axis] - truth.offset[axis]) / fit.offset_error[axis];
  if (!is_undetermined(fit, "a lag of the force")) shares[4] = std::fabs(fit.placement.lag - truth.lag) / fit.lag_error;
  if (law == LawId::cylinder) return shares;  // the same after a turn about its axis
  const Eigen::Vector3d up = fit.placement.turn.row(2), true_up = truth.turn.row(2);
  shares[5] = std::atan2(up.cross(true_up).norm(), up.dot(true_up)) * 180 / std::numbers::pi / fit.turn_error;
  const Eigen::Vector3d there = fit.placement.turn * fit.middle + fit.placement.shift;
  const Eigen::Vector3d truly = truth.turn * fit.middle + truth.shift;
  const double across = is_undetermined(fit, "a shift along x")
                            ? 0
                            : std::min(std::fabs(there.x() - truly.x()), std::fabs(there.x() + truly.x()));
  shares[6] = std::hypot(across, there.z() - truly.z()) / fit.shift_error;
  return shares;
}

TEST(fit_coverage, the_stated_errors_hold_the_truth) {
  const std::size_t all = tests::drawn(50);
  std::array<std::vector<double>, kWhat.size()> shares;
  std::size_t refused = 0;
  for (std::uint64_t seed = 1; seed <= all; ++seed) {
    std::mt19937_64 random(1000 + seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto chance = [&](double share) { return number(0, 1) < share; };
    const LawName& law = kLaws[seed % kLaws.size()];
    const auto stiffness = static_cast<float>(std::exp(number(std::log(0.2), std::log(3))));
    tests::Making making;
    making.rate = std::array{250, 500, 1000}[seed / kLaws.size() % 3];
    making.samples = static_cast<std::size_t>(making.rate * number(1, 2));
    making.noise = chance(0.1) ? 0 : static_cast<double>(stiffness) * std::exp(number(std::log(1e-3), std::log(0.05)));
    making.correlation = chance(0.5) ? 0 : number(0, 0.9);
    making.position_noise = chance(0.7) ? 0 : number(0, 0.02);
    if (chance(0.8)) making.offset = {number(-1, 1), number(-1, 1), number(-1, 1)};
    if (chance(0.7)) making.lag = number(0, 0.02);
    const tests::Made made = tests::recorded(tests::described(law, stiffness), seed, making);
    const auto subject = properties::subject_of(tests::described(law, 0.5F));
    const Fit fit = fit_of(made.measured, *subject, 0.5F, {});
    if (fit.refusal) {
      ++refused;
      std::printf("refused: seed %zu, %s: %s\n", seed, std::string(law.name).c_str(), fit.refusal->c_str());
      continue;
    }
    const Shares next = shares_of(fit, law.id, made.truth, static_cast<double>(stiffness));
    for (std::size_t what = 0; what < kWhat.size(); ++what) {
      if (!next[what]) continue;
      shares[what].push_back(*next[what]);
      if (*next[what] > 1)
        std::printf(
            "missed: seed %zu, %s, %s: %.3g of the error, noise %.3g N, correlation %.2g, lag %.3g ms, position noise %.3g mm, "
            "%g Hz\n",
            seed, std::string(law.name).c_str(), kWhat[what], *next[what], making.noise, making.correlation, 1000 * making.lag,
            making.position_noise, making.rate);
    }
  }
  std::printf("%zu recordings, %zu without a fit\n", all, refused);
  EXPECT_LE(refused, 1 + all / 50);
  for (std::size_t what = 0; what < kWhat.size(); ++what) {
    std::vector<double>& each = shares[what];
    ASSERT_FALSE(each.empty());
    std::ranges::sort(each);
    const auto held = std::ranges::upper_bound(each, 1.0) - each.begin();
    const double half = each[each.size() / 2];
    std::printf("%-9s held by %zd of %zu intervals; half of the errors are at most %.2f of what is stated\n", kWhat[what], held,
                each.size(), half);
    EXPECT_GE(static_cast<double>(held), 0.985 * static_cast<double>(each.size()) - 1) << kWhat[what];
    EXPECT_GT(half, 0.02) << kWhat[what];  // an interval that holds everything says nothing
  }
}

// A spline between two noisy positions has less noise than they, which pulls the lag of a slow hand to half an interval.
TEST(fit_coverage, the_stated_error_of_a_lag_holds_where_positions_alone_are_noisy) {
  const auto subject = properties::subject_of(tests::described(kLaws.front(), 0.5F));
  for (const double noise : {0.0, 0.01})
    for (const double lag : {0.0, 0.003}) {
      std::mt19937_64 random(1);
      std::normal_distribution<double> normal(0, 1);
      const auto hand = [](double time) {
        return Eigen::Vector3d(60 * std::sin(3 * time), 30 * std::cos(2 * time), 2 - 3.5 * std::pow(std::sin(5 * time), 2));
      };
      Measurements measured{"made.csv", {}};
      for (std::size_t i = 0; i < 1500; ++i) {
        const double time = static_cast<double>(i) / 1000, force = 0.5 * std::max(0.0, -hand(time - lag).z());
        const Eigen::Vector3d off = noise * Eigen::Vector3d(normal(random), normal(random), normal(random));
        measured.samples.push_back({time, hand(time) + off, {0, 0, force}, i + 2, i == 0 ? 0 : 0.001});
      }
      const Fit fit = fit_of(measured, *subject, 0.5F, {});
      ASSERT_FALSE(fit.refusal) << *fit.refusal;
      std::printf("noise %g mm, lag %g ms: %.4g +- %.4g ms\n", noise, 1000 * lag, 1000 * fit.placement.lag,
                  1000 * fit.lag_error);
      EXPECT_LE(std::fabs(fit.placement.lag - lag), fit.lag_error);
      EXPECT_LT(fit.lag_error, noise > 0 ? 1.5e-3 : 1e-4);
    }
}

// Sums of equal numbers are rounded, so that their mean may be another number.
TEST(fit_coverage, the_reading_of_no_force_is_known_exactly_without_noise) {
  for (int tenths = -30; tenths <= 30; ++tenths) {
    const Eigen::Vector3d offset(-0.1 * tenths, 0.4, 0.1 * tenths);
    std::vector<Measured> samples;
    for (int i = 0; i < 2000; ++i) {
      const double depth = std::max(0.0, std::sin(0.01 * i));
      samples.push_back(
          {i / 1000.0, {0, 0, -depth}, offset + Eigen::Vector3d(0, 0, 0.5 * depth), static_cast<std::size_t>(i) + 2});
    }
    const RestForce rest = rest_force_of(samples);
    EXPECT_EQ(rest.force, offset) << tenths;
    EXPECT_EQ(rest.noise, 0) << tenths;
  }
}

// A hand that never leaves the wall: what the sensor reads of no force cannot be told from where the wall is.
TEST(fit_coverage, an_offset_that_nobody_can_know_is_refused_unless_it_is_given) {
  const Description wall = tests::described(kLaws.front(), 0.5F);
  const auto subject = properties::subject_of(wall);
  const Eigen::Vector3d offset(0.1, 0.2, -0.3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double noise : {0.0, 0.003, 0.02})
    for (const double second : {0.0, 0.3}) {
      SCOPED_TRACE(std::to_string(noise) + " N, " + std::to_string(second) + " mm");
      Measurements measured{"pressed.csv", {}};
      for (std::size_t i = 0; i < 500; ++i) {
        const double time = static_cast<double>(i) / 500, depth = 2 + std::sin(20 * time) + second * std::sin(53 * time);
        const Eigen::Vector3d its_noise = noise * Eigen::Vector3d(normal(random), normal(random), normal(random));
        measured.samples.push_back({time,
                                    {10 * std::sin(9 * time), 8 * std::cos(7 * time), -depth},
                                    offset + its_noise + Eigen::Vector3d(0, 0, 0.5 * depth),
                                    i + 2,
                                    0.002});
      }
      FitOptions options{.turn = Eigen::Matrix3d::Identity()};
      const Fit refused = fit_of(measured, *subject, 0.5F, options);
      ASSERT_TRUE(refused.refusal);
      EXPECT_NE(refused.refusal->find("the hand never leaves the surface"), std::string::npos) << *refused.refusal;
      options.offset = offset;
      const Fit found = fit_of(measured, *subject, 0.5F, options);
      ASSERT_FALSE(found.refusal) << *found.refusal;
      EXPECT_LE(std::fabs(found.stiffness - 0.5), found.stiffness_error);
      EXPECT_LE(std::fabs(found.placement.shift.z()), found.shift_error);
    }
}

}  // namespace
}  // namespace forceshade::conformance
