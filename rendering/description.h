// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is to be rendered: a law, a height map or a mesh with every number that determines its force. A renderer is built of it
// (rendering/renderer/rendering.h), and with the exact side a subject (properties/described_subject.h).

#include <string>
#include <variant>

#include "rendering/height_map.h"
#include "rendering/law.h"
#include "rendering/mesh_rendering.h"

namespace forceshade {

struct DescribedLaw {
  LawId law{};
  Parameters parameters;
};

struct DescribedHeightMap {
  HeightMap map;
  height::Rendering rendering{};
  float stiffness = 0;  // K, N/mm
};

struct Description {
  std::string name;  // for people: the law's, or that of the file of a height map or mesh
  std::variant<DescribedLaw, DescribedHeightMap, MeshRendering> what;
};

}  // namespace forceshade
