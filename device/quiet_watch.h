// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks at a device for some seconds without any force: how fast it answers, what moves, how quiet it is at rest.

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "forceshade/device.h"
#include "system/system.h"

namespace forceshade::device {

// Statistics of the readings that differ in the device's time: one that is read twice counts once.
struct Observed {
  std::optional<Fault> fault;  // ended it early
  system::RealTime::Granted granted;
  std::optional<double> latest_waking;  // ms after the time that was asked for; empty where frames wake the loop
  State state = {};                     // with the last reading
  std::size_t readings = 0;
  double seconds = 0;  // between the first and the last
  double rate = 0;     // Hz; 0 with fewer than two readings
  // ms between two readings: root mean square of what it differs by from its mean, and the longest.
  double jitter = 0, longest_gap = 0;
  bool finite = true;  // every position
  // mm, in the laws' frame. The noise is the root mean square about the mean.
  Eigen::Vector3d noise{0, 0, 0}, extent{0, 0, 0}, last{0, 0, 0};
  std::optional<std::array<std::int64_t, 3>> counts_moved;  // highest less lowest; from a device that shows encoders
  std::uint16_t pressed = 0, released = 0;                  // buttons that went down, and up, since the first reading
  // mm: the most that a position is away from our kinematics of the joint angles; with `left` the turret's angle counts to
  // the left. None without joint angles or a model that is known.
  struct Kinematics {
    double error;
    bool left;
  };
  std::optional<Kinematics> kinematics;
};

// Starts the device at the rate (Hz), then reads it for so many seconds, at its own frames where it has such, and commands
// zero after each reading. The device must be new. `stop` ends it early.
Observed observe_without_force(Device& device, double rate, double seconds, const std::atomic<bool>& stop);

}  // namespace forceshade::device
