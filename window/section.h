// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A surface cut by a plane y = constant, with the tip that feels it: the view of a person who drives a device with the mouse.
// Lengths in mm, forces in N.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "window/picture.h"
#include "window/text.h"

namespace forceshade::window {

struct Position {
  double x = 0, y = 0, z = 0;  // right, away from the person, up

  bool operator==(const Position&) const = default;
};

// A point of a plane y = constant.
struct ProfilePoint {
  double x, z;
};

// The part of the plane that is shown.
struct Region {
  double left = 0, right = 0, bottom = 0, top = 0;
};

// The inside of the surface, along vertical lines from left to right.
struct Stretch {
  double low, high;
};
struct Column {
  double x;
  std::vector<Stretch> inside;
};

struct Section {
  std::vector<Column> columns;
  std::vector<std::array<ProfilePoint, 2>> border;  // lines within the region
  std::vector<std::array<ProfilePoint, 2>> felt;    // in order, where shading lets another shape be felt than the surface
};

// One tick of the servo loop.
struct Felt {
  Position tip;                                       // of the device, which the surface pushes back
  std::optional<Position> god_object = std::nullopt;  // on the surface of a mesh
  std::array<double, 3> force{};                      // as commanded
};

struct SectionScene {
  Region region;
  Section section;
  std::optional<Felt> felt = std::nullopt;              // none before the first tick
  std::optional<ProfilePoint> intended = std::nullopt;  // the place where the hand means to be; none before it is shown one
  std::string title;
  std::vector<std::string> words;  // below the picture, a paragraph each
};

// The view of the region in a window of this size.
class SectionView {
 public:
  SectionView(const Region& region, Size window);

  Point pixel(double x, double z) const {
    return {area_.left + scale_ * (x - region_.left), area_.bottom - scale_ * (z - region_.bottom)};
  }
  ProfilePoint position(Point pixel) const {
    return {region_.left + (pixel.x - area_.left) / scale_, region_.bottom + (area_.bottom - pixel.y) / scale_};
  }

  const Rectangle& area() const { return area_; }
  double pixels_per_mm() const { return scale_; }

 private:
  Region region_;
  Rectangle area_;
  double scale_;
};

// The colours of the god-object's ring, of the shape that is felt, and of the intended place, which tests look for.
inline constexpr Colour kGodObject{0.584F, 0.251F, 0.553F}, kFeltShape{0.624F, 0.353F, 0.047F},
    kIntended{0.125F, 0.145F, 0.169F};

// Pixels per N, of the arrow of the force in a window of this size. It grows no longer than that of kLongestArrow.
double arrow_scale(Size window);
inline constexpr double kLongestArrow = 4;  // N

// The ball is the tip, where it is; the arrow begins there. Lines tie it to the ring of the god-object, and to the cross of the
// intended place, from which the surface has pushed it. The shape that is felt is dashed.
Picture picture_of(const SectionScene& scene, Size window, const Measure& measure);

}  // namespace forceshade::window
