// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace forceshade::device {

Intention::Intention(std::vector<Point> points, Between between) : points_(std::move(points)), between_(between) {}

Target Intention::at(double time) const noexcept {
  const auto next =
      std::upper_bound(points_.begin(), points_.end(), time, [](double t, const Point& point) { return t < point.time; });
  if (next == points_.begin()) return {.position = next->position};
  const Point& last = *(next - 1);
  if (next == points_.end()) return {.position = last.position};
  const double duration = next->time - last.time, s = (time - last.time) / duration;
  const Eigen::Vector3d way = next->position - last.position;
  if (between_ == Between::straight) return {last.position + s * way, way / duration};
  return {last.position + s * s * s * (10 + s * (6 * s - 15)) * way, 30 * s * s * (1 - s) * (1 - s) / duration * way};
}

Intention strokes() {
  constexpr double kReach = 20, kDepth = -3, kStroke = 0.9, kDuration = 600;  // mm, mm, s, s
  std::vector<Intention::Point> points{{0, {-kReach, 0, 10}}, {1, {-kReach, 0, kDepth}}};
  for (double x = kReach; points.back().time < kDuration; x = -x)
    points.push_back({points.back().time + kStroke, {x, 0, kDepth}});
  return {std::move(points), Intention::Between::minimum_jerk};
}

Tremor::Tremor(std::uint64_t seed, double rms) {
  std::mt19937_64 bits(seed);
  // Not std::uniform_real_distribution, whose numbers differ from library to library.
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
  };
  const double size = rms * std::sqrt(2.0 / kTones);
  for (auto& axis : tones_)
    for (Tone& tone : axis) tone = {2 * std::numbers::pi * uniform(8, 12), uniform(0, 2 * std::numbers::pi), size};
}

Target Tremor::at(double time) const noexcept {
  Target target;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Tone& tone : tones_[axis]) {
      const auto i = static_cast<Eigen::Index>(axis);
      target.position[i] += tone.size * std::sin(tone.pulsation * time + tone.phase);
      target.velocity[i] += tone.size * tone.pulsation * std::cos(tone.pulsation * time + tone.phase);
    }
  return target;
}

}  // namespace forceshade::device
