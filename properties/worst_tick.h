// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks for the tick of a god-object on one mesh that takes the most (docs/god-object.md, "A tick").

#include <string>

#include "forceshade/mesh.h"

namespace forceshade::properties {

struct WorstTick {
  int looks = 0;               // at triangles, that the code counts: no fewer than those of the definition
  int moves = 0;               // of that tick
  bool is_unfinished = false;  // whether it, or another one of the search, had so many looks that it ended unfinished
};

// The worst of some hundred ticks: paths across the mesh and along it, from its vertices, edges and valleys, and from the worst
// so far. They look at some 2^20 triangles at most, so that this takes a tenth of a second, or a second where they need exact
// numbers. The same for the same input. Throws std::invalid_argument where the rendering cannot be built.
WorstTick worst_tick(const MeshRendering& rendering);

// In words, for people.
std::string words_of(const WorstTick& worst);

}  // namespace forceshade::properties
