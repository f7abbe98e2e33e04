// SPDX-License-Identifier: BSD-3-Clause
#include "apps/terminal_attendant.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <sstream>

#include "apps/signals.h"
#include "apps/tell.h"
#include "files/printable.h"
#include "forceshade/device.h"

namespace forceshade::apps {
namespace {

constexpr int kBetweenLooks = 100;  // ms, at a signal that came just before poll()

// The terminal that commands this process, whatever standard input is; else standard input if it is a terminal.
class Terminal {
 public:
  Terminal() : own_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {}
  ~Terminal() {
    if (own_ >= 0) ::close(own_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  bool is_there() const { return own_ >= 0 || ::isatty(STDIN_FILENO) != 0; }

  void show(const std::string& text) const {
    const int to = own_ >= 0 ? own_ : STDERR_FILENO;
    if (::write(to, text.data(), text.size()) < 0) return;  // then it is not read, and Enter will not come either
  }

  // Drops what was typed until now. Before the prompt is shown: an answer to it must not be lost.
  void forget_input() const { ::tcflush(own_ >= 0 ? own_ : STDIN_FILENO, TCIFLUSH); }

  // False at the end of input, after an error or a signal.
  bool waited_for_enter() const {
    const int from = own_ >= 0 ? own_ : STDIN_FILENO;
    while (!interrupted()) {
      pollfd input{.fd = from, .events = POLLIN, .revents = 0};
      const int ready = ::poll(&input, 1, kBetweenLooks);
      if (ready < 0 && errno != EINTR) return false;
      if (ready <= 0) continue;
      std::array<char, 256> line;
      const ssize_t got = ::read(from, line.data(), line.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      if (line[static_cast<std::size_t>(got) - 1] == '\n') return true;
    }
    return false;
  }

 private:
  int own_;
};

// Line by line, because a line feed would be made visible too.
std::string shown(const std::string& words) {
  std::string all, line;
  for (std::istringstream lines(words); std::getline(lines, line);) {
    if (!all.empty()) all += '\n';
    all += files::printable(line);
  }
  return all;
}

void say(const std::string& words) {
  std::fprintf(stderr, "%s: %s\n", program_name().c_str(), words.c_str());
}

constexpr int kBetweenKeys = 50;  // ms, after which it looks whether this is over

}  // namespace

void TerminalAttendant::report(const std::string& words) noexcept {
  say(shown(words));
}

bool TerminalAttendant::did(const std::string& words) noexcept {
  const std::string what = shown(words);
  const Terminal terminal;
  if (!terminal.is_there()) {
    say("this has to be done, and there is no terminal on which somebody could say that it was: " + what + "\n" + what_else_);
    return false;
  }
  terminal.forget_input();
  terminal.show("\n" + what + "\nPress Enter when this is done, or Ctrl-C to end here. ");
  if (terminal.waited_for_enter()) return true;
  terminal.show("\n");
  if (!interrupted()) say("not confirmed on the terminal: " + what + "\n" + what_else_);
  return false;
}

bool TerminalAttendant::has_left() const noexcept {
  return interrupted();
}

const std::atomic<std::uint16_t>* TerminalAttendant::buttons() noexcept {
  if (!offers_buttons_) return nullptr;
  if (!keys_) keys_.emplace();
  if (!keys_->works()) {
    say("the buttons of a simulated device are keys of a terminal, and there is none to read from");
    return nullptr;
  }
  say("the key 0 presses button 0 of the simulated device and, typed again, lets go of it; the key 1 does so with button 1");
  return &keys_->down();
}

bool HoldsResetPose::did(const std::string& words) noexcept {
  say(shown(words) + " (taken as done because of --in-reset-pose)");
  return true;
}

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
