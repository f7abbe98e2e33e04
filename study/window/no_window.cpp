// SPDX-License-Identifier: BSD-3-Clause
// The window of a build that found no GLFW, OpenGL, Dear ImGui or fontconfig.

#include "study/window/window.h"

namespace forceshade::window {

class Window::Display {};

Window::Window(const Settings&, const experiments::Labels&) {
  throw Error(
      "this build has no window: expected GLFW, OpenGL, Dear ImGui and fontconfig when it was configured (Debian: "
      "libglfw3-dev, "
      "libimgui-dev, libfontconfig-dev; scripts/setup installs them)");
}
Window::~Window() = default;

bool Window::draw(const experiments::Screen&, const Scene&) {
  return false;
}
std::vector<experiments::Press> Window::presses() {
  return {};
}
std::optional<Position> Window::mouse() const {
  return std::nullopt;
}
Image Window::pixels() {
  return {};
}
const std::string& Window::note() const {
  static const std::string none;
  return none;
}
bool Window::is_available() noexcept {
  return false;
}

}  // namespace forceshade::window
