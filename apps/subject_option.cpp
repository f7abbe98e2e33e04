// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/subject_option.h"

#include "forceshade/properties/height_map_subject.h"
#include "forceshade/properties/law_subject.h"
#include "forceshade/properties/mesh_subject.h"

namespace forceshade::apps {

std::vector<std::shared_ptr<const properties::Subject>> SubjectOption::subjects() const {
  if (mesh_.is_given()) return {std::make_shared<properties::MeshSubject>(mesh_.name(), mesh_.read(law_.stiffness()))};
  if (height_map_.is_given()) {
    const float stiffness = law_.stiffness();
    const auto [map, rendering] = height_map_.read(stiffness);
    return {std::make_shared<properties::HeightMapSubject>(height_map_.name(), map, rendering, stiffness)};
  }
  const Parameters parameters = law_.parameters();
  std::vector<std::shared_ptr<const properties::Subject>> all;
  for (const LawId id : law_.laws()) all.push_back(std::make_shared<properties::LawSubject>(id, parameters));
  return all;
}

}  // namespace forceshade::apps
