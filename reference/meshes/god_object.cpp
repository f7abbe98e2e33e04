// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "forceshade/reference.h"
#include "reference/meshes/contact/all.h"
#include "reference/meshes/force.h"
#include "reference/meshes/schemes/all.h"
#include "reference/position.h"
#include "rendering/control_words.h"

namespace forceshade::reference {

struct GodObject::Parts {
  explicit Parts(const MeshRendering& rendering)
      : surface(rendering.mesh()),
        crossings(surface),
        materials(surface, rendering.materials, rendering.stiffness),
        contact(meshes::contact_of(rendering,
                                   {surface, crossings, rendering.sides, rendering.checked.self_intersections(), materials})) {}

  std::array<meshes::RootSum, 3> force(const meshes::Rest& rest) const {
    const float stiffness = materials.of(rest.r.feature).stiffness.value();
    return meshes::exact_force(scheme == nullptr ? meshes::Direction() : scheme->direction(rest), rest, stiffness);
  }

  const meshes::Surface surface;
  const meshes::Crossings crossings;
  const meshes::SurfaceMaterials materials;
  const std::unique_ptr<const meshes::ContactRule> contact;
  std::unique_ptr<const meshes::Scheme> scheme;  // null: the force is not shaded
};

std::variant<GodObject, ParameterError> GodObject::build(const MeshRendering& rendering) {
  const ExactArithmetic with_all_bits;
  if (const auto error = first_error(rendering)) return *error;
  auto parts = std::make_shared<Parts>(rendering);
  auto scheme = meshes::scheme_of(rendering, parts->surface);
  if (const auto* error = std::get_if<ParameterError>(&scheme)) return *error;
  parts->scheme = std::get<std::unique_ptr<const meshes::Scheme>>(std::move(scheme));
  return GodObject(std::move(parts));
}

mesh::Tick GodObject::step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const {
  const ExactArithmetic with_all_bits;
  if (!in_domain(Eigen::Vector3f(position.data()))) return {Status::invalid, 0, {}, before};
  const meshes::Descended end = parts_->contact->move(before, position, most_moves);
  mesh::Tick tick{end.status, static_cast<std::uint16_t>(end.moves), {}, end.after};
  if (end.rest)
    std::ranges::transform(parts_->force(*end.rest), tick.force.begin(),
                           [](const meshes::RootSum& component) { return meshes::nearest_binary32(component); });
  return tick;
}

DecimalMapForce GodObject::decimal(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned digits) const {
  const ExactArithmetic with_all_bits;
  DecimalMapForce none{"0", "0", "0", Status::invalid};
  if (!in_domain(Eigen::Vector3f(position.data()))) return none;
  const meshes::Descended end = parts_->contact->move(before, position, kMostMoves);
  if (!end.rest) {
    none.status = Status::free;
    return none;
  }
  const auto [x, y, z] = parts_->force(*end.rest);
  return {meshes::decimal(x, digits), meshes::decimal(y, digits), meshes::decimal(z, digits), Status::contact};
}

}  // namespace forceshade::reference
