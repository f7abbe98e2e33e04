// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "forceshade/fast.h"
#include "forceshade/renderer.h"

namespace forceshade {
namespace {

template <class Fast, class... From>
std::variant<Rendering, ParameterError> rendered(const Identity& identity, float stiffness, const From&... from) {
  auto built = Fast::build(from...);
  if (auto* error = std::get_if<ParameterError>(&built)) return *error;
  return Rendering{identity, renderer_of(std::get<Fast>(built)), {}, stiffness};
}

float largest_stiffness(const MeshRendering& mesh) {
  float largest = mesh.stiffness;
  for (const mesh::Material& one : mesh.materials.list) largest = std::max(largest, one.stiffness.value_or(0));
  return largest;
}

}  // namespace

std::variant<Rendering, ParameterError> rendering_of(LawId law, const Parameters& parameters) {
  return rendered<fast::Law>(identity_of(law, parameters), parameters.stiffness, law, parameters);
}

std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const HeightMap& map, height::Mode mode,
                                                     float stiffness) {
  return rendered<fast::HeightMapField>(identity_of(name, map, mode, stiffness), stiffness, map, mode, stiffness);
}

std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const MeshRendering& mesh) {
  return rendered<fast::GodObject>(identity_of(name, mesh), largest_stiffness(mesh), mesh);
}

std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const DescribedScene& scene) {
  std::vector<MovingRenderer> objects;
  float stiffness = 0;
  for (const MovingObject& one : scene.objects) {
    auto built = rendering_of(one.what);
    if (auto* error = std::get_if<ParameterError>(&built)) return *error;
    Rendering& its = std::get<Rendering>(built);
    stiffness = std::max(stiffness, its.stiffness);
    objects.push_back({std::move(its.renderer), std::make_shared<const scene::Motion>(one.motion)});
  }
  auto built = renderer_of(std::move(objects));
  if (auto* error = std::get_if<ParameterError>(&built)) return *error;
  return Rendering{identity_of(name, scene), std::get<Renderer>(std::move(built)), static_cast<double>(scene.rate), stiffness};
}

std::variant<Rendering, ParameterError> rendering_of(const Description& description) {
  const std::string& name = description.name;
  auto built =
      description.visit([](const DescribedLaw& law) { return rendering_of(law.law, law.parameters); },
                        [&](const DescribedHeightMap& map) { return rendering_of(name, map.map, map.mode, map.stiffness); },
                        [&](const auto& other) { return rendering_of(name, other); });
  if (auto* rendering = std::get_if<Rendering>(&built)) rendering->damping = description.damping;
  return built;
}

}  // namespace forceshade
