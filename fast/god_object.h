// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object on a mesh in real time: state, moves and force equal the exact definition in every bit (docs/god-object.md).

#include <array>
#include <memory>
#include <variant>

#include "fast/session.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::fast {

class Mesh;

// A god-object as a servo loop drives it, which also gives the whole tick to whoever compares or records it.
class TickSession : public Session {
 public:
  // position: mm, the next one of the path. Without allocation, lock or exception.
  virtual mesh::Tick tick(const std::array<float, 3>& position) noexcept = 0;
  // Which arithmetic decided the last tick: the last stage of all its decisions.
  virtual Stage stage() const noexcept = 0;
  // Goes on from a state of this mesh, as a tick gave it. A state that is not one of this mesh counts as none.
  virtual void resume(const mesh::GodObject& state) noexcept = 0;

  // An unfinished tick is a contact, and is marked.
  Evaluation step(const Eigen::Vector3f& position) noexcept final {
    const mesh::Tick its = tick({position.x(), position.y(), position.z()});
    const Eigen::Vector3f force(its.force[0], its.force[1], its.force[2]);
    switch (its.status) {
      case mesh::TickStatus::free: return {{0, 0, 0}, Status::free, stage()};
      case mesh::TickStatus::invalid: return {{0, 0, 0}, Status::invalid, stage()};
      default: return {force, Status::contact, stage(), its.status == mesh::TickStatus::unfinished};
    }
  }
};

// Immutable and safe to share between threads; copies share the mesh.
class GodObject {
 public:
  // Refused with the reason: what first_error() refuses, a texture's height map that HeightMapField does, more than 2^26
  // triangles, and anything under an arithmetic fault (fast/numbers/arithmetic.h). Allocates.
  static std::variant<GodObject, ParameterError> build(const MeshRendering& rendering);

  // On the same mesh. stiffness: N/mm, in [10^-3, 10^3].
  std::variant<GodObject, ParameterError> with_stiffness(float stiffness) const;

  // At the beginning of a path. Allocates.
  std::unique_ptr<TickSession> open() const;

 private:
  GodObject(std::shared_ptr<const Mesh> mesh, float stiffness, mesh::Shading shading, mesh::Contact contact) noexcept
      : mesh_(std::move(mesh)), stiffness_(stiffness), shading_(shading), contact_(contact) {}

  std::shared_ptr<const Mesh> mesh_;
  float stiffness_;
  mesh::Shading shading_;
  mesh::Contact contact_;
};

}  // namespace forceshade::fast
