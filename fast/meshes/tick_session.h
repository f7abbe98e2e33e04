// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A god-object as a servo loop drives it, which also gives the whole tick to whoever compares or records it.

#include <memory>

#include "forceshade/fast/meshes/session.h"
#include "forceshade/fast/session.h"

namespace forceshade::fast {

class TickSession : public Session {
 public:
  // position: mm, the next one of the path. Without allocation, lock or exception.
  virtual mesh::Tick tick(const std::array<float, 3>& position) noexcept = 0;
  // Which arithmetic decided the last tick: the last stage of all its decisions.
  virtual Stage stage() const noexcept = 0;
  // Goes on from a state of this mesh, as a tick gave it.
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

class GodObjectSession final : public TickSession {
 public:
  // stiffness: N/mm, in [10^-3, 10^3].
  GodObjectSession(std::shared_ptr<const Mesh> mesh, float stiffness, mesh::Shading shading) noexcept
      : session_(std::move(mesh), stiffness, shading) {}

  mesh::Tick tick(const std::array<float, 3>& position) noexcept override { return session_.step(position); }
  Stage stage() const noexcept override { return session_.stage(); }
  void resume(const mesh::GodObject& state) noexcept override { session_.resume(state); }
  void look_ahead() noexcept override { session_.look_ahead(); }

 private:
  MeshSession session_;
};

}  // namespace forceshade::fast
