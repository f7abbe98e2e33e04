// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties.h"
#include "rendering/control_words.h"

namespace forceshade::properties {

std::unique_ptr<Subject> subject_of(const Description& description) {
  const ExactArithmetic with_all_bits;
  const std::string& name = description.name;
  return description.visit(
      [](const DescribedLaw& law) { return law_subject(law.law, law.parameters); },
      [&](const DescribedHeightMap& map) { return height_map_subject(name, map.map, map.mode, map.stiffness); },
      [&](const MeshRendering& mesh) { return mesh_subject(name, mesh); },
      [&](const DescribedScene& scene) { return scene_subject(name, scene); });
}

}  // namespace forceshade::properties
