// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/scene.h"

#include <array>
#include <cmath>

#include "forceshade/identity.h"
#include "rendering/identity/identity_json.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

// A stiffness is null where it is that of the scene, damping and drag where they are those of the path.
void add_materials(const mesh::Materials& materials, Json& json) {
  json["materials"] = Json::array();
  for (const mesh::Material& one : materials.list) {
    const Json numbers = hexfloats(std::array{one.stiffness.value_or(0), one.static_friction, one.dynamic_friction});
    json["materials"].push_back({{"stiffness_N_per_mm", one.stiffness ? numbers[0] : Json()},
                                 {"static_friction", numbers[1]},
                                 {"dynamic_friction", numbers[2]}});
    if (one.damping == damping::Limits{}) continue;
    const Json limits = hexfloats(std::array{one.damping.damping, one.damping.drag});
    json["materials"].back()["damping_N_s_per_mm"] = std::isinf(one.damping.damping) ? Json() : limits[0];
    json["materials"].back()["drag_N_s_per_mm"] = std::isinf(one.damping.drag) ? Json() : limits[1];
  }
  json["material_of_triangle"] = materials.of_triangle;
}

Json json_of(const MeshRendering& rendering) {
  Json json{{"vertices_mm", Json::array()}, {"triangles", rendering.mesh().triangles}};
  for (const mesh::Vertex& vertex : rendering.mesh().vertices) json["vertices_mm"].push_back(hexfloats(vertex));
  if (!rendering.materials.list.empty()) add_materials(rendering.materials, json);
  if (!rendering.has_corner_normals()) return json;
  json["corner_normals"] = Json::array();
  for (const auto& corners : rendering.normals) {
    Json three = Json::array();
    for (const auto& normal : corners) three.push_back(hexfloats(normal));
    json["corner_normals"].push_back(std::move(three));
  }
  return json;
}

// x, y, z in mm and the quaternion w, x, y, z of each pose.
Json json_of(const MovingObject& object) {
  Json json{
      {"name", object.name}, {"scene", scene_of(object.what)}, {"repeats", object.motion.repeats}, {"poses", Json::array()}};
  for (const scene::Pose& pose : object.motion.poses) {
    const auto& [x, y, z] = pose.translation;
    const auto& [real, i, j, k] = pose.rotation;
    json["poses"].push_back(hexfloats(std::array{x, y, z, real, i, j, k}));
  }
  return json;
}

}  // namespace

Json hexfloats(std::span<const float> numbers) {
  Json all = Json::array();
  for (const float number : numbers) all.push_back(std::isnan(number) ? "nan" : hexfloat(static_cast<double>(number)));
  return all;
}

Json scene_of(const Description& description) {
  const Identity identity = identity_of(description);
  Json json{{"kind", identity.kind}, {"name", identity.name}, {"parameters", parameters_json(identity)}};
  description.visit([](const DescribedLaw&) {},  // all of it is in the parameters
                    [&](const DescribedHeightMap& map) { json["parts"] = words_of(map.map); },
                    [&](const MeshRendering& mesh) { json["mesh"] = json_of(mesh); },
                    [&](const DescribedScene& scene) {
                      json["objects"] = Json::array();
                      for (const MovingObject& object : scene.objects) json["objects"].push_back(json_of(object));
                    });
  return json;
}

}  // namespace forceshade::conformance
