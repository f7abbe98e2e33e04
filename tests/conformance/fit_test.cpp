// SPDX-License-Identifier: BSD-3-Clause
// Recordings that are made of the exact forces, in a frame and of a stiffness that the fit has to find.
#include "properties/conformance/recordings/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "properties/conformance/recordings/judged_recording.h"
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

}  // namespace
}  // namespace forceshade::conformance
