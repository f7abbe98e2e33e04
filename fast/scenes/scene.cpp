// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fast/scenes/pose.h"
#include "forceshade/fast.h"

namespace forceshade::fast {
namespace {

constexpr std::array<float, 3> kNotSeen{NAN, NAN, NAN};

// noted: becomes `wide` where exact numbers decide.
std::array<float, 3> seen(const scene::Pose& pose, const std::array<float, 3>& p, Stage& noted) noexcept {
  if (!is_valid(pose)) return kNotSeen;
  const std::array<float, 3> translation = quantised(pose.translation);
  if (is_unturned(pose) && translation == std::array<float, 3>{}) return p;
  if (const auto decided = seen_from<DoubleWithError>(pose, p, translation)) [[likely]]
    return *decided;
  noted = Stage::wide;
  return seen_from<meshes::Shaded>(pose, p, translation).value_or(kNotSeen);
}

// The status of a scene of which some objects have `so_far`, and another one has `status`.
mesh::TickStatus joined(mesh::TickStatus so_far, mesh::TickStatus status) noexcept {
  return std::max(so_far, status);
}
static_assert(mesh::TickStatus::free < mesh::TickStatus::touching &&
              mesh::TickStatus::touching < mesh::TickStatus::unfinished &&
              mesh::TickStatus::unfinished < mesh::TickStatus::invalid);

}  // namespace

SceneSession::SceneSession(const std::vector<GodObject>& objects) {
  if (objects.empty() || objects.size() > scene::kMostObjects)
    throw std::invalid_argument("the objects of a scene: expected 1 to " + std::to_string(scene::kMostObjects) + ", got " +
                                std::to_string(objects.size()));
  for (const GodObject& object : objects) objects_.push_back({object.open(), {}});
}

void SceneSession::advance(Object& object, const scene::Pose& pose, const std::array<float, 3>& p) noexcept {
  object.tick = object.session->tick(seen(pose, p, stage_));
  stage_ = std::max(stage_, object.session->stage());
}

scene::Tick SceneSession::tick(const std::array<float, 3>& position, std::span<const scene::Pose> poses) noexcept {
  stage_ = Stage::binary64;
  const bool is_valid = in_domain(position) && poses.size() == objects_.size();
  const std::array<float, 3> p = is_valid ? quantised(position) : kNotSeen;
  scene::Tick tick{mesh::TickStatus::free, {}};
  std::array<PlacedForce, scene::kMostObjects> forces;
  std::size_t count = 0;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    Object& object = objects_[i];
    advance(object, is_valid ? poses[i] : scene::Pose(), p);
    tick.status = joined(tick.status, object.tick.status);
    if (object.tick.force != std::array<float, 3>{}) forces[count++] = {&poses[i], object.tick.force};
  }
  if (tick.status == mesh::TickStatus::invalid || count == 0) return tick;
  const std::span<const PlacedForce> all(forces.data(), count);
  auto sum = filtered_sum(all);
  if (!sum) [[unlikely]] {
    stage_ = Stage::wide;
    sum = exact_sum(all);
  }
  tick.force = sum.value_or(std::array<float, 3>{});
  if (!sum) tick.status = mesh::TickStatus::invalid;
  return tick;
}

void SceneSession::resume(std::size_t object, const mesh::GodObject& state) noexcept {
  objects_[object].session->resume(state);
}

}  // namespace forceshade::fast
