// SPDX-License-Identifier: BSD-3-Clause
// A program that drives a PHANToM and dies from within, in the way that its argument names, at the first SIGUSR1.

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "device/phantom/phantom.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"

namespace {

using namespace forceshade;

const char* way = "";
std::atomic<bool> now = false;

// On the stack until there is none left: no number of calls is that high.
long deeper(volatile char* above, long calls) {
  volatile char room[4096];
  room[0] = above[0];
  return calls == 0 ? 0 : deeper(room, calls - 1) + room[0];
}

// In the thread of the servo loop, whatever it is about to do.
void die(int) {
  const auto is = [](const char* name) { return std::strcmp(way, name) == 0; };
  volatile char nothing = 0;
  volatile int* volatile nowhere = nullptr;
  if (is("segmentation fault")) *nowhere = 1;
  if (is("stack overflow")) deeper(&nothing, std::numeric_limits<long>::max());
  if (is("abort")) std::abort();
  if (is("hang"))
    for (;;) pause();
  now = true;
}

// In a thread beside it, as a recorder has one.
void die_beside() {
  while (!now) usleep(100);
  if (way == std::string("exit from another thread")) std::exit(0);
  if (way == std::string("quick exit")) ::_exit(0);
  throw std::runtime_error("not caught");
}

}  // namespace

int main(int, char** arguments) {
  way = arguments[1];
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, SIGUSR1);
  sigprocmask(SIG_BLOCK, &only, nullptr);
  std::thread(die_beside).detach();
  sigprocmask(SIG_UNBLOCK, &only, nullptr);
  signal(SIGUSR1, die);
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  const std::atomic<bool> never = false;
  try {
    device::Phantom phantom("");
    const auto run = device::run_servo_loop(phantom, law, {.max_seconds = std::stod(arguments[2])}, never);
    return run.trip || run.end_reason == device::EndReason::device_fault ? 3 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
