// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "files/csv.h"
#include "forceshade/error.h"
#include "rendering/meshes/placement.h"

namespace forceshade::subjects {
namespace {

struct TimedPose {
  double time;  // s
  scene::Pose pose;
};

constexpr std::size_t kTime = 0, kTranslation = 1, kRotation = 4;  // columns

scene::Pose pose_in(const files::Reader& row) {
  scene::Pose pose;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    pose.translation[axis] = row.binary32(kTranslation + axis);
    if (!mesh::is_of_translation(pose.translation[axis])) throw row.unexpected(kTranslation + axis, "mm within 10000");
  }
  if (!row.has(kRotation)) return pose;
  for (std::size_t i = 0; i < 4; ++i) {
    pose.rotation[i] = row.binary32(kRotation + i);
    if (!mesh::is_of_rotation(pose.rotation[i])) throw row.unexpected(kRotation + i, "0, or 2^-30 to 2 in size");
  }
  if (pose.rotation == std::array<float, 4>{}) throw row.unexpected(kRotation, "a quaternion that is not 0");
  return pose;
}

void expect_all_or_none(const files::Reader& rows, const std::string& file) {
  const auto count =
      std::ranges::count_if(std::array{0, 1, 2, 3}, [&](int i) { return rows.has(kRotation + static_cast<std::size_t>(i)); });
  if (count != 0 && count != 4) throw Error(file + ": expected all of the columns qw, qx, qy and qz or none of them");
}

std::vector<TimedPose> read(const std::string& file, double rate) {
  std::ifstream in = files::open_file(file);
  files::Reader rows(in, file, {"time_s", "x_mm", "y_mm", "z_mm"}, {"qw", "qx", "qy", "qz"});
  rows.expect_no_other_column();
  expect_all_or_none(rows, file);
  std::vector<TimedPose> all;
  while (rows.next()) {
    const double time = rows.binary64(kTime);
    if (all.empty() && time != 0) throw rows.unexpected(kTime, "0, the time of the first pose");
    if (!all.empty() && !(time > all.back().time)) throw rows.unexpected(kTime, "a time after that of the row before");
    if (!(time * rate < static_cast<double>(kMostPoses)))
      throw rows.unexpected(kTime, "at most " + std::to_string(kMostPoses) + " ticks");
    all.push_back({time, pose_in(rows)});
  }
  if (all.empty()) throw Error(file + ": expected a row for each pose, got none");
  return all;
}

using Quaternion = std::array<double, 4>;

Quaternion of_length_one(const std::array<float, 4>& rotation) {
  Quaternion q{};
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = static_cast<double>(rotation[i]);
    squares += q[i] * q[i];
  }
  for (double& component : q) component /= std::sqrt(squares);
  return q;
}

// A part of the way, 0 < part < 1, from one pose to the other, by the shorter way.
scene::Pose between(const scene::Pose& from, const scene::Pose& to, double part) {
  const auto mixed = [part](double a, double b) { return a + part * (b - a); };
  scene::Pose pose = from;
  if (to.translation != from.translation)
    for (std::size_t axis = 0; axis < 3; ++axis)
      pose.translation[axis] =
          static_cast<float>(mixed(static_cast<double>(from.translation[axis]), static_cast<double>(to.translation[axis])));
  if (to.rotation == from.rotation) return pose;
  const Quaternion a = of_length_one(from.rotation);
  Quaternion b = of_length_one(to.rotation);
  if (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0)
    for (double& component : b) component = -component;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto component = static_cast<float>(mixed(a[i], b[i]));
    pose.rotation[i] = std::fabs(component) < mesh::kLeastOfRotation ? 0 : component;
  }
  return pose;
}

// rows: one at least, the first at 0.
scene::Motion sampled(const std::vector<TimedPose>& rows, double rate, bool repeats) {
  scene::Motion motion{{}, repeats};
  auto after = rows.begin();  // the first row after the tick
  for (std::size_t tick = 0;; ++tick) {
    const double time = static_cast<double>(tick) / rate;
    while (after != rows.end() && after->time <= time) ++after;
    // A repeated motion begins again in the tick of the last row; else that row's pose stays.
    if (after == rows.end() && repeats && tick > 0) return motion;
    const TimedPose& before = *(after - 1);
    const bool is_row = after == rows.end() || before.time == time;
    motion.poses.push_back(is_row ? before.pose
                                  : between(before.pose, after->pose, (time - before.time) / (after->time - before.time)));
    if (after == rows.end()) return motion;
  }
}

}  // namespace

scene::Motion read_motion(const std::string& file, double rate, bool repeats) {
  return sampled(read(file, rate), rate, repeats);
}

}  // namespace forceshade::subjects
