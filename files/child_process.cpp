// SPDX-License-Identifier: BSD-3-Clause
#include "files/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "files/csv.h"
#include "files/keeper.h"
#include "files/printable.h"
#include "system/system.h"

namespace forceshade::files {
namespace {

struct Pipe {
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  int take(std::size_t end) { return std::exchange(ends[end], -1); }
  std::array<int, 2> ends{-1, -1};
};

// Or less, where less is allowed already.
void limit(int what, rlim_t most) {
  rlimit is{most, most};
  ::getrlimit(static_cast<__rlimit_resource>(what), &is);
  most = std::min(most, is.rlim_max);
  const rlimit both{most, most};
  if (::setrlimit(static_cast<__rlimit_resource>(what), &both) != 0) ::_exit(126);
}

// Writing to a program that has gone is an error here and no signal.
class NoBrokenPipe {
 public:
  NoBrokenPipe() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &set_, &before_);
  }
  ~NoBrokenPipe() {
    const timespec none{};
    if (!was_pending_)
      while (sigtimedwait(&set_, nullptr, &none) == SIGPIPE) {
      }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  sigset_t set_{}, before_{};
  bool was_pending_ = false;
};

// At least 0, as poll() takes it.
int milliseconds_until(std::int64_t time) {
  constexpr std::int64_t kMillisecond = 1'000'000;
  return static_cast<int>(std::max<std::int64_t>(0, (time - system::now() + kMillisecond - 1) / kMillisecond));
}

}  // namespace

ChildProcess::ChildProcess(const std::string& command, const ProcessLimits& limits, const char* whose)
    : LineProgram(limits, whose) {
  Pipe in, out, errors, control, reports;
  const rlim_t most_threads = threads_of_this_user() + limits.threads;
  const std::array<const char*, 4> arguments{"/bin/sh", "-c", command.c_str(), nullptr};
  const auto become_program = [&] {  // only what a signal handler may call, since other threads may hold locks
    ::setsid();
    for (const auto& [from, to] :
         {std::pair{in.ends[0], STDIN_FILENO}, {out.ends[1], STDOUT_FILENO}, {errors.ends[1], STDERR_FILENO}})
      if (::dup2(from, to) < 0) ::_exit(126);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.processor_seconds);
    limit(RLIMIT_DATA, limits.memory);
    limit(RLIMIT_FSIZE, rlim_t{limits.file_megabytes} << 20U);
    limit(RLIMIT_NPROC, most_threads);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int number : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
    ::execve("/bin/sh", const_cast<char* const*>(arguments.data()), environ);
  };
  keeper_ = ::fork();
  if (keeper_ < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  if (keeper_ == 0) {
    ::close(control.take(1));
    keep(become_program, control.ends[0], reports.ends[1], limits);
  }
  control_ = control.take(1);
  reports_ = reports.take(0);
  to_ = in.take(1);
  from_ = out.take(0);
  errors_ = errors.take(0);
  for (const int end : {to_, from_, errors_}) ::fcntl(end, F_SETFL, ::fcntl(end, F_GETFL) | O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  for (const int end : {to_, from_, errors_, control_, reports_})
    if (end >= 0) ::close(end);
  ::waitpid(keeper_, nullptr, 0);
}

// Closes what is to be closed, waits, then writes and reads what it can, once.
void ChildProcess::move(std::int64_t time) {
  const auto close_end = [](int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  };
  if (lines_.closes_input()) close_end(to_);
  if (lines_.ends_it()) close_end(control_);  // the keeper's grace begins
  const std::string_view rest = lines_.to_send();
  std::array<pollfd, 4> ends{pollfd{from_, POLLIN, 0},
                             {errors_, POLLIN, 0},
                             {rest.empty() ? -1 : to_, POLLOUT, 0},
                             {lines_.has_ended_output() ? reports_ : -1, POLLIN, 0}};
  if (::poll(ends.data(), ends.size(), milliseconds_until(time)) < 0) return;  // a signal came
  std::array<char, 1 << 12> block;
  if (ends[1].revents != 0) {
    if (const ssize_t size = ::read(errors_, block.data(), block.size()); size > 0)
      lines_.complained({block.data(), static_cast<std::size_t>(size)});
    else if (size == 0)
      close_end(errors_);
  }
  if (ends[2].revents != 0) {
    const NoBrokenPipe no_broken_pipe;
    const ssize_t size = ::write(to_, rest.data(), rest.size());
    if (size > 0) lines_.took(static_cast<std::size_t>(size));
    if (size < 0 && errno == EPIPE) lines_.takes_no_more();  // how it ended is seen below
  }
  if (ends[3].revents != 0) {
    int status = 0;
    const bool is_whole = ::read(reports_, &status, sizeof status) == sizeof status;
    lines_.ended(is_whole ? std::optional(status) : std::nullopt);
  }
  if (ends[0].revents == 0) return;
  const ssize_t size = ::read(from_, block.data(), block.size());
  if (size > 0) lines_.said({block.data(), static_cast<std::size_t>(size)});
  if (size != 0) return;
  close_end(from_);
  lines_.ended_output();
}

}  // namespace forceshade::files
