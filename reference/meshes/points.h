// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Points of the surface with exact parameters, and how they are rounded to grid points.

#include "reference/meshes/surface.h"

namespace forceshade::reference::meshes {

// On an edge t is the first parameter; in a triangle they are β and γ; at a vertex there is none.
struct SurfacePoint {
  Feature feature;
  std::array<Fraction, 2> parameter;
};

SurfacePoint exactly(const GridPoint& point);

// The point nearest to p of a triangle's plane, of an edge's line, or the vertex.
SurfacePoint foot(const Surface& surface, const Feature& feature, const Vector& p);

// True if it is inside its feature, its border excluded.
bool is_inside(const SurfacePoint& point);

// from + λ (to - from), with 2^24 λ, both points of the plane of one triangle or the line of one edge as foot() gives them.
SurfacePoint part_of_way(const SurfacePoint& from, const SurfacePoint& to, const Integer& share);

// A point of a triangle's side, t from the side's first corner to its second, both included.
SurfacePoint on_side(const Surface& surface, std::size_t triangle, std::size_t side, const Fraction& t);

// The nearest grid points around it on its own feature; of these the one nearest to p. Equal: the smaller first, then the
// smaller second parameter.
GridPoint rounded_towards(const Surface& surface, const SurfacePoint& point, const Vector& p);

// Each parameter to the nearest grid point, ties to even, but inside the feature.
GridPoint rounded_inside(const SurfacePoint& point);

}  // namespace forceshade::reference::meshes
