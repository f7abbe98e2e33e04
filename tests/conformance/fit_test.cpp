// SPDX-License-Identifier: BSD-3-Clause
// Recordings that are made of the exact forces, in a frame and of a stiffness that the fit has to find. fit_coverage_test has
// noise.

#include "properties/conformance/recordings/fit.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

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
