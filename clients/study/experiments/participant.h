// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stimuli that an experiment's participant feels, and the screens and key presses of a session. All are plain values.
// Lengths are in mil, thousandths of an inch, as in the thesis.

#include <optional>
#include <string>

#include "study/window/screen.h"

namespace forceshade::experiments {

// Radii are whole mil everywhere in an experiment, so that a radius reached by keys is exactly the one of a condition.
using Mil = int;

inline constexpr double kMillimetresPerMil = 0.0254;

// A session shows screens and takes key presses as a window does.
using window::Action;
using window::KeyNames;
using window::Labels;
using window::Press;
using window::Screen;
using window::ScreenKind;

// A stimulus as it is rendered: its width, stiffness and placement are those of the protocol.
struct Bump {
  std::string stimulus;  // its name in the protocol
  Mil radius = 0;        // 0 for a stimulus of one shape
  Mil position = 0;      // of the middle of the bump along x, to the right

  friend bool operator==(const Bump&, const Bump&) = default;
};

// The bumps that the servo loop renders now: none, one, or reference and matching bump.
struct Scene {
  std::optional<Bump> left, right;  // a single bump, at position 0, is `left`
  friend bool operator==(const Scene&, const Scene&) = default;
};

}  // namespace forceshade::experiments
