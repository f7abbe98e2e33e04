// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The work of a law's force on the hand along a path, exactly, as guaranteed enclosures (docs/energy.md). The field is that of
// the formulas at real positions: the position quantum, a rule for reading binary32, has no part in it.

#include <optional>
#include <string>
#include <vector>

#include "forceshade/reference.h"
#include "reference/enclosure.h"

namespace forceshade::reference {

struct PathPoint {
  float x, z;  // mm, in the position domain
};

// mJ, along the polyline through the points: closed antiderivatives, cut where the law has a kink or a jump. A segment that
// runs along a line of jump feels the side the line belongs to.
Interval work(const Law& law, const std::vector<PathPoint>& path);

// κ = ∂F_z/∂x - ∂F_x/∂z, mJ/mm²: what a small loop generates counter-clockwise (x right, z up) for its area. On a line where
// formulas meet, that of the side the line belongs to. |x| < R.
Interval circulation_density(const Law& law, const PathPoint& at);

// A vertical line on which F_z jumps, x > 0; its mirror image jumps the other way.
struct LineTerm {
  Interval x;     // mm
  Interval rise;  // (F_z just right - F_z just left)/(K·depth): what a counter-clockwise loop generates on the line
};
std::vector<LineTerm> line_terms(const Law& law);

// The formula of the law's potential, mJ; nothing where the law is active.
std::optional<std::string> potential(const Law& law);

// The suprema, in mJ, over simple closed paths no deeper than `depth` below the nominal surface; 0 where a law is conservative.
struct LoopBound {
  Interval counter_clockwise, clockwise;  // of those at x >= 0, A⁺ and A⁻ of docs/energy.md
  Interval anywhere;                      // A⁺ + A⁻
};
LoopBound loop_bound(const Law& law, float depth);

// depth: mm, from R/10^4 (the wall: 10^-3) to 10^4. Below, the binary32 points of a witness are too coarse.
std::optional<ParameterError> depth_error(const Law& law, float depth);

// A simple polygon, closed and no deeper than `depth`, that generates 99 % of the bound or more; no point where that is 0.
std::vector<PathPoint> witness(const Law& law, float depth);

}  // namespace forceshade::reference
