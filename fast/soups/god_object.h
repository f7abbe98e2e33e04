// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The session on a soup behind the interface of the sessions on meshes.

#include <memory>

#include "fast/soups/session.h"
#include "forceshade/fast.h"

namespace forceshade::fast::soups {

// The states of one soup as numbers of constant size. What is no state counts as none.
State state_of(const mesh::GodObject& object) noexcept;
mesh::GodObject object_of(const State& state) noexcept;

std::shared_ptr<const Soup> soup_of(const MeshRendering& rendering);

class SoupSession final : public TickSession {
 public:
  // stiffness: N/mm. has_friction: the contact rule is `friction`.
  SoupSession(std::shared_ptr<const Soup> soup, float stiffness, mesh::Shading shading, bool has_friction)
      : session_(std::move(soup), stiffness, shading == mesh::Shading::vertex_scheme), has_friction_(has_friction) {}

  mesh::Tick tick(const std::array<float, 3>& position) noexcept override;
  Stage stage() const noexcept override { return stage_; }
  void resume(const mesh::GodObject& state) noexcept override { session_.resume(state_of(state)); }

 private:
  soups::Session session_;
  bool has_friction_;
  Stage stage_{};
};

}  // namespace forceshade::fast::soups
