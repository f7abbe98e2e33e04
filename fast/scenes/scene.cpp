// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "fast/damping/limits.h"
#include "fast/numbers/arithmetic.h"
#include "fast/scenes/pose.h"
#include "forceshade/fast.h"

namespace forceshade::fast {
namespace {

constexpr std::array<float, 3> kNotSeen{NAN, NAN, NAN};

// p: in the domain and quantised. stage: becomes `wide` where exact numbers decide.
std::array<float, 3> seen(const scene::Pose& pose, const std::array<float, 3>& p, Stage& stage) noexcept {
  if (!is_valid(pose)) return kNotSeen;
  const std::array<float, 3> translation = quantised(pose.translation);
  if (is_unturned(pose) && translation == std::array<float, 3>{}) return p;
  if (const auto decided = seen_from<DoubleWithError>(pose, p, translation)) [[likely]]
    return *decided;
  stage = Stage::wide;
  return seen_from<meshes::Shaded>(pose, p, translation).value_or(kNotSeen);
}

// The largest status of the objects is that of the scene, unless one is invalid.
static_assert(Status::free < Status::contact && Status::contact < Status::unfinished);

// answer: all but its force.
void add_forces(std::span<const PlacedForce> forces, Evaluation& answer) noexcept {
  auto sum = filtered_sum(forces);
  if (!sum) [[unlikely]] {
    answer.stage = Stage::wide;
    sum = exact_sum(forces);
  }
  if (sum)
    answer.force = Eigen::Vector3f(sum->data());
  else
    answer.status = Status::invalid;
}

}  // namespace

std::variant<SceneSession, ParameterError> SceneSession::build(std::vector<std::unique_ptr<Session>> objects) {
  if (const char* fault = arithmetic_fault_here()) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (objects.empty() || objects.size() > scene::kMostObjects)
    return ParameterError{"number of objects", "", static_cast<float>(objects.size()), 1,
                          static_cast<float>(scene::kMostObjects)};
  return SceneSession(std::move(objects));
}

Evaluation SceneSession::step(const Eigen::Vector3f& position, std::span<const scene::Pose> poses) noexcept {
  const std::array<float, 3> world{position.x(), position.y(), position.z()};
  const bool is_seen = in_domain(world) && poses.size() == objects_.size();
  const std::array<float, 3> p = quantised(world);
  Evaluation answer;
  std::array<PlacedForce, scene::kMostObjects> forces;
  std::size_t count = 0;
  bool is_valid = true;
  damping::Limits largest{0, 0};
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const std::array<float, 3> its = is_seen ? seen(poses[i], p, answer.stage) : kNotSeen;
    const Evaluation& one = answers_[i] = objects_[i]->step(Eigen::Vector3f(its.data()));
    is_valid &= one.status != Status::invalid;
    answer.status = std::max(answer.status, one.status);
    answer.stage = std::max(answer.stage, one.stage);
    if (finished(one.status) != Status::contact) continue;
    forces[count++] = {&poses[i], {one.force.x(), one.force.y(), one.force.z()}};
    largest = larger_limits(largest, one.damping);
  }
  if (count != 0) answer.damping = largest;
  if (!is_valid) answer.status = Status::invalid;
  if (finished(answer.status) == Status::contact) add_forces(std::span(forces).first(count), answer);
  return answer;
}

}  // namespace forceshade::fast
