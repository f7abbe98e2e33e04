// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "forceshade/reference.h"
#include "reference/larger_limits.h"
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

Vector integers_of(const Eigen::Vector3f& a) {
  return {
      {meshes::integer_of(a.x(), kFloatScale), meshes::integer_of(a.y(), kFloatScale), meshes::integer_of(a.z(), kFloatScale)}};
}
Eigen::Vector3f as_read(const Eigen::Vector3f& a) {
  return {quantised(a.x()), quantised(a.y()), quantised(a.z())};
}

// The largest status of the objects is that of the scene, unless one is invalid.
static_assert(Status::free < Status::contact && Status::contact < Status::unfinished);

}  // namespace

std::optional<Eigen::Vector3f> seen_from(const scene::Pose& pose, const Eigen::Vector3f& position) {
  const std::optional<Rotation> rotation = rotation_of(pose);
  if (!rotation || !in_domain(position)) return std::nullopt;
  const Vector away = integers_of(as_read(position)) - integers_of(as_read(Eigen::Vector3f(pose.translation.data())));
  Eigen::Vector3f seen;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vector column{{rotation->rows[0][axis], rotation->rows[1][axis], rotation->rows[2][axis]}};
    seen(static_cast<Eigen::Index>(axis)) =
        meshes::nearest_binary32(Fraction{dot(column, away), rotation->length}, -kFloatScale);
  }
  return as_read(seen);
}

SceneSession::SceneSession(std::vector<Object> objects) : objects_(std::move(objects)) {
  if (objects_.empty() || objects_.size() > scene::kMostObjects)
    throw std::invalid_argument("the objects of a scene: expected 1 to " + std::to_string(scene::kMostObjects) + ", got " +
                                std::to_string(objects_.size()));
}

Rounded SceneSession::step(const Eigen::Vector3f& position, std::span<const scene::Pose> poses) {
  const Eigen::Vector3f not_seen = Eigen::Vector3f::Constant(NAN);
  const bool is_seen = poses.size() == objects_.size();
  Rounded answer;
  std::array<Fraction, 3> sum;
  damping::Limits largest{0, 0};
  bool is_valid = true;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const Rounded its = objects_[i](is_seen ? seen_from(poses[i], position).value_or(not_seen) : not_seen);
    is_valid &= its.status != Status::invalid;
    answer.status = std::max(answer.status, its.status);
    if (finished(its.status) != Status::contact) continue;
    enlarge(largest, its.damping);
    const Rotation rotation = rotation_of(poses[i]).value();
    const Vector force = integers_of(its.force);
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] = {sum[axis].over * rotation.length + dot(rotation.rows[axis], force) * sum[axis].under,
                   sum[axis].under * rotation.length};
  }
  if (!is_valid) answer.status = Status::invalid;
  if (finished(answer.status) != Status::contact) return answer;
  answer.damping = largest;
  for (std::size_t axis = 0; axis < 3; ++axis)
    answer.force(static_cast<Eigen::Index>(axis)) = meshes::nearest_binary32(sum[axis], -kFloatScale);
  return answer;
}

}  // namespace forceshade::reference
