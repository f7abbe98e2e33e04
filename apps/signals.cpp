// SPDX-License-Identifier: BSD-3-Clause
#include "apps/signals.h"

#include <string.h>  // NOLINT(modernize-deprecated-headers): sigabbrev_np

#include <cerrno>
#include <csignal>
#include <cstdint>

#include "system/system.h"

namespace forceshade::apps {
namespace {

std::atomic<bool> interrupt_flag{false};
std::atomic<int> first_signal{0}, requests{0};
std::atomic<std::int64_t> time_of_first{0};  // ns, CLOCK_MONOTONIC
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
                  std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler sets them");

// The end of a run is given this long before a person may cut it off: three signals by mistake come within it.
constexpr int kRequestsThatInsist = 3;
constexpr std::int64_t kUndisturbed = 2 * system::kSecond;  // ns

enum class Reaction {
  ends_the_run,
  ignored,      // else a write that fails, or a terminal that is lost, would end or stop the process
  systems_own,  // harmless, or a fault of the program, or not to be caught
};

Reaction reaction_to(int number) {
  if (number >= SIGRTMIN && number <= SIGRTMAX) return Reaction::ends_the_run;
  switch (number) {
    case SIGINT:
    case SIGTERM:
    case SIGQUIT:
    case SIGHUP:
    // A process that is stopped would hold the last force.
    case SIGTSTP:
    case SIGUSR1:
    case SIGUSR2:
    case SIGALRM:
    case SIGVTALRM:
    case SIGPROF:
    case SIGIO:
    case SIGPWR:
    case SIGSTKFLT:
    case SIGXCPU: return Reaction::ends_the_run;
    case SIGPIPE:
    case SIGXFSZ:
    case SIGTTIN:
    case SIGTTOU: return Reaction::ignored;
    default: return Reaction::systems_own;
  }
}

void react(int number, void (*handler)(int), int flags) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(number, &action, nullptr);
}

bool is_ignored(int number) noexcept {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void note(int number) noexcept {
  std::int64_t no_time = 0;
  int none = 0;
  time_of_first.compare_exchange_strong(no_time, system::now());
  first_signal.compare_exchange_strong(none, number);
  interrupt_flag = true;
}

extern "C" void interrupt(int number) {
  note(number);
}

extern "C" void end_in_order(int number) {
  const int kept = errno;
  note(number);
  const bool from_a_person = number == SIGINT || number == SIGTERM || number == SIGQUIT;
  if (from_a_person && ++requests >= kRequestsThatInsist && system::now() - time_of_first >= kUndisturbed) {
    react(number, SIG_DFL, 0);
    raise(number);  // delivered when this handler returns
  }
  errno = kept;
}

}  // namespace

const std::atomic<bool>& interrupted() {
  return interrupt_flag;
}

std::string interrupting_signal() {
  const int number = first_signal;
  if (number == 0) return "";
  if (const char* name = sigabbrev_np(number)) return std::string("SIG") + name;
  return "SIGRTMIN+" + std::to_string(number - SIGRTMIN);
}

void watch_for_interrupt() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (number != SIGHUP || !is_ignored(number)) react(number, interrupt, static_cast<int>(SA_RESETHAND));
}

void end_runs_in_order() {
  sigset_t ending;
  sigemptyset(&ending);
  for (int number = 1; number <= SIGRTMAX; ++number) {
    const Reaction reaction = reaction_to(number);
    if (reaction == Reaction::ignored) react(number, SIG_IGN, 0);
    if (reaction != Reaction::ends_the_run) continue;
    // As by nohup: whoever started the command lets it outlive the terminal.
    if (number == SIGHUP && is_ignored(number)) continue;
    react(number, end_in_order, SA_RESTART);
    sigaddset(&ending, number);
  }
  // If a parent ignored it, a child that ended could not be waited for.
  react(SIGCHLD, SIG_DFL, 0);
  pthread_sigmask(SIG_UNBLOCK, &ending, nullptr);
}

}  // namespace forceshade::apps
