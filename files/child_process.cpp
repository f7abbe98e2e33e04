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

constexpr std::size_t kLastWords = 2000;
constexpr std::chrono::milliseconds kToReport{50}, kToBeEnded{5000};  // for the keeper: an end, and once the grace is over

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

std::string seconds(std::chrono::milliseconds time) {
  return shortest(static_cast<double>(time.count()) / 1000) + " s";
}

}  // namespace

ChildProcess::ChildProcess(const std::string& command, const ProcessLimits& limits, const char* whose)
    : limits_(limits), whose_(whose) {
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
    for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
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

// Writes what it can of `rest` and reads what there is, once.
bool ChildProcess::transfer(std::string_view& rest, std::int64_t until) {
  std::array<pollfd, 3> ends{pollfd{from_, POLLIN, 0}, {errors_, POLLIN, 0}, {rest.empty() ? -1 : to_, POLLOUT, 0}};
  const int left = milliseconds_until(until);
  if (left == 0) fail("did not answer within " + seconds(limits_.answer));
  if (::poll(ends.data(), ends.size(), left) < 0 && errno != EINTR) fail("could not be heard");
  std::array<char, 1 << 16> block;
  if (ends[1].revents != 0) {
    if (const ssize_t size = ::read(errors_, block.data(), block.size()); size > 0) {
      last_words_.append(block.data(), static_cast<std::size_t>(size));
      if (last_words_.size() > kLastWords) last_words_.erase(0, last_words_.size() - kLastWords);
    } else if (size == 0) {
      ::close(std::exchange(errors_, -1));
    }
  }
  if (ends[2].revents != 0) {
    const NoBrokenPipe no_broken_pipe;
    const ssize_t size = ::write(to_, rest.data(), rest.size());
    if (size > 0) rest.remove_prefix(static_cast<std::size_t>(size));
    if (size < 0 && errno == EPIPE) rest = {};  // how it ended is seen below
  }
  if (ends[0].revents == 0) return true;
  const ssize_t size = ::read(from_, block.data(), block.size());
  if (size > 0) said_.append(block.data(), static_cast<std::size_t>(size));
  return size != 0;
}

std::string ChildProcess::ask(std::string_view line) {
  if (!said_.empty()) fail("wrote without having been asked: " + shown(said_));
  const std::string sent = std::string(line) + '\n';
  std::string_view rest = sent;
  std::string answer = next_line(rest);
  if (!rest.empty()) fail("answered before it was asked: " + shown(answer));
  return answer;
}

std::string ChildProcess::hear() {
  std::string_view nothing;
  return next_line(nothing);
}

// Writes `rest` meanwhile.
std::string ChildProcess::next_line(std::string_view& rest) {
  const std::int64_t until = system::now() + system::in_ns(limits_.answer);
  std::size_t end = said_.find('\n');
  while (end == std::string::npos) {
    const std::size_t looked_at = said_.size();
    if (!transfer(rest, until))
      fail(how_it_ended(std::max(until, system::now() + system::in_ns(kToReport))) + " without an answer");
    end = said_.find('\n', looked_at);
    if (std::min(end, said_.size()) > limits_.longest_line)
      fail("wrote a line of more than " + std::to_string(limits_.longest_line) + " bytes: " + shown(said_));
  }
  std::string answer = said_.substr(0, end);
  said_.erase(0, end + 1);
  if (answer.ends_with('\r')) answer.pop_back();
  return answer;
}

void ChildProcess::say_goodbye(std::string_view line) {
  const std::string sent = std::string(line) + '\n';
  std::string_view rest = sent;
  const std::int64_t until = system::now() + system::in_ns(limits_.answer);
  while (!rest.empty()) {
    if (!transfer(rest, until)) break;
    if (!said_.empty()) fail("wrote after goodbye: " + shown(said_));
  }
  ::close(std::exchange(to_, -1));
  while (transfer(rest, until))
    if (!said_.empty()) fail("wrote after goodbye: " + shown(said_));
  if (const std::string end = how_it_ended(until); end != "ended") fail(end);
}

std::string ChildProcess::dismiss(std::string_view lines) noexcept try {
  const std::int64_t until = system::now() + system::in_ns(limits_.grace + kToBeEnded);
  const auto hand_over = [&] {
    const bool is_more = transfer(lines, until);
    said_.clear();
    return is_more;
  };
  while (!lines.empty() && hand_over()) {
  }
  // The keeper's grace begins.
  for (int* const end : {&to_, &control_}) ::close(std::exchange(*end, -1));
  lines = {};
  while (hand_over()) {
  }
  return how_it_ended(until);
} catch (const std::exception&) {
  return "could not be ended";
}

// Its output is at its end. Waits for it.
std::string ChildProcess::how_it_ended(std::int64_t until) {
  pollfd reports{status_ ? -1 : reports_, POLLIN, 0};
  if (!status_ && ::poll(&reports, 1, milliseconds_until(until)) <= 0) return "closed its output, and did not end";
  int status = status_.value_or(0);
  if (!status_ && ::read(reports_, &status, sizeof status) != sizeof status)
    return control_ >= 0 ? "ended the process that watches it"
                         : "did not end within " + seconds(limits_.grace) + ", and was ended";
  status_ = status;
  if (status == kTooMany) return "had more than " + std::to_string(limits_.threads) + " processes and threads, and ended";
  if (WIFSIGNALED(status))
    return "was killed by signal " + std::to_string(WTERMSIG(status)) + " (" + ::strsignal(WTERMSIG(status)) + ")";
  if (WEXITSTATUS(status) == 127) return "could not be started: the shell knows no such command";
  if (WEXITSTATUS(status) == limits_.ended_well) return "ended";
  return WEXITSTATUS(status) == 0 ? "ended too early" : "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

void ChildProcess::fail(const std::string& words) {
  const std::size_t end = last_words_.find_last_not_of('\n');
  const std::size_t begin = end == std::string::npos ? end : last_words_.rfind('\n', end);
  const std::string last = end == std::string::npos ? "" : last_words_.substr(begin == std::string::npos ? 0 : begin + 1);
  throw ProcessFailed(std::string("the ") + whose_ + ' ' + words +
                      (last.empty() ? "" : "; it wrote last on standard error: " + shown(last.substr(0, last.find('\n')))));
}

}  // namespace forceshade::files
