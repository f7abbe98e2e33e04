// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The truth about a god-object on a mesh: every decision the sign of an integer, the force rounded once to binary32
// (docs/meshes.md).

#include <array>
#include <memory>
#include <optional>
#include <variant>

#include "forceshade/vocabulary/law.h"
#include "forceshade/vocabulary/mesh.h"

namespace forceshade::reference {

// Immutable and safe to share between threads; copies share the mesh.
class GodObject {
 public:
  static constexpr unsigned kMostMoves = 256;  // in a tick

  // The vertex scheme needs finite normals, the texture scheme these and a texture, the other shadings neither. That the
  // triangles meet in nothing but what they share is a precondition; with self-intersections allowed, that of those that share
  // a vertex. Refused with the reason: a stiffness outside 10^-3 to 10^3
  // N/mm, what is no surface, and a texture whose numbers are outside their domain (docs/meshes.md).
  static std::variant<GodObject, ParameterError> build(
      const mesh::TriangleMesh& mesh, mesh::CornerNormals normals, mesh::Sides sides, mesh::Shading shading, float stiffness,
      const mesh::Texture& texture = {}, mesh::SelfIntersections self_intersections = mesh::SelfIntersections::refused);

  // Why build() refuses what is given beside the mesh.
  static std::optional<ParameterError> first_error(const mesh::TriangleMesh& mesh, const mesh::CornerNormals& normals,
                                                   mesh::Shading shading, float stiffness, const mesh::Texture& texture = {});

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
