// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The view of the plane with the two bumps in the window: a parallel projection from the front and a little above.

#include "study/window/scene.h"
#include "window/picture.h"

namespace forceshade::window {

// mm: how much of the plane is drawn towards and away from the participant, and how thick it is where it is cut.
inline constexpr double kSceneDepth = 30, kSlabThickness = 4;

// The part of a window in which the two bumps are shown, the same on every screen.
Rectangle scene_area(Size window);

class View {
 public:
  View(const Scene& scene, Rectangle area);

  // The view of a window of this size.
  View(const Scene& scene, Size window) : View(scene, scene_area(window)) {}

  Point pixel(const Position& position) const;

  // The position in the plane y = 0 that is seen at the pixel.
  Position position(Point pixel) const;

  double pixels_per_mm() const { return scale_; }
  // mm: the plane is drawn from -extent to +extent.
  double extent() const { return extent_; }

 private:
  double extent_, scale_;
  Point origin_;  // the pixel of (0, 0, 0)
};

}  // namespace forceshade::window
