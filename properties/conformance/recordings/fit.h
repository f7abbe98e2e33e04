// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fits the place of a recording in the scene of a subject, and the stiffness with which it was rendered, where these are
// unknown: by least squares (fit.md beside it), with the errors that the samples leave.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/properties.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

struct FitOptions {
  std::optional<Eigen::Matrix3d> turn = {};    // where it is known
  std::optional<Eigen::Vector3d> offset = {};  // the same, N along the axes of the recording
  std::optional<double> lag = {};              // the same, s
  double noise = 0;                            // N; a sample with a larger force is in contact
  std::uint64_t seed = 1;
};

// An error is four standard errors of the numbers that the samples determine (solution.h), and what rounding positions to
// binary32 can add. An offset or a lag that is no larger than its error is zero, and what this changes is in the errors, too.
struct Fit {
  Placement placement;
  Eigen::Vector3d offset_error = Eigen::Vector3d::Zero();  // N
  double lag_error = 0;                                    // s
  double stiffness = 0, stiffness_error = 0;               // N/mm
  double turn_error = 0;                                   // degrees
  double shift_error = 0;                                  // mm, at the middle of the samples in contact
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();        // mm, along the axes of the recording
  std::size_t samples = 0, contacts = 0;                   // that were fitted
  std::size_t outliers = 0;                                // that were left out in the end
  std::size_t rests = 0;                                   // of those that were fitted, where the subject has no force
  double noise_at_rest = 0;                                // N, root mean square of what was measured there beside the offset
  double rms = 0, largest = 0;                             // N, of the residuals of those that were fitted
  std::size_t largest_at = 0;                              // the number of this sample
  std::vector<std::string> undetermined;    // "a turn about z": these samples have the same forces with another one
  std::optional<std::string> refusal = {};  // why there is no fit, in words; then nothing else counts
};

// Throws Interrupted.
Fit fit_of(const Measurements& measured, const properties::Subject& subject, float stiffness, const FitOptions& options,
           const Monitor& monitor = {});

}  // namespace forceshade::conformance
