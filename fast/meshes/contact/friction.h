// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object goes for the hand's position; friction may hold it, or stop it before (docs/friction.md). The mesh has some.

#include "fast/meshes/contact/direct.h"

namespace forceshade::fast {

struct Frictional {
  static constexpr mesh::Contact kContact = mesh::Contact::friction;

  template <class Stages>
  FORCESHADE_INLINE static Goal move(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p,
                                     const Stages& stages) noexcept {
    Walk<Stages, true>(mesh, at, p, stages).run();
    return {};
  }
};

}  // namespace forceshade::fast
