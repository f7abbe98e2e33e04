// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A stand-in for the vendor's libHD.so in a process of its own: the same binary interface over an arm that goes where it is
// told, with a scheduler thread of its own. It crashes, hangs and ends as told. Its errors, answers, calibrations, calls that
// never return, and what its caller should not do are those of tests/world/hd.h, where time is a number.
//
// STAND_IN_HD is the library's path, for this process or another that it starts. Orders and what was seen lie in memory that
// the two share. It stays readable however the other process ends.

#include <sys/types.h>

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "device/phantom/hdapi_abi.h"

namespace forceshade::stand_in_hd {

namespace hdapi = device::hdapi;

using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC: one clock for all processes

struct Vector {
  Vector() = default;
  Vector(const Eigen::Vector3d& v) : x(v.x()), y(v.y()), z(v.z()) {}  // implicit: it is one
  operator Eigen::Vector3d() const { return {x, y, z}; }

  double x = 0, y = 0, z = 0;
};

// The moment of an event that happens once. All but the first of these are ends of frames, when the force has been sent.
enum class Moment {
  never,
  before_start,  // in hdInitDevice, with the device initialised
  frame,         // this frame after the start, or a later one
  contact        // 20 frames in a row sent more than 0.2 N
};

inline constexpr double kContact = 0.2;  // N
inline constexpr int kContactFrames = 20;

struct Crash {
  enum class How { segmentation_fault, abort, exit, exception, hang, signal_to_parent };

  How how = How::segmentation_fault;
  Moment when = Moment::never;
  std::uint64_t frame = 0;
  int signal = 0;
};

// Plain data: it lies in memory that processes share. By default nothing fails, but for an error named in the environment's
// STAND_IN_HD_INIT.
struct Orders {
  hdapi::HDerror init = 0, begin = 0;             // reported by hdInitDevice, and in each frame
  std::optional<Vector> position = std::nullopt;  // mm, in the driver's frame
  bool hung = false;                              // the scheduler runs no callback
  // From 3 mm above z = 0 of the laws' frame to 2 mm below it, smoothly in 0.2 s, once the output was on for 0.7 s, both
  // counted in frames.
  bool press = false;
  Crash crash = {};
};

static_assert(std::is_trivially_copyable_v<Orders>);

// The force on the arm now: the one last sent while the output was on, also when the process that sent it is no more.
struct Arm {
  Eigen::Vector3d force;           // N, in the driver's frame
  Clock::time_point pushed_until;  // the last moment at which it was not zero: now, where it is not
  pid_t pid = 0;                   // of the process that initialised the device last
};

struct Seen {
  bool initialised = false, scheduler = false, output = false;  // false if the driver's process is no more
  std::uint64_t frames = 0;                                     // that were ended
};

// As though freshly loaded. The first of these calls names the memory in the environment's STAND_IN_HD_MEMORY, for processes
// that are started from then on. An event that happens once may happen again after tell().
void reset();
void tell(const Orders& orders);
Seen seen();
// The moment of the crash or signal that was ordered; nothing before it.
std::optional<Clock::time_point> struck();
Arm arm();

}  // namespace forceshade::stand_in_hd
