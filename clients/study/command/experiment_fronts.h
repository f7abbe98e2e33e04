// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two fronts of a session: the terminal, and the participant's window.

#include <termios.h>

#include <string>

#include "device/simulated/steering.h"
#include "study/apparatus/apparatus.h"
#include "study/apparatus/bumps.h"
#include "study/window/window.h"

namespace forceshade::apps {

// Texts go to standard output when they change, keys come from standard input: a terminal, where each key acts at once, or a
// pipe. j, k, l, Enter, Backspace as in the window; Ctrl-D, or the end of a pipe, closes it.
class TerminalFront final : public apparatus::Front {
 public:
  TerminalFront();
  ~TerminalFront() override;
  TerminalFront(const TerminalFront&) = delete;
  TerminalFront& operator=(const TerminalFront&) = delete;

  bool show(const experiments::Screen& screen, const std::optional<device::Sample>& latest,
            const experiments::Scene& felt) override;
  std::vector<experiments::Press> presses() override;
  bool waits_at_the_end() const override { return false; }

 private:
  bool is_terminal_, is_closed_ = false;
  termios before_{};
  experiments::ScreenKind kind_ = experiments::ScreenKind::text;
  std::string shown_, typed_;
};

// A key of the terminal on a screen of this kind: the bytes of one character. Nothing where it has no meaning there.
std::optional<experiments::Press> press_of_character(experiments::ScreenKind kind, const std::string& character);

class WindowFront final : public apparatus::Front {
 public:
  // Bumps and steering live longer; the labels are in the language of the protocol. Throws Error, and
  // Error of its file of texts. steering: null unless the hand is the mouse, whose place then has to be seen on
  // every screen that has something to feel.
  WindowFront(const window::WindowSettings& settings, apparatus::Bumps& bumps, device::Steering* steering,
              const Eigen::Vector3f& origin);

  bool show(const experiments::Screen& screen, const std::optional<device::Sample>& latest,
            const experiments::Scene& felt) override;
  std::vector<experiments::Press> presses() override { return window_.presses(); }

 private:
  window::Scene seen(const std::optional<device::Sample>& latest, const experiments::Scene& felt);

  apparatus::Bumps& bumps_;
  device::Steering* steering_;
  Eigen::Vector3d origin_;
  window::Window window_;
};

}  // namespace forceshade::apps
