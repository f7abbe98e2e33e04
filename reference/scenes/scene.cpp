// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "forceshade/reference.h"
#include "reference/meshes/rounding.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

using meshes::Fraction, meshes::Integer, meshes::kFloatScale, meshes::Vector;

// R = rows/length.
struct Rotation {
  std::array<Vector, 3> rows;
  Integer length;
};

std::optional<Rotation> rotation_of(const scene::Pose& pose) {
  const bool is_in_range = std::ranges::all_of(
      pose.rotation, [](float one) { return one == 0 || (std::fabs(one) >= 0x1p-30F && std::fabs(one) <= 2); });
  if (!is_in_range || !in_domain(Eigen::Vector3f(pose.translation.data()))) return std::nullopt;
  std::array<Integer, 4> q;
  std::ranges::transform(pose.rotation, q.begin(), [](float one) { return meshes::integer_of(one, kFloatScale); });
  const auto& [w, x, y, z] = q;
  Rotation rotation{{{{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)}},
                      {{2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)}},
                      {{2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}}},
                    w * w + x * x + y * y + z * z};
  if (rotation.length.is_zero()) return std::nullopt;
  return rotation;
}

Vector integers_of(const std::array<float, 3>& a) {
  return {
      {meshes::integer_of(a[0], kFloatScale), meshes::integer_of(a[1], kFloatScale), meshes::integer_of(a[2], kFloatScale)}};
}
std::array<float, 3> as_read(const std::array<float, 3>& a) {
  return {quantised(a[0]), quantised(a[1]), quantised(a[2])};
}

}  // namespace

std::optional<std::array<float, 3>> seen_from(const scene::Pose& pose, const std::array<float, 3>& position) {
  const std::optional<Rotation> rotation = rotation_of(pose);
  if (!rotation || !in_domain(Eigen::Vector3f(position.data()))) return std::nullopt;
  const Vector away = integers_of(as_read(position)) - integers_of(as_read(pose.translation));
  std::array<float, 3> seen{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vector column{{rotation->rows[0][axis], rotation->rows[1][axis], rotation->rows[2][axis]}};
    seen[axis] = meshes::nearest_binary32(Fraction{dot(column, away), rotation->length}, -kFloatScale);
  }
  return as_read(seen);
}

SceneSession::SceneSession(const std::vector<GodObject>& objects) : ticks_(objects.size()) {
  if (objects.empty() || objects.size() > scene::kMostObjects)
    throw std::invalid_argument("the objects of a scene: expected 1 to " + std::to_string(scene::kMostObjects) + ", got " +
                                std::to_string(objects.size()));
  for (const GodObject& object : objects) objects_.emplace_back(object);
}

scene::Tick SceneSession::step(const std::array<float, 3>& position, std::span<const scene::Pose> poses) {
  constexpr std::array<float, 3> kNotSeen{NAN, NAN, NAN};
  scene::Tick tick{mesh::TickStatus::free, {}};
  std::array<Fraction, 3> sum;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const bool has_pose = poses.size() == objects_.size();
    ticks_[i] = objects_[i].step(has_pose ? seen_from(poses[i], position).value_or(kNotSeen) : kNotSeen);
    tick.status = std::max(tick.status, ticks_[i].status);
    if (ticks_[i].status == mesh::TickStatus::invalid || ticks_[i].status == mesh::TickStatus::free) continue;
    const Rotation rotation = *rotation_of(poses[i]);
    const Vector force = integers_of(ticks_[i].force);
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] = {sum[axis].over * rotation.length + dot(rotation.rows[axis], force) * sum[axis].under,
                   sum[axis].under * rotation.length};
  }
  if (tick.status == mesh::TickStatus::invalid) return tick;
  std::ranges::transform(sum, tick.force.begin(),
                         [](const Fraction& component) { return meshes::nearest_binary32(component, -kFloatScale); });
  return tick;
}

}  // namespace forceshade::reference
