// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of the god-object on any set of triangles, in exact numbers (docs/soups.md).

#include <optional>

#include "reference/soups/places.h"

namespace forceshade::reference::soups {

struct State {
  std::optional<Place> place = {};  // nothing: no valid position has come yet
  Star::Name cell = {};             // where it is touching
  bool is_slipping = false;
};

// The place of a touching god-object, and of D = r - p the part that friction holds, which is 0 elsewhere.
struct Rest {
  At r;
  Vector D, tangential;
};

struct Tick {
  Status status;
  unsigned moves;
  State after;
  std::optional<Rest> rest = {};  // where it is touching
  std::size_t looks = 0;
};

// position: in the domain. most_moves: at least one.
Tick tick(const Soup& soup, const State& before, const std::array<float, 3>& position, unsigned most_moves = 256);

}  // namespace forceshade::reference::soups
