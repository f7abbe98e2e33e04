// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object of one rendering, whatever its mesh is.

#include <array>
#include <memory>
#include <optional>

#include "forceshade/mesh.h"
#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {

struct ExactTick {
  mesh::Tick tick;                              // without its force
  std::optional<std::array<RootSum, 3>> force;  // where it is touching
};

class Ticks {
 public:
  virtual ~Ticks() = default;
  // position: in the domain. before: a state of this mesh.
  virtual ExactTick tick(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const = 0;
};

}  // namespace forceshade::reference::meshes
