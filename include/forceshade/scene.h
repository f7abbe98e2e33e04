// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Objects that are placed anew in every tick: numbers only. Their meaning: docs/scenes.md.
//
//   const scene::Pose quarter_turn{.translation = {0, 0, 40}, .rotation = {1, 0, 0, 1}};  // about z, 40 mm up
//   const auto wall = renderer_of(std::get<fast::Law>(fast::Law::build(LawId::wall, {15.24F, 25.4F, 0.5F})));
//   std::vector<std::unique_ptr<fast::Session>> objects;  // of laws, height maps and meshes
//   for (int i = 0; i < 2; ++i) objects.push_back(wall.open());
//   auto session = std::get<fast::SceneSession>(fast::SceneSession::build(std::move(objects)));
//   const Eigen::Vector3f force = session.step({3, 0, 39}, std::array{scene::Pose(), quarter_turn}).force;
//
// Lengths are in mm, forces in N, both in the world's axes, those of docs/laws.md.
//
// Not promised: that objects feel each other, or that poses follow from any physics.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace forceshade::scene {

// The most objects of a scene: the exact sum of so many turned forces has room in the numbers of the real-time path.
inline constexpr std::size_t kMostObjects = 32;

// The pose of an object: its point a is at R a + translation in the world, with the exact rotation R = A/(w² + x² + y² + z²) of
// the quaternion, A₁₁ = w² + x² - y² - z², A₁₂ = 2(xy - wz), ..., which need not have length 1.
struct Pose {
  std::array<float, 3> translation{};         // mm, each within 10^4; one below 2^-30 in size is read as 0
  std::array<float, 4> rotation{1, 0, 0, 0};  // w, x, y, z: each 0 or of a size from 2^-30 to 2, and not all 0

  bool operator==(const Pose&) const = default;
};

// The pose of an object in each tick of a path, the first of which is tick 0.
struct Motion {
  std::vector<Pose> poses{Pose()};  // of tick 0, 1, ...; one at least
  bool repeats = false;             // after the last pose comes the first again; else the last one stays

  const Pose& at(std::uint64_t tick) const noexcept {
    const std::uint64_t size = poses.size();
    return poses[static_cast<std::size_t>(repeats ? tick % size : std::min(tick, size - 1))];
  }
};

}  // namespace forceshade::scene
