// SPDX-License-Identifier: BSD-3-Clause
// Recordings that are made of the exact forces, in a frame and of a stiffness that the fit has to find.
#include "properties/conformance/recordings/fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "forceshade/subjects.h"
#include "properties/conformance/recordings/judged_recording.h"
#include "tests/support/drawn.h"

namespace forceshade::conformance {
namespace {

constexpr std::size_t kSamples = 600;

Description described(const LawName& law, float stiffness) {
  return {std::string(law.name), DescribedLaw{law.id, {15.24F, 25.4F, stiffness}}};
}

// A hand that strokes over the bump and its edges, in and out of contact; the frame is turned at random, and shifted by up to
// 100 mm. noise: N, the standard deviation of each component of the force.
Measurements recorded(const Description& description, std::uint64_t seed, double noise) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  Placement placement{Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix(),
                      {number(-100, 100), number(-100, 100), number(-100, 100)}};
  const auto wave = [&](double size, double hertz) {
    return [size, turns = 2 * std::numbers::pi * hertz * number(0.7, 1.4), begin = number(0, 6)](double time) {
      return size * std::sin(turns * time + begin);
    };
  };
  const auto far_x = wave(14, 3), near_x = wave(2, 7), far_y = wave(10, 2), far_z = wave(3, 5), near_z = wave(1.5, 11);
  const auto session = properties::subject_of(description)->renderer().open();
  Measurements measured{"made.csv", {}};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double time = static_cast<double>(i) / 1000, x = far_x(time) + near_x(time);
    const Eigen::Vector3f hand =
        Eigen::Vector3d(x, far_y(time), 2.5 + far_z(time) + near_z(time) - 0.015 * x * x).cast<float>();
    const Eigen::Vector3d force =
        session->step(hand).force.cast<double>() + noise * Eigen::Vector3d(normal(random), normal(random), normal(random));
    measured.samples.push_back({time, placement.turn * hand.cast<double>() + placement.shift, placement.turn * force, i + 2});
  }
  return measured;
}

TEST(fit, explains_noise_free_recordings_of_every_law_to_rounding) {
  double worst = 0;
  for (const LawName& law : kLaws) {
    for (std::uint64_t seed = 1; seed <= tests::drawn(2); ++seed) {
      SCOPED_TRACE(std::string(law.name) + ", seed " + std::to_string(seed));
      const Measurements measured = recorded(described(law, 0.7F), seed, 0);
      RecordingOptions options;
      options.fits = true;
      options.tolerance = {Unit::newton, 1e-5};
      const JudgedRecording found = judge_recording(measured, described(law, 0.5F), options);
      ASSERT_FALSE(found.fit->refusal) << *found.fit->refusal;
      EXPECT_TRUE(found.comparison->judgement.held());
      EXPECT_EQ(found.comparison->judgement.all.cases, kSamples);
      EXPECT_EQ(found.fit->outliers, 0U);
      EXPECT_LT(found.fit->rms, 1e-6);
      EXPECT_LE(std::fabs(found.fit->stiffness - static_cast<double>(0.7F)), found.fit->stiffness_error);
      EXPECT_LT(found.fit->stiffness_error, 1e-4);
      worst = std::max(worst, found.fit->largest);
    }
  }
  std::printf("the largest residual is %.3g N\n", worst);
}

// Were samples left out until the rest fits, the residuals would be smaller than the noise, and so would the stated error.
TEST(fit, leaves_the_noise_and_states_what_it_does_to_the_stiffness) {
  constexpr double kNoise = 0.005;
  double sum = 0;
  std::size_t fits = 0;
  for (const LawName& law : kLaws) {
    for (std::uint64_t seed = 4; seed < 4 + tests::drawn(2); ++seed) {
      SCOPED_TRACE(std::string(law.name) + ", seed " + std::to_string(seed));
      const Measurements measured = recorded(described(law, 0.7F), seed, kNoise);
      const auto subject = properties::subject_of(described(law, 0.5F));
      const Fit found = fit_of(measured, *subject, 0.5F, {.noise = 5 * kNoise});
      ASSERT_FALSE(found.refusal) << *found.refusal;
      const double off = std::fabs(found.stiffness - static_cast<double>(0.7F));
      EXPECT_LE(off, found.stiffness_error);
      EXPECT_LT(found.stiffness_error, 0.02);
      EXPECT_LT(found.outliers, kSamples / 100);
      EXPECT_NEAR(found.rms / (std::sqrt(3.0) * kNoise), 1, 0.1);
      sum += std::pow(3 * off / found.stiffness_error, 2);
      ++fits;
    }
  }
  // In standard errors, which are a third of what is stated.
  const double typical = std::sqrt(sum / static_cast<double>(fits));
  std::printf("the stiffness is off by %.2f standard errors (root mean square of %zu fits)\n", typical, fits);
  EXPECT_GT(typical, 0.5);
  EXPECT_LT(typical, 1.6);
}

}  // namespace
}  // namespace forceshade::conformance
