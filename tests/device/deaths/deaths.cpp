// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/deaths/deaths.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "tests/support/temporary_directory.h"
#include "tests/support/wait_until.h"

namespace forceshade::deaths {
namespace {

using namespace std::chrono_literals;
using stand_in_hd::Clock;
using stand_in_hd::Crash;
using stand_in_hd::Orders;

constexpr const char* kSeconds = "2.2";        // of a run: the press begins after 0.7 s and contact soon after
constexpr const char* kSecondsToStop = "1.3";  // ends in contact
constexpr double kFelt = 0.01;                 // N

// In a directory of its own, with its output in a file.
pid_t started(const tests::TemporaryDirectory& directory, std::vector<std::string> words) {
  const std::string path = directory.path(), output = directory.file("output");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t process = fork();
  if (process != 0) return process;
  const int to = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dup2(to, STDOUT_FILENO);
  dup2(to, STDERR_FILENO);
  if (chdir(path.c_str()) == 0) execv(arguments.front(), arguments.data());
  _exit(127);
}

// How the process ended, if it did within this time.
std::optional<std::string> ended(pid_t process, Clock::duration timeout) {
  for (const auto deadline = Clock::now() + timeout; Clock::now() < deadline; std::this_thread::sleep_for(1ms)) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) == process)
      return WIFEXITED(status) ? "exit " + std::to_string(WEXITSTATUS(status)) : "signal " + std::to_string(WTERMSIG(status));
  }
  return std::nullopt;
}

bool is_gone(pid_t process) {
  return process == 0 || (kill(process, 0) != 0 && errno == ESRCH);
}

Orders orders_of(const Death& death, Moment phase) {
  Orders orders{.press = true};
  if (phase == Moment::tripping) orders.trip_at = 100;
  if (death.crash)
    orders.crash = {.how = *death.crash, .when = phase};
  else
    orders.kill = {.pid = death.to_driver ? stand_in_hd::Kill::kDriver : stand_in_hd::Kill::kParent,
                   .signal = death.signal.value_or(SIGUSR1),
                   .when = phase,
                   .times = death.times};
  return orders;
}

}  // namespace

const char* name_of(Moment phase) {
  switch (phase) {
    case Moment::before_start: return "before the start";
    case Moment::free: return "free";
    case Moment::contact: return "in contact";
    case Moment::tripping: return "while tripping";
    default: return "while stopping";
  }
}

std::vector<Death> catalogue() {
  std::vector<Death> all;
  // What does not end a program by default, what drive lives through, and what stops a process.
  const auto goes_on = [](int signal) {
    for (const int harmless : {SIGCHLD, SIGCONT, SIGURG, SIGWINCH, SIGPIPE, SIGXFSZ, SIGTTIN, SIGTTOU})
      if (signal == harmless) return true;
    return false;
  };
  const auto name = [](int signal) {
    const char* abbreviation = sigabbrev_np(signal);
    return abbreviation ? std::string("SIG") + abbreviation : "real-time signal " + std::to_string(signal - SIGRTMIN);
  };
  std::vector<int> signals;
  for (int signal = 1; signal < 32; ++signal) signals.push_back(signal);
  signals.insert(signals.end(), {SIGRTMIN, SIGRTMAX});
  for (const int signal : signals)
    all.push_back(
        {.what = name(signal), .expected = goes_on(signal) ? Expected::goes_on : Expected::lets_go, .signal = signal});
  all.push_back({.what = "SIGINT twice at once", .signal = SIGINT, .times = 2});
  for (const char* way : {"abort", "segmentation fault", "stack overflow", "hang", "exception in another thread",
                          "exit from another thread", "quick exit"})
    all.push_back({.what = way, .way = way});
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGTSTP, SIGPIPE, SIGALRM})
    all.push_back({.what = "driver: " + name(signal), .expected = Expected::goes_on, .signal = signal, .to_driver = true});
  for (const int signal : {SIGKILL, SIGSTOP})
    all.push_back({.what = "driver: " + name(signal), .expected = Expected::stays_on, .signal = signal, .to_driver = true});
  const auto crash = [&](const char* what, Crash::How how) {
    all.push_back({.what = std::string("driver: ") + what, .crash = how});
  };
  crash("segmentation fault in a frame", Crash::How::segmentation_fault);
  crash("abort in a frame", Crash::How::abort);
  crash("exit in a frame", Crash::How::exit);
  crash("a call that never returns", Crash::How::hang);
  return all;
}

Outcome tried(const Death& death, Moment phase) {
  setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  stand_in_hd::reset();
  stand_in_hd::tell(orders_of(death, phase));
  const tests::TemporaryDirectory directory;
  const char* seconds = phase == Moment::stopping ? kSecondsToStop : kSeconds;
  const pid_t program = death.way.empty()
                            ? started(directory, {FORCESHADE_COMMAND, "drive", "--device", "phantom", "--law", "wall",
                                                  "--uncertified", "--seconds", seconds, "--record", "run.fsr"})
                            : started(directory, {FORCESHADE_MORTAL, death.way, seconds});
  Outcome outcome;
  std::optional<std::string> end;
  tests::comes_true_within(10s, [&] { return (end = ended(program, 1ms)).has_value() || stand_in_hd::struck(); });
  // Long enough for the program to end in order, for a driver that is alive to let go, and for a run that goes on to go on.
  if (!end) end = ended(program, 4s);
  if (!end) {
    outcome.end = "does not end";
    if (stand_in_hd::arm().force.norm() > kFelt) outcome.seen = Expected::stays_on;
    kill(program, SIGKILL);
    waitpid(program, nullptr, 0);
  } else {
    outcome.end = *end;
  }
  const auto arm = stand_in_hd::arm();
  tests::comes_true_within(4s, [&] { return is_gone(arm.pid); });
  const auto moment = stand_in_hd::struck();
  outcome.took_effect = moment.has_value();
  outcome.force = stand_in_hd::arm().force.norm();
  outcome.driver_is_left = !is_gone(arm.pid);
  if (outcome.driver_is_left) kill(arm.pid, SIGKILL);
  if (outcome.force > kFelt) outcome.seen = Expected::stays_on;
  if (!outcome.took_effect || outcome.seen == Expected::stays_on) return outcome;
  const auto late = std::max(Clock::duration(0), stand_in_hd::arm().pushed_until - *moment);
  outcome.to_zero = std::chrono::duration<double, std::milli>(late).count();
  // The force of a run that goes on lasts until its time is up; one that is ended in order has none soon after.
  if (outcome.to_zero > 300 && outcome.end == "exit 0") outcome.seen = Expected::goes_on;
  return outcome;
}

}  // namespace forceshade::deaths
