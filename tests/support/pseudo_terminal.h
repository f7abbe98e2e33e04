// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A process on a terminal of its own, where the test reads and types.

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <functional>
#include <stdexcept>
#include <string>

namespace forceshade::tests {

inline void send_to_null(int stream) {
  if (::dup2(::open("/dev/null", O_RDWR | O_CLOEXEC), stream) < 0) ::_exit(126);
}

class PseudoTerminal {
 public:
  // The program's return value is its exit code.
  explicit PseudoTerminal(const std::function<int()>& program) {
    process_ = ::forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (process_ < 0) throw std::runtime_error("no terminal to be had");
    if (process_ != 0) return;
    // GCC 12's thread sanitizer may lose a signal that comes in a thread's first blocking call: this is that call.
    ::poll(nullptr, 0, 0);
    ::_exit(program());
  }
  ~PseudoTerminal() {
    if (process_ > 0) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
    ::close(terminal_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  // All that was shown so far, once the words are in it, or once nothing more will come.
  const std::string& shown_until(const std::string& words) {
    std::array<char, 4096> some;
    while (shown_.find(words) == std::string::npos) {
      const ssize_t got = ::read(terminal_, some.data(), some.size());
      if (got <= 0) break;  // the process has ended
      shown_.append(some.data(), static_cast<std::size_t>(got));
    }
    return shown_;
  }

  void type(const std::string& keys) const {
    if (::write(terminal_, keys.data(), keys.size()) < 0) throw std::runtime_error("the terminal takes no keys");
  }

  bool is_running() const { return ::waitpid(process_, nullptr, WNOHANG) == 0; }

  // Waits for its end: the exit code, or 128 and the signal's number.
  int end() {
    shown_until("\x01 never shown");
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  const std::string& shown() const { return shown_; }

 private:
  int terminal_ = -1;
  pid_t process_ = -1;
  std::string shown_;
};

}  // namespace forceshade::tests
