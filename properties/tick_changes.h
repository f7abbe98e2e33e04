// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The most that the force of a god-object on one mesh can change from a tick to the next (docs/energy.md, "Between two ticks").

#include <array>
#include <string>

#include "forceshade/checks.h"
#include "properties/mesh_properties.h"

namespace forceshade::properties {

// The hand moves `step` at most from one tick to the next. At both, the god-object rests with a force, at most `depth` off.
struct HandStep {
  double depth = 1;   // mm, more than 0
  double step = 0.1;  // mm, more than 0: a hand at 100 mm/s with 1000 ticks a second
};

// The bound for any two such ticks, but for refused moves and for rests that a rounding of the state brings about; and the
// most that was found.
struct Change {
  double bound = 0, found = 0;
  std::array<MeshPosition, 2> at{};  // mm: the positions of the hand that were found
};

struct TickChanges {
  Change force;         // N: the length of the difference of both forces
  Change turn;          // degrees, the angle between both
  unsigned moves = 0;   // the most of one tick that was found, in all that was tried
  bool is_own = false;  // whether the bounds are this mesh's; else it has too many triangles, or is not regular, and they are
                        // those of any mesh
};

// rendering: with a bound of its energy (why_no_energy_bound() in mesh_energy.h). The same for the same input. Throws
// Interrupted.
TickChanges tick_changes(const MeshRendering& rendering, const HandStep& hand, const Monitor& monitor);

// In words, for people.
std::string words_of(const TickChanges& changes, const HandStep& hand);

}  // namespace forceshade::properties
