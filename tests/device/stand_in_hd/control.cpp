// SPDX-License-Identifier: BSD-3-Clause
// The test's side.

#include <unistd.h>

#include <cstdlib>

#include "tests/device/stand_in_hd/memory.h"

namespace forceshade::stand_in_hd {
namespace {

// As long as this process lives, others find it under this process's number, and no file is left behind.
Memory& memory() {
  static Memory& it = []() -> Memory& {
    int file = -1;
    Memory& fresh = made(&file);
    const std::string path = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file);
    setenv(kMemory, path.c_str(), 1);
    return fresh;
  }();
  return it;
}

Memory::Noted noted() {
  const Lock lock(memory());
  return memory().noted;
}

}  // namespace

void reset() {
  const Lock lock(memory());
  memory().orders = first_orders();
  memory().noted = {};
}

void tell(const Orders& orders) {
  const Lock lock(memory());
  memory().orders = orders;
  memory().noted.struck = {};
}

Seen seen() {
  const Memory::Noted it = noted();
  const bool lives = stand_in_hd::lives(it.pid);
  return {.initialised = it.initialised && lives,
          .scheduler = it.scheduler && lives,
          .output = it.output && lives,
          .frames = it.frames};
}

std::optional<Clock::time_point> struck() {
  const Clock::time_point time = noted().struck;
  return time == Clock::time_point{} ? std::nullopt : std::optional(time);
}

Arm arm() {
  const Memory::Noted it = noted();
  const Eigen::Vector3d force = it.force;
  return {force, force.isZero(0) ? it.pushed_until : Clock::now(), it.pid};
}

}  // namespace forceshade::stand_in_hd
