// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact rule on the exact side: how the god-object follows the hand in a tick.

#include "reference/meshes/descent.h"

namespace forceshade::reference::meshes {

class ContactRule {
 public:
  virtual ~ContactRule() = default;

  // As descend(), with the goal of the rule.
  virtual Descended move(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const = 0;
};

}  // namespace forceshade::reference::meshes
