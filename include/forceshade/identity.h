// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The identity of what was rendered: for certificates, recordings and summaries, and to tell if two renderers are the same.
// The library is forceshade::identity, of the component run; it needs OpenSSL.
//
//   const Identity bump = identity_of(LawId::bump_2p, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F});
//   const std::string words = parameters_in_words(bump);  // "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm"
//   const bool is_same = bump.is_same(identity_of(LawId::wall, {.stiffness = 0.5F}));  // false
//
// Identities are values. The functions keep no state, and throw nothing but std::bad_alloc.
//
// Not promised: that a digest says who made a file; it protects against mistakes, not against forgery (docs/certificate.md).

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "forceshade/description.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"

namespace forceshade {

inline constexpr const char kLawKind[] = "law", kHeightMapKind[] = "height map", kMeshKind[] = "mesh", kSceneKind[] = "scene";

// Binary32 numbers are kept as numbers, so that they compare as such; words are for choices, such as a rendering.
using IdentityValue = std::variant<float, std::string>;

struct Identity {
  std::string kind;  // kLawKind, kHeightMapKind, kMeshKind, kSceneKind, or that of a subject of another kind
  std::string name;  // of a law; of a height map the name of its file
  // The parameters, in the order in which they are written; the keys end in their units: "stiffness_N_per_mm".
  std::vector<std::pair<std::string, IdentityValue>> parameters;
  std::string digest = {};  // SHA-256, in hex, of what name and parameters leave out; empty where they leave out nothing

  // The same but for the parameters. A name counts only where there is no digest: files may be renamed.
  bool is_alike(const Identity& other) const {
    return kind == other.kind && digest == other.digest && (!digest.empty() || name == other.name);
  }
  // True if both have the same parameters, in whatever order they stand.
  bool has_parameters_of(const Identity& other) const;
  bool is_same(const Identity& other) const { return is_alike(other) && has_parameters_of(other); }

  // Null where no parameter has that key.
  const IdentityValue* parameter(std::string_view key) const;
};

// The wall's parameter is its stiffness alone.
Identity identity_of(LawId law, const Parameters& parameters);

// The digest is that of the kind and every number of every part, grid values included.
Identity identity_of(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness);

// name: of the mesh's file. The digest is that of every coordinate, index and normal, and of a texture: of the points and
// gradients of its corners and of its height map.
Identity identity_of(const std::string& name, const MeshRendering& rendering);

// name: of the scene's file. The digest is that of the objects' identities and of every pose.
Identity identity_of(const std::string& name, const DescribedScene& scene);

// The identity of any of these.
Identity identity_of(const Description& description);

// The law and parameters of the identity of a law; nothing where it is of another kind, or lacks one of the law's parameters.
struct LawAndParameters {
  LawId law;
  Parameters parameters;
};
std::optional<LawAndParameters> law_of(const Identity& identity);

// "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm".
std::string parameters_in_words(const Identity& identity);

// True for a height map whose direction is no unit vector, but longer where the map is steeper.
bool is_conservative_map(const Identity& identity);

// A parameter's value as text that reads back as the same.
std::string text_of(const IdentityValue& value);

// One line for each part: "gaussian: x_mm 0, y_mm 0, height_mm 3, sigma_mm 5".
std::vector<std::string> words_of(const HeightMap& map);

}  // namespace forceshade
