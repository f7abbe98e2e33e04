// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The visible part of the virtual world, and its place: the thesis's figures 5-3 and 5-8. Lengths in mm.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "window/section.h"

namespace forceshade::window {

// The felt scene, as one tick of the servo loop left it.
struct Scene {
  // The position of the tip of the stylus, in the frame in which the two bumps stand at x = -separation/2 and +separation/2 on
  // the plane z = 0. Not given: no cursor is drawn.
  std::optional<Position> tip;
  // On a classification screen, which has no scene: true if the tip is shown there by itself, in front of no surface. So
  // a participant without a PHANToM sees how the surface pushes the hand that the mouse moves. Not for a hand that can feel.
  bool shows_tip_alone = false;
  double felt_height = 0;  // of the surface that is rendered there: the nominal surface, on which the force begins
  double separation = 50.8;
  double width = 25.4;  // of each bump
};

enum class Shape : std::uint8_t { plane, two_polygons, three_polygons, cylinder };  // in the order of the answers 1 to 4
inline constexpr std::array<Shape, 4> kShapes{Shape::plane, Shape::two_polygons, Shape::three_polygons, Shape::cylinder};

// A profile across a bump on the plane z = 0, from x = -extent to +extent: a polyline. The bump stands at x = 0. The polygons
// sample the circle as the thesis has it (4.4.2, 4.4.3): at three or four points at equal angles. `radius` is at least width/2,
// and `extent` more than it.
std::vector<ProfilePoint> profile(Shape shape, double width, double radius, double extent);

// The bumps of the matching experiment are drawn with this radius, whatever they feel like: one that changed its size would
// show the answer (thesis 5.5). It is the middle one of the reference radii, 1000 mil, for bumps 1000 mil wide.
double drawn_radius(double width);

// mm: of the surface that is drawn, at x.
double drawn_height(const Scene& scene, double x);

// The place at which the tip is drawn: as far above the drawn surface as it is above the felt one, and on it where it has
// penetrated (thesis 5.2, 5.5). So the cursor touches the picture exactly when the hand touches the object; drawn at the hand's
// own height it would float over the picture of a bump that is higher than drawn, and show the difference in size that is to be
// felt. x and y are not changed. A height that is not finite counts as 0.
Position drawn_cursor(const Position& tip, double felt_height, double drawn_height);

}  // namespace forceshade::window
