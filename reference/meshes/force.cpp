// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/force.h"

#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {
std::array<float, 3> unshaded_force(const Rest& rest, float stiffness) {
  const Integer K = integer_of(stiffness, kFloatScale);
  std::array<float, 3> force{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    force[axis] = nearest_binary32({K * rest.D_over[axis], rest.D_under}, -kFloatScale - kLengthScale);
  return force;
}

std::array<float, 3> shaded_force(const Direction& seen_from_front, const Rest& rest, float stiffness) {
  if (!seen_from_front) return unshaded_force(rest, stiffness);
  const Vector N = rest.side == mesh::Side::back ? -*seen_from_front : *seen_from_front;
  if (dot(N, rest.D_over) <= 0) return unshaded_force(rest, stiffness);
  // The square of a component is K² |D|² N_i² / |N|².
  const Integer K = integer_of(stiffness, kFloatScale);
  const Integer size_over = K * K * dot(rest.D_over, rest.D_over), under = rest.D_under * rest.D_under * dot(N, N);
  std::array<float, 3> force{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float size = nearest_binary32_root({size_over * N[axis] * N[axis], under}, -kFloatScale - kLengthScale);
    force[axis] = N[axis] < 0 && size != 0 ? -size : size;
  }
  return force;
}

}  // namespace forceshade::reference::meshes
