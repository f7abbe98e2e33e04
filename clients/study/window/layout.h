// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Draws the picture for the participant: from a screen of the session and the state of the scene, without a display.

#include <functional>
#include <span>

#include "study/window/scene.h"
#include "study/window/screen.h"
#include "window/composition.h"
#include "window/picture.h"
#include "window/text.h"

namespace forceshade::window {

struct Look {
  Labels labels;          // in the language of the screens
  double text_scale = 1;  // times the usual size of text
};

// The bumps and the cursor are drawn on screens of kind matching alone, and there only while shows_scene is true; else their
// area is one colour (but see Scene::shows_tip_alone). The four pictures of a classification are always drawn, for they are the
// answers. Text that is too long for its place is made smaller until it fits (text.h).
Picture picture_of(const Screen& screen, const Scene& scene, const Look& look, Size window, const Measure& measure);

// A profile drawn out along y: how a bump on its plane looks.

struct Solid {
  double depth = 0, thickness = 0;  // mm: along y, around y = 0; of the slab under the profile
  double edge = 1;                  // pixels: of its lines
  bool has_ridges = false;          // a line along every edge between two faces
  std::function<Point(const Position&)> pixel;
};

// Each face between two points in the shade of its slope, lit from above left; the cut in front; the lines of both ends.
std::vector<Item> drawn_out(std::span<const ProfilePoint> profile, const Solid& solid);

}  // namespace forceshade::window
