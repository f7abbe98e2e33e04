// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A stand-in for the vendor's libHD.so: the same binary interface over the simulated PHANToM, with a scheduler thread of its
// own. It behaves as the vendor's library was seen to, fails as told, and notes every breach of the discipline that the real
// one expects of its callers.
//
// The library may be loaded by this process or by another that it starts: STAND_IN_HD is its path. Orders and what was seen
// lie in memory that the two share. It stays readable however the other process ends.

#include <sys/types.h>

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tests/device/stand_in_hd/orders.h"

namespace forceshade::stand_in_hd {

using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC: one clock for all processes

// The position and the force of a frame: mm, N, in the driver's frame.
struct Frame {
  Eigen::Vector3d position, force;
  Clock::time_point time;  // of its end
  bool output;             // true if the arm got the force
};

// The force on the arm now: the one last sent while the output was on, also when the process that sent it is no more.
struct Arm {
  Eigen::Vector3d force;           // N, in the driver's frame
  Clock::time_point changed{};     // the force
  Clock::time_point pushed_until;  // the last moment at which it was not zero: now, where it is not
  pid_t pid = 0;                   // of the process that initialised the device last
};

struct Seen {
  std::vector<std::string> breaches;                            // no more than 64, then their number
  std::optional<std::string> name;                              // hdInitDevice's
  bool initialised = false, scheduler = false, output = false;  // false if the driver's process is no more
  bool died = false;                                            // it had the device when it ended
  int updates = 0;                                              // of the calibration
  double rate = 1000;
  std::vector<Frame> frames;                         // the last 65 536
  Clock::time_point pushed_until{};                  // the time when the arm was last let go, by zero sent or the output off
  std::optional<Clock::time_point> killed, crashed;  // the times at which `kill` and `crash` were carried out
  Eigen::Vector3d killed_under{0, 0, 0};             // the force on the arm then, N
};

// As though freshly loaded. Not while its scheduler runs. The first of these calls names the memory in the environment's
// STAND_IN_HD_MEMORY, for processes that are started from then on. An event that happens once may happen again after tell().
void reset();
void tell(const Orders& orders);
// Copies every frame while the driver waits: for the end of a run, not to poll.
Seen seen();
// The moment of the signal or crash that was ordered; nothing before it.
std::optional<Clock::time_point> struck();
Arm arm();

}  // namespace forceshade::stand_in_hd
