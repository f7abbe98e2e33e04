// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One god-object on its path over a mesh.

#include <memory>
#include <utility>

#include "fast/meshes/advance.h"
#include "forceshade/fast.h"

namespace forceshade::fast {

// advance() in binary64 first, which raises `stage` to the last one that it needs. Its code takes long to compile, so there is
// one copy.
void advance_filtered(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, float stiffness, mesh::Shading shading,
                      mesh::Contact contact, Stage& stage, mesh::Tick& tick) noexcept;

// It also keeps a ball in which no triangle lies: a free god-object that stays in it meets nothing, and no tree is looked at.
// That saves time and changes no result. One thread at a time; the mesh may be shared.
class MeshSession final : public TickSession {
 public:
  // stiffness: N/mm, in [10^-3, 10^3]. The mesh has what the shading and the contact rule use.
  MeshSession(std::shared_ptr<const Mesh> mesh, float stiffness, mesh::Shading shading,
              mesh::Contact contact = mesh::kUsualContact) noexcept
      : mesh_(std::move(mesh)), stiffness_(stiffness), shading_(shading), contact_(contact_in(*mesh_, contact)) {}

  mesh::Tick tick(const std::array<float, 3>& position) noexcept override {
    stage_ = Stage::binary64;
    if (!in_domain(position)) [[unlikely]] {
      mesh::Tick tick;
      tick.after = state();
      return tick;
    }
    const std::array<float, 3> p = quantised(position);
    before_ = last_;
    last_ = p;
    if (!stays_free(p)) return tick_on_mesh(p);
    const std::uint16_t moves = p == at_.grid_point.position ? 0 : 1;
    at_.grid_point.position = p;
    if (off_centre(p) > renew_square_) seek_ball();
    mesh::Tick tick{Status::free, moves, {}, {}};
    tick.after.place = mesh::Place::free;
    tick.after.position = p;
    return tick;
  }

  Stage stage() const noexcept override { return stage_; }

  // It takes the tick to where the hand arrives if it goes on as in the last one, and forgets the result.
  void look_ahead() noexcept override;

  // The fault of session.cpp, as arithmetic_fault_here() of fast/numbers/arithmetic.h. Under a fault no mesh is built.
  static const char* arithmetic_fault() noexcept;

  mesh::GodObject state() const noexcept { return object_of(*mesh_, at_); }
  void resume(const mesh::GodObject& state) noexcept override {
    at_ = arrival_of(*mesh_, state, contact_);
    square_ = 0;
    is_seeking_ = false;
  }

 private:
  // mm². p: in the domain and quantised, as the mesh and the ball's centre are.
  FORCESHADE_INLINE double off_centre(const std::array<float, 3>& p) const noexcept {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = static_cast<double>(p[i]) - centre_[i];
      square += off * off;
    }
    return square;
  }
  // The ball's radius leaves room for these roundings.
  FORCESHADE_INLINE bool is_in_ball(const std::array<float, 3>& p) const noexcept { return off_centre(p) < square_; }
  // True if the god-object is free and the ball proves that it still is when it has followed the hand to p.
  FORCESHADE_INLINE bool stays_free(const std::array<float, 3>& p) const noexcept {
    return at_.grid_point.place == mesh::Place::free && is_in_ball(p);
  }

  mesh::Tick tick_on_mesh(const std::array<float, 3>& p) noexcept;
  void seek_ball() noexcept;

  std::shared_ptr<const Mesh> mesh_;
  float stiffness_;
  mesh::Shading shading_;
  Arrival at_;
  std::array<float, 3> last_{}, before_{};  // mm: the positions of the last two ticks, quantised
  std::array<double, 3> centre_{};          // mm, of the ball
  double square_ = 0;                       // mm², of its radius; 0: there is none
  double renew_square_ = 0;                 // mm²: farther from the centre than this, the next ball is sought
  int ticks_until_ball_ = 0;                // while small balls would be left at once
  bool is_seeking_ = false;
  Stage stage_{};
  BoxTree::Search search_;
  mesh::Contact contact_;
};

}  // namespace forceshade::fast
