// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The work of a height map's force on the hand along a path, as guaranteed enclosures (docs/energy.md, "Height maps"). The
// field is that of the formulas at real positions: the position quantum, a rule for reading binary32, has no part in it.

#include <optional>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/reference.h"
#include "reference/enclosure.h"

namespace forceshade::reference {

// The formula of the field's potential, mJ; nothing where closed paths are not known to generate nothing: true heights have one
// where every part is a plane or level, shaded ones where that holds of the surface too, and both have one gradient.
std::optional<std::string> potential(const HeightMapField& law);

// All that follows throws NotEnclosed where a map is too steep or too fine to be enclosed at all, and Interrupted when the
// monitor stops it.

// mJ, along the polyline through the points, mm, in the position domain; to ten digits or more of each segment.
Interval work(const HeightMapField& law, const std::vector<Eigen::Vector3f>& path, const Monitor& monitor = {});

// A vertical plane through the map. The stroke of a hand lies in one.
struct Slice {
  enum class Along { x, y };
  Along along = Along::x;
  float at = 0;                     // mm: the other coordinate
  float from = -12.7F, to = 12.7F;  // mm; `to` is not in it: a line there belongs to what lies beyond
};

// The suprema, in mJ, over simple loops in the slice, from one end of it to the other, that are nowhere deeper than `depth`
// below the surface that the depth is measured from. Counter-clockwise: along the slice to the right, z up.
struct SliceBound {
  Interval counter_clockwise, clockwise;
  Interval most() const;  // the larger
};
SliceBound loop_bound(const HeightMapField& law, const Slice& slice, float depth, const Monitor& monitor = {});

// The error of a slice or a depth. The least depth is 10^-4 of the largest coordinate a loop may have: below, the
// binary32 points of a witness are too coarse.
std::optional<ParameterError> slice_error(const HeightMapField& law, const Slice& slice, float depth);

// A simple polygon in the slice, closed and no deeper than `depth`, that generates nearly the bound, for most maps 99 % of it
// (docs/energy.md); no point where no loop generates as much as 10^-12 K·depth².
std::vector<Eigen::Vector3f> witness(const HeightMapField& law, const Slice& slice, float depth, const Monitor& monitor = {});

}  // namespace forceshade::reference
