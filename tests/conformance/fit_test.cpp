// SPDX-License-Identifier: BSD-3-Clause
// Recordings that are made of the exact forces, in a frame and of a stiffness that the fit has to find.

#include "properties/conformance/recordings/fit.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "properties/conformance/recordings/judged_recording.h"
#include "properties/conformance/recordings/solution.h"
#include "tests/conformance/made_recording.h"
#include "tests/support/drawn.h"

namespace forceshade::conformance {
namespace {

using tests::described;
using tests::kMadeSamples;
using tests::recorded;

TEST(fit, explains_noise_free_recordings_of_every_law_to_rounding) {
  double worst = 0;
  for (const LawName& law : kLaws) {
    for (std::uint64_t seed = 1; seed <= tests::drawn(2); ++seed) {
      SCOPED_TRACE(std::string(law.name) + ", seed " + std::to_string(seed));
      const Measurements measured = recorded(described(law, 0.7F), seed, {}).measured;
      RecordingOptions options;
      options.fits = true;
      options.tolerance = {Unit::newton, 1e-5};
      const JudgedRecording found = judge_recording(measured, described(law, 0.5F), options);
      ASSERT_FALSE(found.fit->refusal) << *found.fit->refusal;
      EXPECT_TRUE(found.comparison->judgement.held());
      EXPECT_EQ(found.comparison->judgement.all.cases, kMadeSamples);
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
    for (std::uint64_t draw = 0; draw < tests::drawn(2); ++draw) {
      const std::uint64_t seed = 4 + 10 * draw + static_cast<std::uint64_t>(law.id);
      SCOPED_TRACE(std::string(law.name) + ", seed " + std::to_string(seed));
      const Measurements measured = recorded(described(law, 0.7F), seed, {.noise = kNoise}).measured;
      const auto subject = properties::subject_of(described(law, 0.5F));
      const Fit found = fit_of(measured, *subject, 0.5F, {.noise = 5 * kNoise});
      ASSERT_FALSE(found.refusal) << *found.refusal;
      const double off = std::fabs(found.stiffness - static_cast<double>(0.7F));
      EXPECT_LE(off, found.stiffness_error);
      EXPECT_LT(found.stiffness_error, 0.02);
      EXPECT_LT(found.outliers, kMadeSamples / 100);
      EXPECT_NEAR(found.rms / (std::sqrt(3.0) * kNoise), 1, 0.1);
      sum += std::pow(4 * off / found.stiffness_error, 2);
      ++fits;
    }
  }
  // In standard errors, which are a quarter of what is stated.
  const double typical = std::sqrt(sum / static_cast<double>(fits));
  std::printf("the stiffness is off by %.2f standard errors (root mean square of %zu fits)\n", typical, fits);
  EXPECT_GT(typical, 0.5);
  EXPECT_LT(typical, 1.6);
}

// Errors of straight lines whose noise is known: independent, correlated from sample to sample, or larger where it counts.

constexpr Eigen::Index kSamples = 400;

// Counts how often the error of a slope that is zero holds that, of 400 times, and how large it is, in those four standard
// errors.
struct Counted {
  int held = 0;
  double typical = 0;
};

// correlation: of the noise of a sample and the next. in_contact: how many times the noise is as large where the slope counts.
Counted counted(double correlation, double in_contact) {
  constexpr int kTimes = 400;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Counted counted;
  for (int time = 0; time < kTimes; ++time) {
    Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(3 * kSamples, 2);
    Eigen::VectorXd noise(3 * kSamples);
    Eigen::Vector3d now(normal(random), normal(random), normal(random));
    for (Eigen::Index i = 0; i < kSamples; ++i) {
      const double depth = std::max(0.0, std::sin(0.05 * static_cast<double>(i) + time));
      derivatives.block<3, 1>(3 * i, 0).setConstant(depth);
      derivatives.block<3, 1>(3 * i, 1).setConstant(1);
      noise.segment<3>(3 * i) = (depth > 0.8 ? in_contact : 1) * 0.1 * now;
      const Eigen::Vector3d fresh(normal(random), normal(random), normal(random));
      now = correlation * now + std::sqrt(1 - correlation * correlation) * fresh;
    }
    const Eigen::VectorXd found = derivatives.colPivHouseholderQr().solve(noise);
    const FitErrors errors = fit_errors_of(derivatives, derivatives * found - noise, 0.5, 0);
    EXPECT_EQ(errors.free.maxCoeff(), 0);
    counted.held += std::fabs(found[0]) <= errors.error[0] ? 1 : 0;
    counted.typical += std::pow(4 * found[0] / errors.error[0], 2) / kTimes;
  }
  counted.typical = std::sqrt(counted.typical);
  return counted;
}

TEST(fit_errors, hold_the_truth_of_noise_of_every_kind) {
  for (const double correlation : {0.0, 0.5, 0.9})
    for (const double in_contact : {1.0, 4.0}) {
      const Counted found = counted(correlation, in_contact);
      std::printf("correlation %.1f, %.0f times as large: held %d of 400, typically %.2f standard errors\n", correlation,
                  in_contact, found.held, found.typical);
      EXPECT_GE(found.held, 398) << correlation << ", " << in_contact;
      EXPECT_LT(found.typical, 1.2) << correlation << ", " << in_contact;
      EXPECT_GT(found.typical, 0.5) << correlation << ", " << in_contact;
    }
}

TEST(fit_errors, say_what_no_sample_determines) {
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(30, 3);
  for (Eigen::Index i = 0; i < 10; ++i) derivatives.block<1, 2>(3 * i, 0) << 1, 1;  // only their sum
  derivatives(2, 2) = 1e-3;                                                         // hardly anything
  const FitErrors errors = fit_errors_of(derivatives, Eigen::VectorXd::Zero(30), 1, 0);
  EXPECT_NEAR(errors.free[0], 0.5, 1e-9);
  EXPECT_NEAR(errors.free[1], 0.5, 1e-9);
  EXPECT_NEAR(errors.free[2], 1, 1e-9);
}

// One singular value of 2, so that rounding adds rounding * sqrt(30) / 2.
TEST(fit_errors, add_what_rounding_does_at_most) {
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(30, 1);
  derivatives(0, 0) = 2;
  EXPECT_NEAR(fit_errors_of(derivatives, Eigen::VectorXd::Zero(30), 1, 1e-3).error[0], 1e-3 * std::sqrt(30.0) / 2, 1e-12);
}

TEST(fit_errors, leave_out_weak_forces) {
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Ones(6, 2);
  derivatives.block<3, 1>(3, 0).setConstant(0.1);
  const Eigen::MatrixXd left = without_weak_forces(derivatives, 0.2);
  EXPECT_TRUE(left.topRows(3).isOnes(0));
  EXPECT_TRUE(left.bottomRows(3).isZero(0));
}

}  // namespace

}  // namespace forceshade::conformance
