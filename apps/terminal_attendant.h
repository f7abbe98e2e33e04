// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The person who prepares a device, reached through the terminal.

#include <termios.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "forceshade/device.h"
#include "system/system.h"

namespace forceshade::apps {

// Keys of the terminal as the buttons of a device that has none.

// While it lives, the key 0 presses button 0, and lets go of it when it is typed again; so does 1 with button 1. A terminal
// says when a key goes down but not when it comes up, so a key cannot simply be held. Other keys do nothing; those that make
// signals, as Ctrl-C does, still make them. Keys are neither shown nor left for whoever reads from the terminal afterwards.
class KeyboardButtons {
 public:
  KeyboardButtons();
  ~KeyboardButtons();
  KeyboardButtons(const KeyboardButtons&) = delete;
  KeyboardButtons& operator=(const KeyboardButtons&) = delete;

  // True if there is a terminal that commands this process, and it is this process's turn to read from it. Else no button is
  // ever down.
  bool works() const noexcept { return thread_.is_joinable(); }

  // Bit k is set while button k is down.
  const std::atomic<std::uint16_t>& down() const noexcept { return down_; }

 private:
  void follow() noexcept;

  int terminal_ = -1;
  termios before_{};
  std::atomic<std::uint16_t> down_ = 0;
  std::atomic<bool> stopping_ = false;
  system::Thread thread_;
};

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
