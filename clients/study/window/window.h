// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The window that a participant looks at and types into.

#include <optional>
#include <string>
#include <vector>

#include "study/window/layout.h"
#include "study/window/scene.h"
#include "study/window/screen.h"
#include "study/window/settings.h"
#include "window/canvas.h"

namespace forceshade::window {

// A canvas, on which the screens of a session are drawn. No call waits for the servo loop, and the servo loop waits for none: a
// frame takes the screen and the scene as values.
class Window {
 public:
  // Opens the window; the labels are in the language of the screens. Throws Error as Canvas does.
  explicit Window(const WindowSettings& settings, const Labels& labels = {})
      : keys_(settings.keys), look_{labels, settings.text_scale}, canvas_(settings) {}

  // One frame, as Canvas::draw().
  bool draw(const Screen& screen, const Scene& scene);

  // Since the last call, in their order: take them after every frame. What a key means follows from the screen that was last
  // drawn before it was typed (keys.h); it means nothing where that is not the screen of this frame any more.
  std::vector<Press> presses();

  // The point of the mouse in the plane y = 0 of the scene that was last drawn, in mm; nothing while it is outside the window.
  std::optional<Position> mouse() const;

  Image pixels() { return canvas_.pixels(); }
  const std::string& note() const { return canvas_.note(); }
  static bool is_available() noexcept { return Canvas::is_available(); }

 private:
  Keys keys_;
  Look look_;
  Canvas canvas_;
  Screen screen_;
  Scene scene_;
  std::vector<Press> presses_;
};

}  // namespace forceshade::window
