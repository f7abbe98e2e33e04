// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The truth about a god-object on a mesh: every decision the sign of an integer, the force rounded once to binary32
// (docs/god-object.md).

#include <array>
#include <memory>
#include <optional>
#include <variant>

#include "rendering/mesh_rendering.h"

namespace forceshade::reference {

// Immutable and safe to share between threads; copies share the mesh.
class GodObject {
 public:
  static constexpr unsigned kMostMoves = 256;  // in a tick

  // Refused with the reason: what first_error() refuses, and a texture's height map that HeightMapField does.
  static std::variant<GodObject, ParameterError> build(const MeshRendering& rendering);

  // What a position in mm does to a state of this mesh. A position that is invalid gives no force and leaves the state as it
  // is. 1 <= most_moves; with fewer than kMostMoves, more ticks are unfinished.
  mesh::Tick step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves = kMostMoves) const;

 private:
  struct Parts;
  explicit GodObject(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

  std::shared_ptr<const Parts> parts_;
};

// A god-object that follows positions in order.
class GodObjectSession {
 public:
  explicit GodObjectSession(GodObject god_object, const mesh::GodObject& state = {})
      : god_object_(std::move(god_object)), state_(state) {}

  mesh::Tick step(const std::array<float, 3>& position) {
    const mesh::Tick tick = god_object_.step(state_, position);
    state_ = tick.after;
    return tick;
  }
  const mesh::GodObject& state() const { return state_; }

 private:
  GodObject god_object_;
  mesh::GodObject state_;
};

}  // namespace forceshade::reference
