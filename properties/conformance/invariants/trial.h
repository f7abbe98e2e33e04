// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer on a scene, and the paths on which its invariants are looked at.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "forceshade/properties.h"
#include "properties/conformance/distance.h"
#include "properties/conformance/scene_renderer.h"

namespace forceshade::conformance {

using Path = std::vector<Eigen::Vector3f>;  // mm, from no contact

// Straight down from the air: the exact side is free at its beginning and above it, and touches at its end.
struct Approach {
  Eigen::Vector3f air, contact;

  Path line(const SceneRenderer& renderer, int steps) const;  // both ends included
};
struct Trial {
  const Description& description;
  const properties::Subject& subject;                     // of the description
  std::function<SceneRenderer(const Description&)> open;  // opens the renderer anew, on this scene
  SceneRenderer& renderer;                                // opened on the description
  std::uint64_t seed = 1;
  const Monitor& monitor;
  std::vector<Approach> approaches = {};  // of approaches_to(); empty where none was found
  Tolerance tolerance = {};               // of what is compared with the definition

  std::span<const Approach> first_approaches(std::size_t most) const {
    return std::span(approaches).first(std::min(most, approaches.size()));
  }
  std::string why_no_approach() const {
    return moves() ? "the objects move, so that a place is in contact in some ticks alone" : "no position in contact was found";
  }
  bool moves() const { return description.moves(); }
  // The number of ticks in which damping forgets any speed that this hand can have: 2^52 of the least, e^36.05
  // (docs/damping.md).
  std::size_t settling() const {
    const auto& damping = renderer.hello().damping;
    return damping ? static_cast<std::size_t>(37 / damping->share) + 3 : 0;
  }
  bool is_mesh() const { return std::holds_alternative<MeshRendering>(description.what); }
};

// Positions of the stream by which the subject is certified, in the renderer's domain.
Path drawn_path(const Trial& trial, std::size_t size, std::uint64_t seed);

// As many as the invariants look at; none where objects move.
std::vector<Approach> approaches_to(const Trial& trial);

// From 1 mm before the middle of a triangle to half a millimetre behind it.
Path through_triangle(const mesh::TriangleMesh& mesh, std::size_t triangle, const SceneRenderer& renderer);

// True if a hand could notice the difference of two forces (N): 0.1 % of the larger one, and more than 0.1 mN, which is less
// than a fingertip notices.
bool differ(const Eigen::Vector3f& one, const Eigen::Vector3f& other);

bool same_bits(const Eigen::Vector3f& one, const Eigen::Vector3f& other);

// "0.25 N", the length of a force.
std::string newtons(const Eigen::Vector3f& force);

}  // namespace forceshade::conformance
