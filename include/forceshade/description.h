// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is to be rendered: a law, a height map or a mesh with every number that determines its force.
//
//   const Description bump{"bump-2p", DescribedLaw{LawId::bump_2p, {15.24F, 25.4F, 0.5F}}};  // mm, mm, N/mm
//   const auto built = rendering_of(bump);  // of renderer.h
//   const auto session = std::get<Rendering>(built).renderer.open();
//
// Not promised: that a number is in its domain, which is looked at when a renderer is built.

#include <string>
#include <variant>

#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"

namespace forceshade {

struct DescribedLaw {
  LawId law{};
  Parameters parameters;
};

struct DescribedHeightMap {
  HeightMap map;
  height::Mode mode{};
  float stiffness = 0;  // K, N/mm
};

struct Description {
  std::string name;  // for people: the law's, or that of the file of a height map or mesh
  std::variant<DescribedLaw, DescribedHeightMap, MeshRendering> what;

  // K, N/mm.
  float stiffness() const {
    if (const auto* law = std::get_if<DescribedLaw>(&what)) return law->parameters.stiffness;
    if (const auto* map = std::get_if<DescribedHeightMap>(&what)) return map->stiffness;
    return std::get<MeshRendering>(what).stiffness;
  }
};

}  // namespace forceshade
