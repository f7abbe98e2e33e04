// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A shading scheme on the exact side: the direction that a rest's force is turned to.

#include <memory>
#include <optional>

#include "reference/meshes/descent.h"

namespace forceshade::reference::meshes {

// A direction of any length, as it is seen from in front; none where a scheme gives none.
using Direction = std::optional<Vector>;

class Scheme {
 public:
  virtual ~Scheme() = default;

  virtual Direction direction(const Rest& rest) const = 0;
};

}  // namespace forceshade::reference::meshes
