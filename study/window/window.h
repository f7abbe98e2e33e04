// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The window that a participant looks at and types into.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/experiments/language.h"
#include "forceshade/participant.h"
#include "study/window/error.h"
#include "study/window/scene.h"
#include "study/window/settings.h"

namespace forceshade::window {

// Rows from the top, three bytes a pixel: red, green, blue.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;

  const std::uint8_t* at(int x, int y) const {
    return &bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  }
};

// One at a time, and every call from the main thread, as the windowing system requires. No call waits for the servo loop, and
// the servo loop waits for none: a frame takes the screen and the scene as values.
class Window {
 public:
  // Opens the window; the labels are in the language of the screens. Throws Error: no display, no OpenGL 3.3, no such monitor,
  // an unreadable font, a second window, or a build without the libraries of a window.
  explicit Window(const Settings& settings, const experiments::Labels& labels = {});
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Takes what was typed since the last call, draws one frame and shows it; waits for the display's refresh, and where there is
  // none to wait for until a sixtieth of a second after the last frame. The mouse pointer is hidden over the window. False as
  // soon as the window was closed: nothing is drawn any more, and what was typed before can still be taken.
  bool draw(const experiments::Screen& screen, const Scene& scene);

  // Since the last call, in their order: take them after every frame. What a key means follows from the screen that was last
  // drawn (keys.h). A press is there at the frame after it: up to a sixtieth of a second late.
  std::vector<experiments::Press> presses();

  // Where the mouse points in the plane y = 0 of the scene that was last drawn, in mm; nothing while it is outside the window.
  std::optional<Position> mouse() const;

  // What the last frame showed, read back from the graphics card.
  Image pixels();

  // Words about what is not as the settings would have it, for the researcher: a font that had to be replaced. Empty otherwise.
  const std::string& note() const;

  // Whether this build has windows; without, the constructor throws, and the message names the packages.
  static bool is_available() noexcept;

 private:
  class Display;
  std::unique_ptr<Display> display_;
};

}  // namespace forceshade::window
