// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The invariants of a recording, without a definition and, where there is one, with the exact forces beside it.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

struct Pace {
  double seconds = 0, rate = 0;                         // from the first to the last sample; Hz, of the median interval
  double rate_of_positions = 0;                         // Hz, at which a hand that moves has new ones; 0 if it never moves
  double median = 0, p99 = 0, longest = 0, jitter = 0;  // s, of the intervals; jitter: their mean distance from the median
  std::size_t repeats = 0;                              // samples at the position of the one before
  double noise = 0;                                     // N, root mean square of what the force changed by at these
};

// mm: the median of the steps that are not zero; 0 of a hand that never moves.
double usual_step_of(const Measurements& measured);

Pace pace_of(const Measurements& measured);

// The deviations that are allowed.
struct Allowed {
  double force = 0;   // N, that a measured force may be off by
  double energy = 0;  // mJ, that a loop may give
};

// The exact force (N) at each sample where it is known; empty where there is no definition.
using ExactForces = std::vector<std::optional<Eigen::Vector3d>>;

std::vector<Invariant> invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed);

// The two of energy, which are among those.
std::vector<Invariant> energy_invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed);

}  // namespace forceshade::conformance
