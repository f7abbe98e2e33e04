// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a device is driven with: a renderer and the identity of what it renders. Nothing exact is built for it: the library
// links neither CGAL nor RapidCheck.
//
//   const auto built = rendering_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F});
//   const auto session = std::get<Rendering>(built).renderer.open();
//   const Eigen::Vector3f force = session->step({0, 0, -1}).force;  // N, at mm

#include <string>
#include <variant>

#include "rendering/description.h"
#include "rendering/identity/identity.h"
#include "rendering/identity/mesh_identity.h"
#include "rendering/renderer/renderer.h"

namespace forceshade {

struct Rendering {
  Identity identity;
  Renderer renderer;
};

// By the fast path. The error names the first number that is outside its domain (docs/laws.md, docs/height-maps.md,
// docs/god-object.md).
std::variant<Rendering, ParameterError> rendering_of(LawId law, const Parameters& parameters);

// name: of the map's file. stiffness: N/mm.
std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const HeightMap& map, height::Rendering rendering,
                                                     float stiffness);

// name: of the mesh's file.
std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const MeshRendering& mesh);

// Whichever of the three it is.
std::variant<Rendering, ParameterError> rendering_of(const Description& description);

}  // namespace forceshade
