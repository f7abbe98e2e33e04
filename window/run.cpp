// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/window/run.h"

namespace forceshade::window {
namespace {

using experiments::kMillimetresPerMil;
using experiments::Screen;

// What was typed changes on the same screen.
bool is_same_screen(const Screen& a, const Screen& b) {
  return a.kind == b.kind && a.title == b.title && a.text == b.text && a.trial == b.trial && a.is_practice == b.is_practice;
}

class Running {
 public:
  Running(Window& window, experiments::Session& session, Laboratory& laboratory)
      : window_(window), session_(session), laboratory_(laboratory), rendered_(session.scene()) {
    laboratory_.render(rendered_);
  }

  Ending last() {
    for (;;) {
      if (!laboratory_.goes_on()) return Ending::stopped;
      const Screen screen = session_.screen();
      const bool is_open = window_.draw(screen, scene());
      const bool was_left = take_presses(screen);
      if (was_left) return Ending::over;
      if (!is_open) return Ending::closed;
      laboratory_.aim(window_.mouse());
    }
  }

 private:
  Scene scene() {
    const experiments::Protocol& protocol = session_.protocol();
    Scene scene = laboratory_.scene();
    scene.width = kMillimetresPerMil * protocol.width;
    if (protocol.spacing > 0) scene.separation = kMillimetresPerMil * protocol.spacing;
    return scene;
  }

  // Whether the last screen was left.
  bool take_presses(const Screen& shown) {
    const double time = laboratory_.time();
    for (const experiments::Press& press : window_.presses()) {
      if (session_.is_over() && press.action == experiments::Action::enter) return true;
      session_.press(press, time);
      if (const experiments::Scene now = session_.scene(); now != rendered_) {
        laboratory_.render(now);
        rendered_ = now;
      }
      if (!is_same_screen(session_.screen(), shown)) break;
    }
    return false;
  }

  Window& window_;
  experiments::Session& session_;
  Laboratory& laboratory_;
  experiments::Scene rendered_;
};

}  // namespace

Ending run(Window& window, experiments::Session& session, Laboratory& laboratory) {
  return Running(window, session, laboratory).last();
}

}  // namespace forceshade::window
