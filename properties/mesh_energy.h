// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy that the shading of one mesh can give to the hand in the limit of small steps (docs/energy.md, "For one mesh"),
// and a loop along which it gives much of this.

#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/identity.h"
#include "properties/mesh_properties.h"

namespace forceshade::properties {

// The reason why this rendering has no such bound: what was expected, and what it has; empty where there is one.
std::string why_no_energy_bound(const MeshRendering& rendering);

// Upper bounds of what the vertex scheme turns a force by, as chords, 0 to √2, by where the god-object rests, in the limit of
// small steps and of a fine grid of its state. Each contains the error of its own arithmetic. At the rim it never rests with a
// force. On a mesh that is not regular, `edges` and `vertices` are √2, and inside is where no triangle of another plane is.
struct LargestTurns {
  std::vector<double> of_triangle;  // inside of each
  double inside = 0;                // of all triangles
  double inside_at_least = 0;       // approached by turns inside of one triangle: a lower bound of the largest
  double edges = 0, vertices = 0;

  double most() const;
};

// rendering: with a bound.
LargestTurns largest_turns(const MeshRendering& rendering);

// A closed path that begins and ends free: into the surface at one point of a triangle, along it, out at another point, and
// back above it.
struct MeshStroke {
  std::uint32_t triangle = 0;         // of the file, in which it was drawn
  std::vector<MeshPosition> corners;  // mm
  double length = 0;                  // mm
  double along = 0;                   // mm of it: the way along the surface under force
  // mJ: the sum of F·Δp over the ticks with the binary32 forces of the fast path, in 100 decimal digits, rounded once.
  double work = 0;
  double sampling = 0;  // mJ: K/2 Σ|Δp|², the most of the work that comes from the length of the steps
  std::size_t ticks = 0;

  double rate() const { return length > 0 ? (work - sampling) / length : 0; }  // mJ/mm: of the shading
};

// The stroke of the largest rate among those that are tried: in the triangles with the largest turns, between corners and
// centre. depth: of the god-object from the hand, at most, mm. length: of the stroke, at most, mm. No corners where none gives
// energy. Throws Interrupted.
MeshStroke best_stroke(const MeshRendering& rendering, const LargestTurns& turns, double depth, double length,
                       const Monitor& monitor);

}  // namespace forceshade::properties
