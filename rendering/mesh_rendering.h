// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reasons why a god-object on a mesh cannot be built: the domain of a MeshRendering, for both sides.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "rendering/damping_range.h"

namespace forceshade {

inline std::optional<ParameterError> error_of_stiffness(float stiffness) {
  if (stiffness >= 0.001F && stiffness <= 1000) return std::nullopt;
  return ParameterError{"stiffness", "N/mm", stiffness, 0.001F, 1000};
}

// A limit of a material.
inline std::optional<ParameterError> error_of_damping(float damping) {
  if (is_damping(damping) || damping == HUGE_VALF) return std::nullopt;
  return ParameterError{"damping of a material", "N·s/mm", damping, kLeastDamping, kMostDamping, nullptr, "0 or inf"};
}

inline constexpr float kLeastFriction = 0x1p-10F, kMostFriction = 0x1p10F;  // of those that are neither 0 nor infinite

inline bool is_friction(float coefficient) {
  return coefficient == 0 || coefficient == HUGE_VALF || (coefficient >= kLeastFriction && coefficient <= kMostFriction);
}

inline bool has_friction(const mesh::Materials& materials) {
  return std::ranges::any_of(materials.list, [](const mesh::Material& one) { return one.static_friction > 0; });
}

inline bool has_own_stiffness(const mesh::Materials& materials) {
  return std::ranges::any_of(materials.list, [](const mesh::Material& one) { return one.stiffness.has_value(); });
}

inline bool has_own_damping(const mesh::Materials& materials) {
  return std::ranges::any_of(materials.list, [](const mesh::Material& one) { return one.damping != damping::Limits{}; });
}

// That of a triangle.
inline mesh::Material material_of(const mesh::Materials& materials, std::size_t triangle) {
  if (materials.list.empty()) return {};
  return materials.list[materials.of_triangle.empty() ? 0 : materials.of_triangle[triangle]];
}

// The reason why a mesh of so many triangles cannot have these materials. friction: the contact rule uses their coefficients.
inline std::optional<ParameterError> error_of_materials(const mesh::Materials& materials, std::size_t triangles,
                                                        bool friction) {
  for (const mesh::Material& material : materials.list) {
    if (material.stiffness)
      if (const auto error = error_of_stiffness(*material.stiffness)) return error;
    for (const float coefficient : {material.static_friction, material.dynamic_friction})
      if (!is_friction(coefficient))
        return ParameterError{"coefficient of friction, if not 0 or infinite,", "", coefficient, kLeastFriction, kMostFriction};
    for (const float its : {material.damping.damping, material.damping.drag})
      if (const auto error = error_of_damping(its)) return error;
    if (material.dynamic_friction > material.static_friction)
      return ParameterError{"dynamic coefficient of friction", "", material.dynamic_friction, 0, material.static_friction};
    if (material.static_friction > 0 && !friction)
      return ParameterError{"static coefficient of friction by another contact rule than friction", "",
                            material.static_friction, 0, 0};
  }
  const std::size_t assigned = materials.of_triangle.size();
  if (assigned != 0 && assigned != triangles) {
    const auto expected = static_cast<float>(triangles);
    return ParameterError{"number of triangles with a material", "", static_cast<float>(assigned), expected, expected};
  }
  for (const std::uint32_t index : materials.of_triangle)
    if (index >= materials.list.size())
      return ParameterError{"number of a material", "", static_cast<float>(index), 0,
                            static_cast<float>(materials.list.size()) - 1};
  return std::nullopt;
}

// A shading or contact rule that docs/soups.md does not define.
struct Undefined {
  std::string_view key, expected, got;  // "shading" or "contact"

  std::string words() const {
    return std::string("expected ").append(expected).append(" for a mesh that is not regular, got \"").append(got) + '"';
  }
};

inline std::optional<Undefined> undefined_of(const mesh::CheckedMesh& triangles, mesh::Shading shading, mesh::Contact contact) {
  if (triangles.is_regular()) return std::nullopt;
  if (has_corner_normals(contact)) return Undefined{"contact", "direct or friction", name_of(contact)};
  const bool is_of_normals = has_corner_normals(shading) && shading != mesh::Shading::texture_scheme;
  if (shading == mesh::Shading::none || is_of_normals) return std::nullopt;
  return Undefined{"shading", "vertex or none", name_of(shading)};
}

// The reason for refusal, but for those that the texture's height map has itself: the stiffness; the materials; on a mesh that
// is not regular, a shading or contact rule that docs/soups.md does not have; normals that are not one for each corner, with
// components in [-2, 2], where the shading or the contact rule uses them; the same of a texture, with points within 10^4 mm and
// gradients of 0 or of 2^-30 to 1000 mm/mm.
inline std::optional<ParameterError> first_error_of_any(const MeshRendering& rendering) {
  const auto outside = [](const char* name, const char* unit, float value, float most) -> std::optional<ParameterError> {
    if (std::fabs(value) <= most) return std::nullopt;
    return ParameterError{name, unit, value, -most, most};
  };
  const std::size_t triangles = rendering.mesh().triangles.size();
  const auto other_count = [&](const char* name, std::size_t count) -> std::optional<ParameterError> {
    const auto expected = static_cast<float>(triangles);
    if (count == triangles) return std::nullopt;
    return ParameterError{name, "", static_cast<float>(count), expected, expected};
  };
  if (const auto error = error_of_stiffness(rendering.stiffness)) return error;
  const bool is_frictional = rendering.contact == mesh::Contact::friction;
  if (const auto error = error_of_materials(rendering.materials, triangles, is_frictional)) return error;
  if (const auto undefined = undefined_of(rendering.checked, rendering.shading, rendering.contact))
    return undefined->key == "contact"
               ? ParameterError{"contact rule of a mesh that is not regular, by its number,", "", 1, 0, 0}
               : ParameterError{"shading of a mesh that is not regular, by its number,", "",
                                static_cast<float>(rendering.shading), 0, 1};
  if (!rendering.has_corner_normals()) return std::nullopt;
  if (const auto error = other_count("number of triangles with normals", rendering.normals.size())) return error;
  for (const auto& corners : rendering.normals)
    for (const mesh::Normal& normal : corners)
      for (const float component : normal)
        if (const auto error = outside("component of a normal", "", component, 2)) return error;
  if (rendering.shading != mesh::Shading::texture_scheme) return std::nullopt;
  if (const auto error = other_count("number of triangles with texture", rendering.texture.corners.size())) return error;
  constexpr float kLeast = 0x1p-30F, kMost = 1000;  // mm/mm
  for (const auto& corners : rendering.texture.corners)
    for (const mesh::CornerTexture& corner : corners) {
      for (const float coordinate : corner.point)
        if (const auto error = outside("texture coordinate", "mm", coordinate, 10000)) return error;
      for (const mesh::Normal& gradient : {corner.gradient_x, corner.gradient_y})
        for (const float component : gradient) {
          if (const auto error = outside("gradient of a texture coordinate", "mm/mm", component, kMost)) return error;
          if (component != 0 && std::fabs(component) < kLeast)
            return ParameterError{"size of a gradient of a texture coordinate", "mm/mm", std::fabs(component), kLeast, kMost};
        }
    }
  return std::nullopt;
}

// The same, for what is of regular meshes alone.
inline std::optional<ParameterError> first_error(const MeshRendering& rendering) {
  if (!rendering.checked.is_regular())
    return ParameterError{"kind of the mesh (0: regular, 1: any set of triangles)", "", 1, 0, 0};
  return first_error_of_any(rendering);
}

}  // namespace forceshade
