// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/schemes/all.h"

#include <stdexcept>
#include <utility>

#include "reference/meshes/schemes/edge_scheme.h"
#include "reference/meshes/schemes/texture_scheme.h"
#include "reference/meshes/schemes/vertex_scheme.h"

namespace forceshade::reference::meshes {

std::variant<std::unique_ptr<const Scheme>, ParameterError> scheme_of(const MeshRendering& rendering, const Surface& surface) {
  switch (rendering.shading) {
    case mesh::Shading::none: return nullptr;
    case mesh::Shading::vertex_scheme: return std::make_unique<const VertexScheme>(surface, rendering.normals);
    case mesh::Shading::edge_scheme: return std::make_unique<const EdgeScheme>(surface);
    case mesh::Shading::texture_scheme: {
      auto map = HeightMapField::build({rendering.texture.map.parts}, height::Mode::force_shaded, 1);
      if (const auto* error = std::get_if<ParameterError>(&map)) return *error;
      return std::make_unique<const TextureScheme>(surface, rendering.normals, rendering.texture.corners,
                                                   std::get<HeightMapField>(std::move(map)));
    }
  }
  throw std::logic_error("a shading scheme that the exact side's list lacks");
}

}  // namespace forceshade::reference::meshes
