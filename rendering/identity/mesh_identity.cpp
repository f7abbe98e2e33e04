// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "forceshade/identity.h"
#include "rendering/identity/digest.h"
#include "rendering/mesh_rendering.h"
#include "text/number_text.h"

namespace forceshade {
namespace {

// "0.4, 0.3", the static and the dynamic coefficient; "up to 0.6" of several materials.
std::string words_of_friction(const std::vector<mesh::Material>& materials) {
  if (materials.size() == 1)
    return shortest(materials.front().static_friction) + ", " + shortest(materials.front().dynamic_friction);
  return "up to " + shortest(std::ranges::max(materials, {}, &mesh::Material::static_friction).static_friction);
}

void add_materials(const mesh::Materials& materials, Digest& digest) {
  digest.line("materials " + std::to_string(materials.list.size()));
  for (const mesh::Material& one : materials.list) {
    digest.line(one.stiffness ? "with a stiffness" : "without a stiffness");
    digest.number(one.stiffness.value_or(0));
    digest.number(one.static_friction);
    digest.number(one.dynamic_friction);
  }
  if (has_own_damping(materials))
    for (const mesh::Material& one : materials.list) {
      digest.line("with damping");
      digest.number(one.damping.damping);
      digest.number(one.damping.drag);
    }
  digest.line("triangles with a material " + std::to_string(materials.of_triangle.size()));
  for (const std::uint32_t material : materials.of_triangle) digest.whole(material);
}

}  // namespace

Identity identity_of(const std::string& name, const MeshRendering& rendering) {
  Digest digest;
  const auto line = [&](const char* what, std::size_t count) { digest.line(what + (' ' + std::to_string(count))); };
  line("vertices", rendering.mesh().vertices.size());
  for (const mesh::Vertex& vertex : rendering.mesh().vertices)
    for (const float coordinate : vertex) digest.number(coordinate);
  line("triangles", rendering.mesh().triangles.size());
  for (const mesh::Triangle& triangle : rendering.mesh().triangles)
    for (const std::uint32_t vertex : triangle) digest.whole(vertex);
  line("normals", rendering.normals.size());
  for (const auto& corners : rendering.normals)
    for (const mesh::Normal& normal : corners)
      for (const float component : normal) digest.number(component);
  if (!rendering.texture.corners.empty()) {
    line("texture", rendering.texture.corners.size());
    for (const auto& corners : rendering.texture.corners)
      for (const mesh::CornerTexture& corner : corners) {
        for (const float coordinate : corner.point) digest.number(coordinate);
        for (const mesh::Normal& gradient : {corner.gradient_x, corner.gradient_y})
          for (const float component : gradient) digest.number(component);
      }
    digest.line("map " + identity_of("", rendering.texture.map, height::Mode::force_shaded, 1).digest);
  }
  // Leaves usual choices out, so that earlier certificates and recordings, from before such a choice, are still the same.
  const bool is_regular = rendering.checked.is_regular();
  if (!is_regular) digest.line("any set of triangles");
  const bool has_own_contact = rendering.contact != mesh::kUsualContact;
  if (has_own_contact) digest.line("contact " + std::string(name_of(rendering.contact)));
  const std::vector<mesh::Material>& materials = rendering.materials.list;
  const bool has_materials = std::ranges::any_of(materials, [](const mesh::Material& one) { return one != mesh::Material{}; });
  if (has_materials) add_materials(rendering.materials, digest);
  Identity identity{kMeshKind,
                    name,
                    {{"sides", std::string(name_of(rendering.sides))},
                     {"shading", std::string(name_of(rendering.shading))},
                     {"stiffness_N_per_mm", rendering.stiffness}},
                    digest.hex()};
  if (!is_regular) identity.parameters.push_back({"triangles", std::string("any set")});
  if (has_own_contact) identity.parameters.push_back({"contact", std::string(name_of(rendering.contact))});
  if (has_friction(rendering.materials)) identity.parameters.push_back({"friction", words_of_friction(materials)});
  if (has_own_stiffness(rendering.materials) || has_own_damping(rendering.materials) || (has_materials && materials.size() > 1))
    identity.parameters.push_back({"materials", std::to_string(materials.size())});
  return identity;
}

}  // namespace forceshade
