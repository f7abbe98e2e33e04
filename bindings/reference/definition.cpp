// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/reference/definition.h"

#include <memory>

#include "bindings/c/batch.h"
#include "bindings/c/described.h"
#include "bindings/c/strided.h"

namespace forceshade::exact {
namespace {

Answer answer_of(const reference::Rounded& rounded) {
  return {rounded.force, c::status_of(rounded.status)};
}

Answer answer_of(const mesh::Tick& tick) {
  return {Eigen::Vector3f(tick.force.data()), c::status_of(tick.status)};
}

}  // namespace

std::variant<Definition, ParameterError> Definition::build(const Description& description) {
  c::expect_still(description);
  const auto made = [](auto built) -> std::variant<Definition, ParameterError> {
    if (const auto* error = std::get_if<ParameterError>(&built)) return *error;
    return Definition(What(std::get<0>(std::move(built))));
  };
  if (const auto* law = std::get_if<DescribedLaw>(&description.what))
    return made(reference::Law::build(law->law, law->parameters));
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return made(reference::HeightMapField::build(map->map, map->mode, map->stiffness));
  return made(reference::GodObject::build(std::get<MeshRendering>(description.what)));
}

Decimals Definition::decimals(const Eigen::Vector3f& position, unsigned digits) const {
  if (const auto* law = std::get_if<reference::Law>(&what_)) {
    const reference::DecimalForce force = law->decimal(position, digits);
    return {{force.x, "0", force.z}, c::status_of(force.status)};
  }
  const reference::DecimalMapForce force = std::get<reference::HeightMapField>(what_).decimal(position, digits);
  return {{force.x, force.y, force.z}, c::status_of(force.status)};
}

int Definition::compare(const Eigen::Vector3f& position, std::size_t axis, const std::string& rational) const {
  const auto* law = std::get_if<reference::Law>(&what_);
  if (law == nullptr) return std::get<reference::HeightMapField>(what_).compare(position, axis, rational);
  if (axis != 1) return law->compare(position, axis, rational);
  // No law has a component along y.
  return rational.starts_with("0/") || rational.starts_with("-0/") ? 0 : rational.starts_with('-') ? 1 : -1;
}

std::function<Answer(const Eigen::Vector3f& position)> Definition::along_a_path() const {
  if (const auto* god_object = std::get_if<reference::GodObject>(&what_))
    return [session = std::make_shared<reference::GodObjectSession>(*god_object)](const Eigen::Vector3f& at) {
      return answer_of(session->step({at.x(), at.y(), at.z()}));
    };
  if (const auto* law = std::get_if<reference::Law>(&what_))
    return [law](const Eigen::Vector3f& at) { return answer_of(law->round_to_binary32(at)); };
  const auto* map = &std::get<reference::HeightMapField>(what_);
  return [map](const Eigen::Vector3f& at) { return answer_of(map->round_to_binary32(at)); };
}

Eigen::Vector3f position_of(const forceshade_batch& batch, std::size_t index) {
  Eigen::Vector3f position;
  for (std::size_t axis = 0; axis < 3; ++axis)
    position[static_cast<Eigen::Index>(axis)] =
        *c::at(batch.positions, index, batch.position_stride, axis, batch.position_component);
  return position;
}

std::size_t fill(const forceshade_batch& batch, const std::function<Answer(const Eigen::Vector3f& position)>& answer) {
  std::size_t invalid = 0;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const Answer given = answer(position_of(batch, i));
    for (std::size_t axis = 0; axis < 3; ++axis)
      *c::at(batch.forces, i, batch.force_stride, axis, batch.force_component) = given.force[static_cast<Eigen::Index>(axis)];
    if (batch.statuses != nullptr) *c::at(batch.statuses, i, batch.status_stride) = given.status;
    invalid += given.status == FORCESHADE_INVALID ? 1 : 0;
  }
  return invalid;
}

std::variant<reference::DecimalGeometry, ParameterError> geometry(float radius, float width, unsigned digits) {
  const Parameters parameters{radius, width, 1};
  // It looks whether they are in their domain.
  const auto built = reference::Law::build(LawId::cylinder, parameters);
  if (const auto* error = std::get_if<ParameterError>(&built)) return *error;
  return reference::geometry(parameters, digits);
}

}  // namespace forceshade::exact
