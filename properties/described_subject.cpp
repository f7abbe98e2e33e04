// SPDX-License-Identifier: BSD-3-Clause
#include "properties/described_subject.h"

#include "properties/height_map_subject.h"
#include "properties/law_subject.h"
#include "properties/mesh_subject.h"

namespace forceshade::properties {

std::shared_ptr<const Subject> subject_of(const Description& description) {
  if (const auto* law = std::get_if<DescribedLaw>(&description.what))
    return std::make_shared<LawSubject>(law->law, law->parameters);
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return std::make_shared<HeightMapSubject>(description.name, map->map, map->rendering, map->stiffness);
  return std::make_shared<MeshSubject>(description.name, std::get<MeshRendering>(description.what));
}

}  // namespace forceshade::properties
