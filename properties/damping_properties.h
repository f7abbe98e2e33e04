// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy of damping behind any renderer (docs/damping.md), judged in rational numbers on paths of a hand and springs that
// come and go.

#include <gmpxx.h>

#include <functional>
#include <vector>

#include "forceshade/damping.h"
#include "forceshade/properties.h"

namespace forceshade::properties {

struct DampedStep {
  Eigen::Vector3f position{0, 0, 0}, spring{0, 0, 0};  // mm, N
  damping::Limits limits = {};                         // of the face that the spring is of
};
struct DampedPath {
  damping::Parameters parameters;
  std::vector<DampedStep> steps;  // a period apart
};

// Bends and jumps of a hand, in full resolution or in counts, and springs of any direction, on faces that limit damping or not.
const Generator<DampedPath>& damped_paths();

// An answer of a damper: the damped force, N, and the velocity that it has then, mm/s.
struct DampedAnswer {
  Eigen::Vector3f force, velocity;
};
using Damper = std::function<DampedAnswer(const DampedStep& step)>;
using OpenDamper = std::function<Damper(const damping::Parameters& parameters)>;
Damper own_damper(const damping::Parameters& parameters);  // fast::Damping

// d·v ≤ -‖d‖²/max(B, B_t) in each tick, for d = F - f, but for the rounding of F.
Violation dissipates_at_its_own_velocity(const DampedPath& path, const OpenDamper& open = own_damper);

// Σ d·Δ, what damping gives to the hand while each force is held, beside its bound, mJ.
struct Sampled {
  mpq_class given = 0, bound = 0, rounding = 0;
};
Sampled sampled(const DampedPath& path, const OpenDamper& open = own_damper);
Violation sampling_gives_at_most_the_bound(const DampedPath& path, const OpenDamper& open = own_damper);

// On a line, with a spring of 64 N that comes and goes: the way that makes the inequalities of the bound's proof equalities, so
// that it comes nearest to the bound.
DampedPath nearest_to_the_bound(float share, int ticks);

// The most by which the rounding of a force to binary32 changes its product with a.
mpq_class rounding_along(const Eigen::Vector3f& force, const Eigen::Vector3f& a);

}  // namespace forceshade::properties
