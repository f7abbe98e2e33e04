// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties.h"
#include "rendering/control_words.h"

namespace forceshade::properties {

std::unique_ptr<Subject> subject_of(const Description& description) {
  const ExactArithmetic with_all_bits;
  if (const auto* law = std::get_if<DescribedLaw>(&description.what)) return law_subject(law->law, law->parameters);
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return height_map_subject(description.name, map->map, map->mode, map->stiffness);
  if (const auto* scene = std::get_if<DescribedScene>(&description.what)) return scene_subject(description.name, *scene);
  return mesh_subject(description.name, std::get<MeshRendering>(description.what));
}

}  // namespace forceshade::properties
