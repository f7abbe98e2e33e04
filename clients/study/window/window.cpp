// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/window.h"

#include <tuple>
#include <utility>

#include "study/window/view.h"

namespace forceshade::window {
namespace {

// But for what was typed into it.
bool is_one(const Screen& a, const Screen& b) {
  const auto parts = [](const Screen& s) { return std::tie(s.kind, s.title, s.text, s.block, s.trial, s.is_practice); };
  return parts(a) == parts(b);
}

}  // namespace

bool Window::draw(const Screen& screen, const Scene& scene) {
  const bool is_open = canvas_.draw(
      [=, look = look_](Size size, const Measure& measure) { return picture_of(screen, scene, look, size, measure); });
  // Typed at the screen of the frame before. Where the session has left it since, they do not count for one not yet seen.
  const std::vector<Key> typed = canvas_.keys();
  if (is_one(screen_, screen))
    for (Press& press : presses_of(keys_, screen.kind, typed)) presses_.push_back(std::move(press));
  if (!is_open) return false;
  screen_ = screen;
  scene_ = scene;
  return true;
}

std::vector<Press> Window::presses() {
  return std::exchange(presses_, {});
}

std::optional<Position> Window::mouse() const {
  const auto pixel = canvas_.pointer();
  return pixel ? std::optional(View(scene_, canvas_.size()).position(*pixel)) : std::nullopt;
}

}  // namespace forceshade::window
