// SPDX-License-Identifier: BSD-3-Clause
#include "apps/keyboard_buttons.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "forceshade/device.h"

namespace forceshade::apps {
namespace {

constexpr int kBetweenKeys = 50;  // ms, at whether this is over

}  // namespace

KeyboardButtons::KeyboardButtons() : terminal_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (terminal_ < 0 || ::tcgetpgrp(terminal_) != ::getpgrp() || ::tcgetattr(terminal_, &before_) != 0) return;
  termios by_key = before_;
  by_key.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  by_key.c_cc[VMIN] = 1;
  by_key.c_cc[VTIME] = 0;
  // Text that was typed before is not for these buttons.
  if (::tcsetattr(terminal_, TCSAFLUSH, &by_key) != 0) return;
  thread_ = system::Thread("keys", [this] { follow(); });
}

KeyboardButtons::~KeyboardButtons() {
  stopping_ = true;
  if (thread_.is_joinable()) {
    thread_.join();
    ::tcsetattr(terminal_, TCSAFLUSH, &before_);
  }
  if (terminal_ >= 0) ::close(terminal_);
}

void KeyboardButtons::follow() noexcept {
  while (!stopping_) {
    pollfd input{.fd = terminal_, .events = POLLIN, .revents = 0};
    if (::poll(&input, 1, kBetweenKeys) <= 0) continue;
    char key = 0;
    if (::read(terminal_, &key, 1) != 1) {
      down_ = 0;  // no key can release them any more
      return;
    }
    const int button = key - '0';
    if (button >= 0 && button < device::Attendant::kButtons) down_.fetch_xor(static_cast<std::uint16_t>(1U << button));
  }
}

}  // namespace forceshade::apps
