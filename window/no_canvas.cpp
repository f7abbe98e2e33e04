// SPDX-License-Identifier: BSD-3-Clause
// The canvas of a build that found no GLFW, OpenGL, Dear ImGui or fontconfig.

#include "window/canvas.h"

namespace forceshade::window {

class Canvas::Display {};

Canvas::Canvas(const Settings&) {
  throw Error(
      "this build has no window: expected GLFW, OpenGL, Dear ImGui and fontconfig when it was configured (Debian: "
      "libglfw3-dev, "
      "libimgui-dev, libfontconfig-dev; scripts/setup installs them)");
}
Canvas::~Canvas() = default;

bool Canvas::draw(Drawing) {
  return false;
}
std::vector<Key> Canvas::keys() {
  return {};
}
std::optional<Point> Canvas::pointer() const {
  return std::nullopt;
}
Size Canvas::size() const {
  return {};
}
Image Canvas::pixels() {
  return {};
}
const std::string& Canvas::note() const {
  static const std::string none;
  return none;
}
bool Canvas::is_available() noexcept {
  return false;
}

}  // namespace forceshade::window
