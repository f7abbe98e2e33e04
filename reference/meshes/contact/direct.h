// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object goes for the hand's position.

#include "reference/meshes/contact/contact_rule.h"

namespace forceshade::reference::meshes {

class Direct final : public ContactRule {
 public:
  explicit Direct(const Ground& ground) : ground_(ground) {}

  Descended move(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const override {
    return descend(ground_, before, position, position, most_moves);
  }

 private:
  const Ground ground_;
};

}  // namespace forceshade::reference::meshes
