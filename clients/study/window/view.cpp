// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/view.h"

#include <algorithm>

namespace forceshade::window {
namespace {

// The sine and cosine of the angle from which the plane is looked down at, 24 degrees.
constexpr double kSine = 0.4067366430758002, kCosine = 0.9135454576426009;

// mm: free room over the plane for the tip, and under it for the names of the bumps.
constexpr double kRoomAbove = 18, kRoomBelow = 6;

}  // namespace

Rectangle scene_area(Size window) {
  const double margin = 0.05 * window.height;
  return {margin, 0.16 * window.height, window.width - margin, 0.76 * window.height};
}

View::View(const Scene& scene, Rectangle area) {
  const double below = kSceneDepth / 2 * kSine + kSlabThickness * kCosine + kRoomBelow;
  const double height = kRoomAbove * kCosine + kSceneDepth / 2 * kSine + below;
  const double least_extent = scene.separation / 2 + 1.1 * scene.width;
  scale_ = std::min(area.width() / (2 * least_extent), area.height() / height);
  extent_ = area.width() / (2 * scale_);
  const double unused = area.height() - height * scale_;
  origin_ = {(area.left + area.right) / 2, area.bottom - below * scale_ - unused / 3};
}

Point View::pixel(const Position& position) const {
  return {origin_.x + scale_ * position.x, origin_.y - scale_ * (position.z * kCosine + position.y * kSine)};
}

Position View::position(Point pixel) const {
  return {(pixel.x - origin_.x) / scale_, 0, (origin_.y - pixel.y) / (scale_ * kCosine)};
}

}  // namespace forceshade::window
