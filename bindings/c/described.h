// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Makes descriptions from the arrays that a binding has read, and subjects from descriptions: no array is read here.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "forceshade/error.h"
#include "forceshade/fast.h"
#include "forceshade/identity.h"
#include "forceshade/renderer.h"

namespace forceshade::c {

// The most samples of a grid along x or y and in all, and the largest height in mm.
inline constexpr std::int64_t kMostAlong = 1 << 15, kMostSamples = 1 << 26;
inline constexpr float kLargestHeight = 1e4F;

// The words for enumerations, in their order.
inline constexpr std::array<std::string_view, 2> kInterpolants{"bilinear", "cubic-spline"}, kEdges{"clamp", "tile"};
inline constexpr auto kModeNames = [] {
  std::array<std::string_view, height::kModes.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = height::kModes[i].name;
  return names;
}();
// All but the scheme of textures, which a mesh of arrays has no corners for.
std::vector<std::string_view> shading_names();

// values: heights in mm, within kLargestHeight, from the smallest y and x. Throws Interrupted.
Description described(height::Grid samples, height::Mode mode, float stiffness, const Monitor& monitor = {});

// The reason why a mesh cannot have these, in words; empty where it can.
std::string refusal_of(const mesh::CheckedMesh& triangles, mesh::Shading shading, mesh::Contact contact);

// sides: default: front for a closed mesh and both for another. crease: degrees, 0 to 180.
Description described(const mesh::CheckedMesh& triangles, std::optional<mesh::Sides> sides, mesh::Shading shading,
                      mesh::Contact contact, double crease, float stiffness, mesh::Materials materials = {});

// A subject with its renderer. field answers one position without a detour; renderer has the batch call and opens sessions.
struct Subject {
  Identity identity;
  std::variant<fast::Law, fast::HeightMapField, fast::GodObject> field;
  Renderer renderer;
  damping::Described damping = {};
  bool is_regular = true;  // false: a mesh that is any set of triangles
  bool limits_damping = false;
};

std::variant<Subject, ParameterError> build(const Description& description);

// Throws Error for a scene with motions, of which a binding makes no subject: a program gives the poses of each tick itself.
inline void expect_still(const Description& description) {
  if (description.moves())
    throw Error(description.name +
                ": expected no object with a motion here; a session of a scene takes the poses of each tick");
}

}  // namespace forceshade::c
