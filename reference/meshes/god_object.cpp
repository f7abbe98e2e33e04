// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "forceshade/reference.h"
#include "reference/meshes/contact/all.h"
#include "reference/meshes/force.h"
#include "reference/meshes/schemes/all.h"
#include "reference/position.h"

namespace forceshade::reference {

struct GodObject::Parts {
  explicit Parts(const MeshRendering& rendering)
      : surface(rendering.mesh()),
        crossings(surface),
        contact(meshes::contact_of(rendering, {surface, crossings, rendering.sides, rendering.checked.self_intersections()})),
        stiffness(rendering.stiffness) {}

  std::array<float, 3> force(const meshes::Rest& rest) const {
    return scheme == nullptr ? meshes::unshaded_force(rest, stiffness)
                             : meshes::shaded_force(scheme->direction(rest), rest, stiffness);
  }

  // In so many decimal digits.
  DecimalMapForce decimal(const meshes::Rest& rest, unsigned digits) const {
    const auto exact = meshes::exact_force(scheme == nullptr ? meshes::Direction() : scheme->direction(rest), rest, stiffness);
    return {meshes::decimal(exact[0], digits), meshes::decimal(exact[1], digits), meshes::decimal(exact[2], digits),
            Status::contact};
  }

  const meshes::Surface surface;
  const meshes::Crossings crossings;
  const std::unique_ptr<const meshes::ContactRule> contact;
  const float stiffness;
  std::unique_ptr<const meshes::Scheme> scheme;  // null: the force is not shaded
};

std::variant<GodObject, ParameterError> GodObject::build(const MeshRendering& rendering) {
  if (const auto error = first_error(rendering)) return *error;
  auto parts = std::make_shared<Parts>(rendering);
  auto scheme = meshes::scheme_of(rendering, parts->surface);
  if (const auto* error = std::get_if<ParameterError>(&scheme)) return *error;
  parts->scheme = std::get<std::unique_ptr<const meshes::Scheme>>(std::move(scheme));
  return GodObject(std::move(parts));
}

mesh::Tick GodObject::step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const {
  if (!in_domain(Eigen::Vector3f(position.data()))) return {mesh::TickStatus::invalid, 0, {}, before};
  const meshes::Descended end = parts_->contact->move(before, position, most_moves);
  mesh::Tick tick{end.status, static_cast<std::uint16_t>(end.moves), {}, end.after};
  if (end.rest) tick.force = parts_->force(*end.rest);
  return tick;
}

DecimalMapForce GodObject::decimal(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned digits) const {
  DecimalMapForce none{"0", "0", "0", Status::invalid};
  if (!in_domain(Eigen::Vector3f(position.data()))) return none;
  const meshes::Descended end = parts_->contact->move(before, position, kMostMoves);
  if (end.rest) return parts_->decimal(*end.rest, digits);
  none.status = Status::free;
  return none;
}

}  // namespace forceshade::reference
