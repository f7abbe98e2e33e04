// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/god_object.h"

#include "fast/meshes/session.h"
#include "fast/numbers/arithmetic.h"
#include "forceshade/fast.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::fast {
namespace {

std::optional<ParameterError> error_of_soup(const MeshRendering& rendering) {
  if (const char* const fault = arithmetic_fault_here()) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (const auto error = first_error_of_any(rendering)) return error;
  const std::size_t triangles = rendering.mesh().triangles.size();
  if (triangles <= Mesh::kMostTriangles) return std::nullopt;
  return ParameterError{"number of triangles", "", static_cast<float>(triangles), 1, Mesh::kMostTriangles};
}

}  // namespace

std::variant<GodObject, ParameterError> GodObject::build(const MeshRendering& rendering) {
  if (!rendering.checked.is_regular()) {
    if (const auto error = error_of_soup(rendering)) return *error;
    return GodObject(nullptr, soups::soup_of(rendering), rendering.stiffness, rendering.shading, rendering.contact);
  }
  auto mesh = Mesh::build(rendering);
  if (const auto* error = std::get_if<ParameterError>(&mesh)) return *error;
  return GodObject(std::make_shared<const Mesh>(std::get<Mesh>(std::move(mesh))), nullptr, rendering.stiffness,
                   rendering.shading, rendering.contact);
}

std::variant<GodObject, ParameterError> GodObject::with_stiffness(float stiffness) const {
  if (const auto error = error_of_stiffness(stiffness)) return *error;
  return GodObject(mesh_, soup_, stiffness, shading_, contact_);
}

std::unique_ptr<TickSession> GodObject::open() const {
  if (soup_ != nullptr)
    return std::make_unique<soups::SoupSession>(soup_, stiffness_, shading_, contact_ == mesh::Contact::friction);
  return std::make_unique<MeshSession>(mesh_, stiffness_, shading_, contact_);
}

mesh::Tick GodObject::tick(const mesh::GodObject& state, const std::array<float, 3>& position) const noexcept {
  if (soup_ != nullptr) {
    soups::SoupSession session(soup_, stiffness_, shading_, contact_ == mesh::Contact::friction);
    session.resume(state);
    return session.tick(position);
  }
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
