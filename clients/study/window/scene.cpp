// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/scene.h"

#include <algorithm>
#include <cmath>

namespace forceshade::window {
namespace {

// Intervals of the arc: so many that neither the chords nor the shades of the faces between them can be distinguished.
constexpr int kArcIntervals = 160;

// Points on the circle at equal angles, from one foot of the bump to the other.
std::vector<ProfilePoint> sampled(double width, double radius, int intervals) {
  const double half_angle = std::asin(width / (2 * radius)), depth = radius * std::cos(half_angle);
  std::vector<ProfilePoint> points;
  for (int i = 0; i <= intervals; ++i) {
    const double angle = half_angle * (2.0 * i / intervals - 1);
    const bool is_foot = i == 0 || i == intervals;
    points.push_back({radius * std::sin(angle), is_foot ? 0 : radius * std::cos(angle) - depth});
  }
  return points;
}

}  // namespace

std::vector<ProfilePoint> profile(Shape shape, double width, double radius, double extent) {
  std::vector<ProfilePoint> points;
  if (shape == Shape::two_polygons) points = sampled(width, radius, 2);
  if (shape == Shape::three_polygons) points = sampled(width, radius, 3);
  if (shape == Shape::cylinder) points = sampled(width, radius, kArcIntervals);
  points.insert(points.begin(), {-extent, 0});
  points.push_back({extent, 0});
  return points;
}

double drawn_radius(double width) {
  return width;
}

double drawn_height(const Scene& scene, double x) {
  const double from_centre = std::fabs(x) - scene.separation / 2, half = scene.width / 2;
  if (!(std::fabs(from_centre) < half)) return 0;
  const double radius = drawn_radius(scene.width);
  return std::sqrt(radius * radius - from_centre * from_centre) - std::sqrt(radius * radius - half * half);
}

Position drawn_cursor(const Position& tip, double felt_height, double drawn_height) {
  const double felt = std::isfinite(felt_height) ? felt_height : 0;
  return {tip.x, tip.y, drawn_height + std::max(0.0, tip.z - felt)};
}

}  // namespace forceshade::window
