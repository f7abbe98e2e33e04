// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Subjects for tests of the C interface: the thesis's bumps and a closed mesh of four triangles; and the state of a beginning.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "forceshade.h"

namespace forceshade::tests {

inline forceshade_subject law_of(const std::string& name) {
  const forceshade_law parameters{sizeof parameters, 15.24F, 25.4F, 0.5F};
  forceshade_subject made{};
  EXPECT_EQ(forceshade_law_new(name.c_str(), &parameters, &made), FORCESHADE_OK) << forceshade_message();
  return made;
}

// Unshaded, K = 0.5 N/mm.
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
inline forceshade_subject tetrahedron(const char* shading, bool is_rough = false) {
  forceshade_material rough{};
  rough.size = sizeof rough;
  rough.static_friction = 0.6F;
  rough.dynamic_friction = 0.3F;
  forceshade_mesh mesh = tetrahedron_mesh();
  mesh.shading = shading;
  mesh.materials = &rough;
  mesh.material_count = is_rough ? 1 : 0;
  forceshade_subject made{};
  EXPECT_EQ(forceshade_mesh_new(&mesh, &made), FORCESHADE_OK) << forceshade_message();
  return made;
}

// size: of the struct, as the program has it.
inline forceshade_state beginning(std::size_t size = sizeof(forceshade_state)) {
  forceshade_state state{};
  state.size = size;
  return state;
}

}  // namespace forceshade::tests
