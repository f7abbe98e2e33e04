// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The person who prepares a device, reached through the terminal.

#include <optional>
#include <string>

#include "apps/keyboard_buttons.h"
#include "forceshade/device.h"

namespace forceshade::apps {

// Messages go to standard error.
class TerminalAttendant : public device::Attendant {
 public:
  // what_else: what to do where there is no terminal, for instance "give --in-reset-pose".
  explicit TerminalAttendant(std::string what_else) : what_else_(std::move(what_else)) {}

  void report(const std::string& words) noexcept override;

  // Shows the words on the terminal and waits for Enter there; what was typed before does not count. False where there is no
  // terminal, or it is another program's turn to read from it, which is reported; and after a signal that ends the work.
  bool did(const std::string& words) noexcept override;

  // After such a signal.
  bool has_left() const noexcept override;

  // From now on a device that has no buttons finds keys of the terminal here. Not for one that has to be prepared: Enter would
  // be taken for one of these keys.
  void offer_buttons() noexcept { offers_buttons_ = true; }
  const std::atomic<std::uint16_t>* buttons() noexcept override;

 private:
  std::string what_else_;
  bool offers_buttons_ = false;
  std::optional<KeyboardButtons> keys_;
};

// Said beforehand, by --in-reset-pose: the arm is held in its reset pose, so nothing has to be confirmed.
class HoldsResetPose final : public TerminalAttendant {
 public:
  HoldsResetPose() : TerminalAttendant("") {}

  bool did(const std::string& words) noexcept override;
};

}  // namespace forceshade::apps
