// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/god_object.h"

#include <algorithm>
#include <utility>

#include "forceshade/reference.h"
#include "reference/meshes/contact/all.h"
#include "reference/meshes/force.h"
#include "reference/meshes/schemes/all.h"
#include "reference/meshes/ticks.h"
#include "reference/position.h"
#include "rendering/control_words.h"

namespace forceshade::reference {

namespace meshes {
namespace {

class RegularTicks final : public Ticks {
 public:
  explicit RegularTicks(const MeshRendering& rendering)
      : surface_(rendering.mesh()),
        crossings_(surface_),
        materials_(surface_, rendering.materials, rendering.stiffness),
        contact_(contact_of(rendering, {surface_, crossings_, rendering.sides, materials_})),
        scheme_(scheme_of(rendering, surface_)) {}

  std::optional<ParameterError> error() const {
    const auto* error = std::get_if<ParameterError>(&scheme_);
    return error == nullptr ? std::nullopt : std::optional(*error);
  }

  ExactTick tick(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const override {
    const Descended end = contact_->move(before, position, most_moves);
    ExactTick tick{{end.status, static_cast<std::uint16_t>(end.moves), {}, end.after}, {}};
    if (!end.rest) return tick;
    const auto& scheme = std::get<std::unique_ptr<const Scheme>>(scheme_);
    const mesh::Material its = materials_.of(end.rest->r.feature);
    tick.force = exact_force(scheme == nullptr ? Direction() : scheme->direction(*end.rest), *end.rest, its.stiffness.value());
    tick.tick.damping = its.damping;
    return tick;
  }

 private:
  const Surface surface_;
  const Crossings crossings_;
  const SurfaceMaterials materials_;
  const std::unique_ptr<const ContactRule> contact_;
  const std::variant<std::unique_ptr<const Scheme>, ParameterError> scheme_;  // null: the force is not shaded
};

}  // namespace
}  // namespace meshes

std::variant<GodObject, ParameterError> GodObject::build(const MeshRendering& rendering) {
  const ExactArithmetic with_all_bits;
  if (const auto error = first_error_of_any(rendering)) return *error;
  if (!rendering.checked.is_regular()) return GodObject(soups::ticks_of(rendering));
  auto ticks = std::make_shared<const meshes::RegularTicks>(rendering);
  if (const auto error = ticks->error()) return *error;
  return GodObject(std::move(ticks));
}

mesh::Tick GodObject::step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const {
  const ExactArithmetic with_all_bits;
  if (!in_domain(Eigen::Vector3f(position.data()))) return {Status::invalid, 0, {}, before};
  meshes::ExactTick made = ticks_->tick(before, position, most_moves);
  if (made.force)
    std::ranges::transform(*made.force, made.tick.force.begin(),
                           [](const meshes::RootSum& component) { return meshes::nearest_binary32(component); });
  return made.tick;
}

DecimalMapForce GodObject::decimal(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned digits) const {
  const ExactArithmetic with_all_bits;
  DecimalMapForce none{"0", "0", "0", Status::invalid};
  if (!in_domain(Eigen::Vector3f(position.data()))) return none;
  const meshes::ExactTick made = ticks_->tick(before, position, kMostMoves);
  if (!made.force) {
    none.status = Status::free;
    return none;
  }
  const auto& [x, y, z] = *made.force;
  return {meshes::decimal(x, digits), meshes::decimal(y, digits), meshes::decimal(z, digits), Status::contact};
}

}  // namespace forceshade::reference
