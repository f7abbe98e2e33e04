// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of the god-object: flights and slides, each rounded to the grid, until it rests or is free (docs/god-object.md).

#include <optional>

#include "reference/meshes/crossings.h"
#include "reference/meshes/friction.h"

namespace forceshade::reference::meshes {

// The surface that a god-object moves on. All of it has to outlive the holder of this.
struct Ground {
  const Surface& surface;
  const Crossings& crossings;
  mesh::Sides sides;
  const SurfaceMaterials& materials;
};

// A rest of the god-object: r, exactly, and D = r - p, p being the hand's position. D = D_n + D_t, where D_t is along the
// surface, and 0 where friction does not hold the god-object.
struct Rest {
  SurfacePoint r;
  Vector D_over;  // D_n = D_over / D_under, in units of 2^-77 mm
  Integer D_under;
  mesh::Side side;
  Vector tangential_over = {};  // D_t times D_under
};

struct Descended {
  Status status;
  unsigned moves;
  mesh::GodObject after;
  std::optional<Rest> rest;  // where it is touching
};

// From `before`, a state on this surface, towards the goal; D is drawn from the hand's position. Both are valid, and at least
// one move is allowed.
Descended descend(const Ground& ground, const mesh::GodObject& before, const std::array<float, 3>& goal,
                  const std::array<float, 3>& position, unsigned most_moves);

}  // namespace forceshade::reference::meshes
