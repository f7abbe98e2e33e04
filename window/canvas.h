// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A window of the system in which pictures are shown, with its keyboard and its pointer: all that needs a display.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/error.h"
#include "window/picture.h"
#include "window/text.h"

namespace forceshade::window {

struct Settings {
  bool is_fullscreen = false;
  int monitor = 1;                   // from 1: the one that the window fills, or on which it opens
  int width = 1280, height = 800;    // pixels, of a window that does not fill the monitor
  std::string font = "DejaVu Sans";  // a family for fontconfig, or the path of a TrueType file
};

// A character as the keyboard's own layout types it, in UTF-8, or the name of a key that types none ("return", "page-up",
// "f1").
struct Key {
  std::string name;
  bool is_repeat = false;  // made by the keyboard while the key is held down
};

// Rows from the top, three bytes a pixel: red, green, blue.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;

  const std::uint8_t* at(int x, int y) const {
    return &bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  }
};

// The picture for a window of this size, in pixels; it is drawn again where the window shows the same once more.
using Drawing = std::function<Picture(Size window, const Measure& measure)>;

// One at a time, and every call from the main thread, as the windowing system requires.
class Canvas {
 public:
  // Opens the window. Throws Error: no display, no OpenGL 3.3, no such monitor, an unreadable font, a second window, or a build
  // without the libraries of a window.
  explicit Canvas(const Settings& settings);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Takes what was typed since the last call, draws one frame and shows it; waits for the display's refresh, and where there is
  // none to wait for until a sixtieth of a second after the last frame. The mouse pointer is hidden over the window. False as
  // soon as the window was closed: nothing is drawn any more, and what was typed before can still be taken.
  bool draw(Drawing drawing);

  // Typed since the last call, in their order. A key is there at the frame after it: up to a sixtieth of a second late.
  std::vector<Key> keys();

  // The pixel of the picture at which the mouse points; nothing while it is outside the window.
  std::optional<Point> pointer() const;

  // In pixels of the picture.
  Size size() const;

  // The picture of the last frame, read back from the graphics card.
  Image pixels();

  // Words about what is not as the settings would have it: a font that had to be replaced. Empty otherwise.
  const std::string& note() const;

  // True if this build has windows; without, the constructor throws, and the message names the packages.
  static bool is_available() noexcept;

 private:
  class Display;
  std::unique_ptr<Display> display_;
};

}  // namespace forceshade::window
