// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Properties of a god-object along its path, checked from its ticks alone, without either side's code.

#include <array>
#include <span>

#include "forceshade/identity.h"
#include "properties/rendered.h"

namespace forceshade::properties {

using MeshPosition = std::array<float, 3>;  // mm

inline Eigen::Vector3d vector_of(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// One position of a path and what it did.
struct Ticked {
  MeshPosition position;
  mesh::Tick tick;
};

// The god-object's point by its state, mm; a free one is at its own position.
Eigen::Vector3d point_of(const mesh::TriangleMesh& mesh, const mesh::GodObject& state);

// Decided exactly.
bool has_area(const mesh::TriangleMesh& mesh, std::uint32_t triangle);

// The most that the point of the state is away from the point that gave the force: two steps of the grid, mm.
double grid_reach(const mesh::TriangleMesh& mesh, const mesh::GodObject& state);

// The force is as long as the stiffness times the distance from the position to the god-object, shaded or not; where friction
// takes a part of a shaded one, no longer than that times the root of 2; zero where it is free or the position is invalid;
// finite always.
Violation force_is_as_long_as_the_spring(const MeshRendering& rendering, const Ticked& ticked);

// Two positions reached from the same state that lead to the same feature and side: the length of the force changes by no more
// than the stiffness times what position and god-object move; unshaded, so does the force. A shaded one of which friction takes
// a part is not checked.
Violation force_follows_the_spring(const MeshRendering& rendering, const Ticked& one, const Ticked& other);

// The direction of a triangle's normal, to the front, and the most that it is off: differences and products are rounded, and
// cancel where the triangle is a needle.
struct UnitNormal {
  Eigen::Vector3d direction;
  double error;
};
UnitNormal unit_normal(const mesh::TriangleMesh& mesh, std::uint32_t triangle);

// The most by which the vertex scheme turns the force of a rest inside this triangle, as a chord: |N/|N| - n/|n|| is at most
// this, for every N that is interpolated between the corners' normals. A normal at a right angle to n, or beyond, gives the
// root of 2, because no N with N·D <= 0 is used. It contains the error of its own arithmetic. 0 of a triangle without area.
double largest_turn(const MeshRendering& rendering, std::uint32_t triangle);

// Along a path of valid positions the god-object never moves away from the position: from tick to tick its distance to the new
// one is at most what it would be had it not moved. So an unshaded force gives no more energy than sampling does: over one tick
// F·(p' - p) <= (F² - F'²)/2K + K/2 |p' - p|², which is checked of the forces, too. A shaded force is as long as the spring's
// and gives at most t |F| |p' - p| more, where t is largest_turn() at a rest inside a triangle, else the root of 2
// (docs/energy.md); on a mesh that is not regular it is the root of 2 everywhere. Where materials have a stiffness of their
// own, F is that of the place before and F' counts by the length of its spring. By the contact rule sub-goal, after a rest
// inside a triangle, that distance may be 1 + 2t times as long, and F' counts for F'/(1 + 2t).
Violation spring_gives_no_energy(const MeshRendering& rendering, std::span<const Ticked> path);

}  // namespace forceshade::properties
