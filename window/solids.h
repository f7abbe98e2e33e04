// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A profile drawn out along y: how a bump on its plane looks.

#include <functional>
#include <span>

#include "window/picture.h"
#include "window/scene.h"

namespace forceshade::window {

struct Solid {
  double depth = 0, thickness = 0;  // mm: along y, around y = 0; of the slab under the profile
  double edge = 1;                  // pixels: of its lines
  bool has_ridges = false;          // a line along every edge between two faces
  std::function<Point(const Position&)> pixel;
};

// Each face between two points in the shade of its slope, lit from above left; the cut in front; the lines of both ends.
std::vector<Item> drawn_out(std::span<const ProfilePoint> profile, const Solid& solid);

}  // namespace forceshade::window
