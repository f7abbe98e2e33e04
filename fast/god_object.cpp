// SPDX-License-Identifier: BSD-3-Clause
#include "fast/meshes/session.h"
#include "forceshade/fast.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::fast {

std::variant<GodObject, ParameterError> GodObject::build(const MeshRendering& rendering) {
  auto mesh = Mesh::build(rendering);
  if (const auto* error = std::get_if<ParameterError>(&mesh)) return *error;
  return GodObject(std::make_shared<const Mesh>(std::get<Mesh>(std::move(mesh))), rendering.stiffness, rendering.shading,
                   rendering.contact);
}

std::variant<GodObject, ParameterError> GodObject::with_stiffness(float stiffness) const {
  if (const auto error = error_of_stiffness(stiffness)) return *error;
  return GodObject(mesh_, stiffness, shading_, contact_);
}

std::unique_ptr<TickSession> GodObject::open() const {
  return std::make_unique<MeshSession>(mesh_, stiffness_, shading_, contact_);
}

mesh::Tick GodObject::tick(const mesh::GodObject& state, const std::array<float, 3>& position) const noexcept {
  const mesh::Contact contact = contact_in(*mesh_, contact_);
  Arrival at = arrival_of(*mesh_, state, contact);
  mesh::Tick tick;
  if (in_domain(position)) {
    Stage stage{};
    advance_filtered(*mesh_, at, quantised(position), stiffness_, shading_, contact, stage, tick);
  }
  tick.after = object_of(*mesh_, at);
  return tick;
}

}  // namespace forceshade::fast
