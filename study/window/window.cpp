// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/window.h"

#include <utility>

#include "study/window/view.h"

namespace forceshade::window {

bool Window::draw(const experiments::Screen& screen, const Scene& scene) {
  const experiments::ScreenKind seen = screen_.kind;  // when the keys were typed that this frame takes
  const bool is_open = canvas_.draw(
      [=, look = look_](Size size, const Measure& measure) { return picture_of(screen, scene, look, size, measure); });
  for (experiments::Press& press : presses_of(keys_, seen, canvas_.keys())) presses_.push_back(std::move(press));
  if (!is_open) return false;
  screen_ = screen;
  scene_ = scene;
  return true;
}

std::vector<experiments::Press> Window::presses() {
  return std::exchange(presses_, {});
}

std::optional<Position> Window::mouse() const {
  const auto pixel = canvas_.pointer();
  return pixel ? std::optional(View(scene_, canvas_.size()).position(*pixel)) : std::nullopt;
}

}  // namespace forceshade::window
