// SPDX-License-Identifier: BSD-3-Clause
// phantom_death DEATH: `forceshade drive` over the stand-in for a PHANToM's driver, in which a process dies in contact: that of
// the servo loop by the signal SIGTERM, SIGKILL or SIGSTOP, or that of the driver by a crash in a frame (`crash`). Prints for
// how many ms the arm then felt a force, or "did not happen". Exit code 1: the force stays, or a process is left.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/wait_until.h"

namespace {

using namespace forceshade::stand_in_hd;
using forceshade::tests::comes_true_within;

constexpr std::chrono::seconds kLongest{4};

pid_t started() {
  const pid_t program = fork();
  if (program != 0) return program;
  dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
  execl(FORCESHADE_COMMAND, "forceshade", "drive", "--device", "phantom", "--law", "wall", "--certificate", "none", "--seconds", "2.2",
        nullptr);
  _exit(127);
}

}  // namespace

int main(int, char** words) {
  const std::map<std::string, int> signals{{"SIGTERM", SIGTERM}, {"SIGKILL", SIGKILL}, {"SIGSTOP", SIGSTOP}};
  Orders orders{.press = true};
  if (words[1] == std::string("crash"))
    orders.crash = {.how = Crash::How::segmentation_fault, .when = Moment::contact};
  else
    orders.crash = {.how = Crash::How::signal_to_parent, .when = Moment::contact, .signal = signals.at(words[1])};
  setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  reset();
  tell(orders);
  const pid_t program = started();
  int status = 0;
  waitpid(program, &status, WUNTRACED);
  const auto moment = struck();
  const bool is_free = comes_true_within(kLongest, [] { return arm().force.isZero(0); });
  if (WIFSTOPPED(status)) {
    kill(program, SIGKILL);
    waitpid(program, nullptr, 0);
  }
  const bool is_gone = comes_true_within(kLongest, [] { return kill(arm().pid, 0) != 0; });
  if (!moment) return std::puts("did not happen"), 0;
  const auto late = std::max(Clock::duration(0), arm().pushed_until - *moment);
  std::printf("%.1f\n", std::chrono::duration<double, std::milli>(late).count());
  return is_free && is_gone ? 0 : 1;
}
