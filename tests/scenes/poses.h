// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random poses of an object over time, and where its points are in the world, about.

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "forceshade/scene.h"

namespace forceshade::tests {

// R a + translation, rounded.
inline std::array<float, 3> about_in_world(const scene::Pose& pose, const std::array<float, 3>& a) {
  std::array<double, 4> q{};
  double square = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = static_cast<double>(pose.rotation[i]);
    square += q[i] * q[i];
  }
  const auto [w, x, y, z] = q;
  const std::array<double, 3> p{static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
  const std::array<double, 3> turned{
      (w * w + x * x - y * y - z * z) * p[0] + 2 * (x * y - w * z) * p[1] + 2 * (x * z + w * y) * p[2],
      2 * (x * y + w * z) * p[0] + (w * w - x * x + y * y - z * z) * p[1] + 2 * (y * z - w * x) * p[2],
      2 * (x * z - w * y) * p[0] + 2 * (y * z + w * x) * p[1] + (w * w - x * x - y * y + z * z) * p[2]};
  std::array<float, 3> world{};
  for (std::size_t i = 0; i < 3; ++i)
    world[i] = static_cast<float>(turned[i] / square + static_cast<double>(pose.translation[i]));
  return world;
}

// An endless, repeatable motion: at rest, small steps, quarter turns, jumps, quaternions of few bits and of components 2^31
// apart, and now and then a pose that is invalid for one tick.
class PosePath {
 public:
  explicit PosePath(std::uint64_t seed) : draws_(seed) {}

  scene::Pose next() {
    switch (whole(24)) {
      case 0: pose_ = random_pose(); break;
      case 1: pose_ = {{}, quarter_turn()}; break;
      case 2: pose_.rotation = {few_bits(), few_bits(), few_bits(), few_bits()}; break;
      case 3: pose_.rotation = {1, between(-0x1p-27F, 0x1p-27F), 0, std::ldexp(1.0F, -static_cast<int>(whole(31)))}; break;
      case 4: return invalid();
      case 5:
      case 6:
      case 7:
        for (float& one : pose_.translation) one += between(-0.05F, 0.05F);
        for (float& one : pose_.rotation) one += between(-0.01F, 0.01F);
        break;
      default: break;
    }
    pose_ = mended(pose_);
    return pose_;
  }

 private:
  std::uint64_t whole(std::uint64_t below) { return draws_() % below; }
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(draws_); }
  float few_bits() { return static_cast<float>(static_cast<int>(whole(5)) - 2); }
  std::array<float, 4> quarter_turn() {
    std::array<float, 4> q{1, 0, 0, 0};
    q[1 + whole(3)] = whole(2) == 0 ? 1.0F : -1.0F;
    return q;
  }
  scene::Pose random_pose() {
    scene::Pose pose;
    for (float& one : pose.translation) one = between(-60, 60);
    for (float& one : pose.rotation) one = between(-2, 2);
    return pose;
  }
  scene::Pose invalid() {
    scene::Pose pose = pose_;
    switch (whole(6)) {
      case 0: pose.rotation = {}; break;
      case 1: pose.rotation[whole(4)] = 2.0001F; break;
      case 2: pose.rotation[whole(4)] = 0x1p-31F; break;
      case 3: pose.rotation[whole(4)] = NAN; break;
      case 4: pose.translation[whole(3)] = 10000.001F; break;
      default: pose.translation[whole(3)] = -INFINITY; break;
    }
    return pose;
  }
  static scene::Pose mended(scene::Pose pose) {
    bool is_turned = false;
    for (float& one : pose.rotation) {
      one = std::fabs(one) < 0x1p-30F ? 0 : std::fmax(-2.0F, std::fmin(2.0F, one));
      is_turned |= one != 0;
    }
    if (!is_turned) pose.rotation = {1, 0, 0, 0};
    return pose;
  }

  std::mt19937_64 draws_;
  scene::Pose pose_;
};

}  // namespace forceshade::tests
