// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The answer of a shading scheme in real time.

#include "fast/meshes/rest_numbers.h"

namespace forceshade::fast::meshes {

// `none`: the scheme gives no direction there, and the force is the unshaded one; `unknown`: these numbers cannot decide it.
enum class ShadingOutcome { direction, none, unknown };

template <class N>
struct ShadingDirection {
  ShadingOutcome outcome = ShadingOutcome::none;
  Vector3<N> direction{};  // of any length
};

template <class N>
ShadingDirection<N> from_its_side(mesh::Side side, const Vector3<N>& direction) noexcept {
  return {ShadingOutcome::direction, side == mesh::Side::front ? direction : opposite(direction)};
}

}  // namespace forceshade::fast::meshes
