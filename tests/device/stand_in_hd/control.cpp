// SPDX-License-Identifier: BSD-3-Clause
// The test's side.

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "tests/device/stand_in_hd/memory.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"

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

std::optional<Clock::time_point> known(Clock::time_point time) {
  return time == Clock::time_point{} ? std::nullopt : std::optional(time);
}

}  // namespace

void reset() {
  Memory& m = memory();
  const Lock lock(m);
  m.orders = first_orders();
  m.noted = {};
  ++m.resets;
}

void tell(const Orders& orders) {
  Memory& m = memory();
  const Lock lock(m);
  m.orders = orders;
  m.noted.killed = m.noted.crashed = {};
  ++m.tellings;
}

Seen seen() {
  Memory& m = memory();
  Memory::Noted noted;
  std::vector<Memory::Frame> frames;
  {
    const Lock lock(m);
    noted = m.noted;
    const std::uint64_t size = m.frames.size(), kept = std::min(noted.frame_count, size);
    frames.reserve(kept);
    for (std::uint64_t n = noted.frame_count - kept; n < noted.frame_count; ++n) frames.push_back(m.frames[n % size]);
  }
  Seen seen;
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(noted.breach_count, noted.breaches.size()); ++i)
    seen.breaches.emplace_back(noted.breaches[i].data());
  if (noted.breach_count > noted.breaches.size()) seen.breaches.push_back(std::to_string(noted.breach_count) + " breaches");
  if (noted.named) seen.name = noted.name.data();
  const bool is_there = lives(noted.pid);
  seen.died = noted.initialised && !is_there;
  seen.initialised = noted.initialised && is_there;
  seen.scheduler = noted.scheduler && is_there;
  seen.output = noted.output && is_there;
  seen.updates = noted.updates;
  seen.rate = noted.rate;
  seen.frames.reserve(frames.size());
  for (const Memory::Frame& frame : frames) seen.frames.push_back({frame.position, frame.force, frame.time, frame.output});
  seen.pushed_until = noted.pushed_until;
  seen.killed = known(noted.killed);
  seen.crashed = known(noted.crashed);
  seen.killed_under = noted.killed_under;
  return seen;
}

std::optional<Clock::time_point> struck() {
  Memory& m = memory();
  const Lock lock(m);
  return m.noted.killed != Memory::Time{} ? known(m.noted.killed) : known(m.noted.crashed);
}

Arm arm() {
  Memory& m = memory();
  const Lock lock(m);
  const Eigen::Vector3d force = m.noted.force;
  return {force, m.noted.changed, force.isZero(0) ? m.noted.pushed_until : Clock::now(), m.noted.pid};
}

}  // namespace forceshade::stand_in_hd
