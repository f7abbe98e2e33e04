// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object goes for the hand's position.

#include "fast/meshes/contact/goal.h"
#include "fast/meshes/walk.h"

namespace forceshade::fast {

struct Direct {
  static constexpr mesh::Contact kContact = mesh::Contact::direct;

  template <class Stages>
  FORCESHADE_INLINE static Goal move(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p,
                                     const Stages& stages) noexcept {
    Walk<Stages>(mesh, at, p, stages).run();
    return {};
  }
};

}  // namespace forceshade::fast
