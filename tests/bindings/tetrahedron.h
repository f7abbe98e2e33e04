// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh of four triangles for tests of the C interface: closed, unshaded, K = 0.5 N/mm.

#include <array>
#include <cstdint>

#include "forceshade.h"

namespace forceshade::tests {

inline forceshade_mesh tetrahedron_mesh() {
  static constexpr std::array<float, 12> kVertices{0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9};  // mm
  static constexpr std::array<std::uint32_t, 12> kFaces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  forceshade_mesh its{};
  its.size = sizeof its;
  its.vertices = kVertices.data();
  its.vertex_count = 4;
  its.triangles = kFaces.data();
  its.triangle_count = 4;
  its.shading = "none";
  its.crease = 180;
  its.stiffness = 0.5F;
  return its;
}

}  // namespace forceshade::tests
