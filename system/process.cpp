// SPDX-License-Identifier: BSD-3-Clause
#include "system/process.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <stdio_ext.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "system/crash_signals.h"
#include "system/system.h"

namespace forceshade::system {
namespace {

constexpr int kInterrupt = SIGUSR1;
constexpr std::chrono::milliseconds kBetweenLooks{1};
constexpr int kKilledFirst = 1000, kKilledLast = -1000;  // order if memory runs out

std::atomic<LastAct*> last_act = nullptr;
std::atomic<int> others = 0;            // processes that are to outlive this one
std::atomic<int> readiness_before = 0;  // of this one to be killed, before there was any

[[noreturn]] void refuse(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void crashed(int signal) {
  if (LastAct* const act = last_act) act->let_go();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void interrupted(int) {
  LastAct* const act = last_act;
  if (!act || !act->interrupted()) return;
  for (;;) ::pause();
}

// Nothing that is sent to a terminal's programs reaches this process, and no handler of a library's is ever called.
void be_a_process_of_its_own(const char* name) {
  ::setsid();
  ::prctl(PR_SET_NAME, name);
  sigset_t all;
  sigfillset(&all);
  for (const int crash : kCrashSignals) {
    sigdelset(&all, crash);
    std::signal(crash, crashed);
  }
  std::signal(kInterrupt, interrupted);
  sigprocmask(SIG_SETMASK, &all, nullptr);
}

// Sends to standard error what a library prints, and closes all files of the other process. Returns the socket, which may have
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

// Sets how readily the system kills this process where memory runs out, from -1000 (never) to 1000, and returns what it was.
// Any process may raise its own, and take that back.
int be_victim(int readiness) noexcept {
  const int file = ::open("/proc/self/oom_score_adj", O_RDWR | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 16> text{};
  const bool was_read = ::read(file, text.data(), text.size() - 1) > 0;
  const int was = was_read ? std::atoi(text.data()) : 0;
  const int size = std::snprintf(text.data(), text.size(), "%d", readiness);
  // Without the right to, it stays as ready as it was.
  [[maybe_unused]] const ssize_t written = ::pwrite(file, text.data(), static_cast<std::size_t>(size), 0);
  ::close(file);
  return was;
}

// True if one of these events comes by then; a signal ends the wait.
bool comes(int socket, short events, short all, std::int64_t deadline) noexcept {
  const std::int64_t left = std::max<std::int64_t>(0, deadline - now());
  const timespec time{.tv_sec = left / kSecond, .tv_nsec = left % kSecond};
  pollfd waiting{.fd = socket, .events = events, .revents = 0};
  return ::ppoll(&waiting, 1, &time, nullptr) > 0 && (waiting.revents & all) != 0;
}

}  // namespace

bool Packets::send(const void* message, std::size_t size) noexcept {
  ssize_t sent = 0;
  do sent = ::send(end_, message, size, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(size);
}

Packets::Received Packets::receive(void* message, std::size_t size, std::int64_t deadline) noexcept {
  if (!comes(end_, POLLIN, ~0, deadline)) return Received::nothing_yet;
  const ssize_t received = ::recv(end_, message, size, 0);
  if (received == static_cast<ssize_t>(size)) return Received::message;
  return received < 0 && errno == EINTR ? Received::nothing_yet : Received::closed;
}

// A copy of the other process may keep its end open.
bool Packets::is_alone(std::int64_t deadline) noexcept {
  const bool closed = comes(end_, POLLRDHUP, POLLRDHUP | POLLHUP | POLLERR, deadline);
  return closed || (other_process_ > 0 && ::getppid() != other_process_);
}

KilledFirst::KilledFirst() noexcept {
  if (others++ == 0) readiness_before = be_victim(kKilledFirst);
}

KilledFirst::~KilledFirst() {
  if (--others == 0) be_victim(readiness_before);
}

Process::Process(const char* name, const std::function<int(Packets&)>& body) : packets_(-1, 0) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) refuse("no socket");
  const int self = ::getpid();
  id_ = ::fork();
  if (id_ == 0) {
    ::close(ends[0]);
    be_a_process_of_its_own(name);
    if (others > 0) be_victim(readiness_before);  // if the right to the next is lacking
    be_victim(kKilledLast);
    Packets its(have_files_of_its_own(ends[1]), self);
    end(body(its));
  }
  ::close(ends[1]);
  packets_ = {ends[0], 0};
  if (id_ > 0) {
    first_.emplace();
    return;
  }
  const int error = errno;
  close();
  errno = error;
  refuse("cannot be made");
}

Process::~Process() {
  close();
}

void Process::close() noexcept {
  if (packets_.end() >= 0) ::close(packets_.end());
  packets_ = {-1, 0};
}

std::optional<Process::Ended> Process::ended(std::int64_t deadline) noexcept {
  int status = 0;
  while (::waitpid(id_, &status, WNOHANG) == 0) {
    if (now() > deadline) return std::nullopt;
    sleep_for(kBetweenLooks);
  }
  if (WIFSIGNALED(status)) return Ended{.signal = WTERMSIG(status)};
  return Ended{.code = WEXITSTATUS(status)};
}

void Process::resume() noexcept {
  ::kill(id_, SIGCONT);
}

void Process::kill() noexcept {
  ::kill(id_, SIGKILL);
}

// The handler registered last runs first. The library's objects are never destroyed, since its threads may use them.
void before_end(LastAct& act) noexcept {
  last_act = &act;
  ::on_exit(
      [](int code, void*) {
        last_act.load()->let_go();
        end(code);
      },
      nullptr);
}

void end(int code) noexcept {
  ::_exit(code);
}

int this_thread() noexcept {
  return ::gettid();
}

void allow_interrupt() noexcept {
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, kInterrupt);
  ::pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
}

void interrupt(int thread) noexcept {
  ::tgkill(::getpid(), thread, kInterrupt);
}

void* map_shared(std::size_t size) {
  void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) refuse("no shared memory");
  return memory;
}

void unmap_shared(void* memory, std::size_t size) noexcept {
  ::munmap(memory, size);
}

}  // namespace forceshade::system
