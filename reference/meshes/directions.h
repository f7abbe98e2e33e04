// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// In which way the surface goes from one of its points, seen from a direction u: along it, and on which side of it u points.

#include "reference/meshes/surface.h"

namespace forceshade::reference::meshes {

// The kinds of a direction u at a point: it lies on the surface, passes it at the rim, or points to one side.
enum class DirectionKind { on, open, front, back };

// With v the unit direction along the surface that has the largest u·v.
struct Directions {
  DirectionKind way;
  Feature along;   // the triangle or the edge in which v lies
  bool is_nearer;  // u·v > 0: along v a point that is off by u comes nearer
  bool is_tied;    // another direction has the same u·v, so that the numbering decides
};

// At any point of the feature; u is not 0.
Directions directions(const Surface& surface, const Feature& feature, const Vector& u);

}  // namespace forceshade::reference::meshes
