// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a recording lies in the scene of a subject, and with which stiffness it was rendered, where nobody knows it: a least
// squares fit (docs/conformance.md), and how well the samples determine it.

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
  std::optional<Eigen::Matrix3d> turn = {};  // where it is known
  double noise = 0;                          // N; a sample with a larger force is in contact
  std::uint64_t seed = 1;
};

// An error is three standard errors of the numbers that the samples determine, and what rounding positions to binary32 can add.
struct Fit {
  Placement placement;
  double stiffness = 0, stiffness_error = 0;  // N/mm
  double turn_error = 0;                      // degrees
  double shift_error = 0;                     // mm, at the middle of the samples in contact
  std::size_t samples = 0, contacts = 0;      // that were fitted
  std::size_t outliers = 0;                   // that were left out in the end
  double rms = 0, largest = 0;                // N, of the residuals of those that were fitted
  std::size_t largest_at = 0;                 // which sample
  std::vector<std::string> undetermined;      // "a turn about z": these samples have the same forces with another one
  std::optional<std::string> refusal = {};    // why there is no fit, in words; then nothing else counts
};

// Throws Interrupted.
Fit fit_of(const Measurements& measured, const properties::Subject& subject, float stiffness, const FitOptions& options,
           const Monitor& monitor = {});

}  // namespace forceshade::conformance
