// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The places of a hand while the god-object of a mesh rests with a force: convex regions, and the force in each of them
// (docs/energy.md, "Between two ticks").

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::properties {

// The points p with direction · p >= least.
struct HalfSpace {
  Eigen::Vector3d direction;  // of length 1
  double least;               // mm
  bool is_exit = false;       // of a region: where the hand goes beyond it, the god-object leaves the place
};

// A linear function of a position, plus a constant.
struct Affine {
  Eigen::Matrix3d factor;
  Eigen::Vector3d constant;

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return factor * p + constant; }
};

// While the hand stays inside of the exits, the god-object stays on its triangle, edge or vertex.
struct RestRegion {
  std::vector<HalfSpace> borders = {};        // around it; it is bounded
  std::vector<Eigen::Vector3d> corners = {};  // mm, of it
  Eigen::Vector3d low = {}, high = {};        // mm, of a box around it
  Affine D;                                   // mm, from the position to the god-object; it grows no faster than the position
  std::optional<Eigen::Vector3d> out = {};    // of a triangle's inside: the unit vector that D is along
  std::vector<Eigen::Vector3d> directions = {};  // the force is along a sum of these unit vectors, with factors of 0 or more;
                                                 // without any, its direction is not bounded
  std::optional<Affine> normal = {};             // that the force is along, where this is interpolated in a triangle
  double least_normal = 0;                       // no more than the length of the normal where the god-object rests
};

// A triangle, seen from the front or from behind.
struct Face {
  std::array<Eigen::Vector3d, 3> corners;  // mm
  Eigen::Vector3d out;                     // the unit normal of that side
  std::vector<std::uint32_t> regions;      // in which the god-object rests on the triangle, its edges or its vertices
  std::vector<std::uint32_t> beside;       // the faces over a common edge
};

struct RestRegions {
  std::vector<RestRegion> all;
  std::vector<std::uint32_t> face_of;               // one on which the god-object rests in this region
  std::vector<Face> faces;                          // where both sides block motion, those of a triangle follow each other
  std::vector<std::array<Eigen::Vector3d, 2>> rim;  // mm: the ends of its edges
  bool has_two_sides = false;
};

// The regions in which the god-object rests at most `depth` (mm) from the hand, but for refused moves and for rests that a
// rounding of the state brings about. A flat edge or vertex has no region of its own: there D is as in the triangles beside it.
// rendering: with a bound of its energy (why_no_energy_bound() in mesh_energy.h).
RestRegions rest_regions(const MeshRendering& rendering, double depth);

// The sine by which the second triangle rises in front of the plane of the first, seen from their common edge. n: the unit
// normal of the first. one, other: the half-edges of both along this edge (rendering/half_edges.h).
double rise_beside(const mesh::TriangleMesh& mesh, const Eigen::Vector3d& n, std::uint32_t one, std::uint32_t other);

// Unit vectors along the half-edges.
std::vector<Eigen::Vector3d> edges_from(const mesh::TriangleMesh& mesh, const std::vector<std::uint32_t>& half_edges);

// Unit vectors along the extreme rays of all D with D·e >= 0 for each of these unit vectors: each is at a right angle to two of
// them. Nothing where these are more than 64.
std::optional<std::vector<Eigen::Vector3d>> extreme_rays(const std::vector<Eigen::Vector3d>& edges);

// Calls take(corner) for each corner of what the half-spaces have in common, which must be bounded. A point that is outside by
// less than `slack` (mm) counts as inside, and by more where borders are nearly parallel. about: a point near it, from which
// its coordinates are computed.
void for_each_corner(std::vector<HalfSpace> borders, const Eigen::Vector3d& about, double slack,
                     const std::function<void(const Eigen::Vector3d&)>& take);

}  // namespace forceshade::properties
