// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Draws the picture for the participant: from a screen of the session and the state of the scene, without a display.

#include "window/composition.h"
#include "window/picture.h"
#include "window/scene.h"
#include "window/screen.h"
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

}  // namespace forceshade::window
