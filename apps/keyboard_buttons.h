// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keys of the terminal as the buttons of a device that has none.

#include <termios.h>

#include <atomic>
#include <cstdint>

#include "system/system.h"

namespace forceshade::apps {

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

}  // namespace forceshade::apps
