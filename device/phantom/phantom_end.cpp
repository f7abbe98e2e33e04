// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom_end.h"

#include <fcntl.h>
#include <poll.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "device/phantom/phantom_messages.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kWatch{10};
constexpr milliseconds kClosing{200};  // for the last frame
constexpr std::chrono::microseconds kBetweenLooks{500};

// The frames that a crash of this process has time to close, and their own thread.
std::atomic<PhantomFrames*> running = nullptr;
std::atomic<pid_t> driver = 0;
std::atomic<bool> interrupts = false;
thread_local bool is_driver = false;

constexpr int kInterrupt = SIGUSR1;

bool closes_in_time(const PhantomFrames& frames) noexcept {
  const std::int64_t deadline = system::now() + system::in_ns(kClosing);
  while (!frames.closed() && system::now() < deadline) system::sleep_for(kBetweenLooks);
  return frames.closed();
}

// On the frames' own thread. Back in the library it would run a frame of a device that is released.
void interrupted(int) {
  const PhantomFrames* frames = running;
  if (!is_driver || !interrupts || !frames || frames->closed()) return;
  let_go();
  for (;;) ::pause();
}

// Ends the process when the other one is gone, whatever the driver's calls are stuck in: where they let no zero be sent, at
// once, since the device's port is then closed, which is the last that can be done.
void watch(int socket, pid_t parent, LastWords& last_words) {
  std::optional<std::string> words;
  while (!(words = last_words.due()) && !is_alone(socket, parent)) {
    pollfd end{.fd = socket, .events = POLLRDHUP, .revents = 0};
    ::poll(&end, 1, static_cast<int>(kWatch.count()));
  }
  const bool zero_was_sent = let_go();
  if (words)
    send_words(socket, PhantomMessage::Kind::failed, *words);
  else if (zero_was_sent)
    system::sleep_for(kTimeToEnd);
  ::_exit(kStuck);
}

void crashed(int signal) {
  let_go();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// Nothing that is sent to a terminal's programs reaches this process, and no handler of the driver's is ever called.
void be_a_process_of_its_own() {
  ::setsid();
  ::prctl(PR_SET_NAME, "forceshade-hd");
  sigset_t all;
  sigfillset(&all);
  for (const int crash : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
    sigdelset(&all, crash);
    std::signal(crash, crashed);
  }
  std::signal(kInterrupt, interrupted);
  sigprocmask(SIG_SETMASK, &all, nullptr);
}

// What a vendor's library prints goes to standard error; no file of the other process's stays open. The socket, which may have
// a new number.
int have_files_of_its_own(int socket) {
  __fpurge(stdout);
  if (socket <= STDERR_FILENO) socket = ::fcntl(socket, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  constexpr unsigned kFirst = STDERR_FILENO + 1, kLast = ~0U;
  const auto kept = static_cast<unsigned>(socket);
  if (kept > kFirst) ::close_range(kFirst, kept - 1, 0);
  ::close_range(kept + 1, kLast, 0);
  return socket;
}

}  // namespace

// A frame that does not end keeps the driver's locks, so
// that every call of another thread waits for it: then the frames' own thread, which has the locks, releases the device.
bool let_go() noexcept {
  PhantomFrames* frames = running;
  if (!frames) return true;
  if (is_driver) {
    frames->abandon();
    return true;
  }
  frames->close();
  if (closes_in_time(*frames)) return true;
  interrupts = true;
  const pid_t thread = driver;
  if (thread != 0) ::tgkill(::getpid(), thread, kInterrupt);
  return closes_in_time(*frames);
}

void meet_driver() noexcept {
  if (is_driver) return;
  is_driver = true;
  driver = ::gettid();
  sigset_t interrupt;
  sigemptyset(&interrupt);
  sigaddset(&interrupt, kInterrupt);
  ::pthread_sigmask(SIG_UNBLOCK, &interrupt, nullptr);
}

bool is_alone(int socket, pid_t parent) noexcept {
  pollfd end{.fd = socket, .events = POLLRDHUP, .revents = 0};
  const bool closed = ::poll(&end, 1, 0) > 0 && (end.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
  return closed || ::getppid() != parent;
}

// What is registered last is called first. The library's objects are never destroyed, since frames may use them.
void end_force_at_exit() noexcept {
  ::on_exit(
      [](int code, void*) {
        let_go();
        ::_exit(code);
      },
      nullptr);
}

void hold_frames(PhantomFrames* frames) noexcept {
  running = frames;
}

int become_process_of_driver(int socket) {
  be_a_process_of_its_own();
  return have_files_of_its_own(socket);
}

void watch_for_the_end(int socket, pid_t parent, LastWords& last_words) {
  system::Thread("watch", [=, &last_words] { watch(socket, parent, last_words); }).leave();
}

}  // namespace forceshade::device
