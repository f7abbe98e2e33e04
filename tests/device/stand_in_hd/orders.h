// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The orders to the stand-in for the vendor's library. Plain data: it lies in memory that processes share.

#include <sys/types.h>

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "device/phantom/hdapi_abi.h"

namespace forceshade::stand_in_hd {

namespace hdapi = device::hdapi;

struct Vector {
  Vector() = default;
  Vector(const Eigen::Vector3d& v) : x(v.x()), y(v.y()), z(v.z()) {}  // implicit: it is one
  operator Eigen::Vector3d() const { return {x, y, z}; }

  double x = 0, y = 0, z = 0;
};

// The answer to a get: the right one, one value in each of its places, an error, or nothing written and no error.
struct Answer {
  enum class How { right, value, error, nothing };

  Answer() = default;
  Answer(double given) : how(How::value), value(given) {}  // implicit: a number is itself
  static Answer fails(hdapi::HDerror code) {
    Answer answer;
    answer.how = How::error;
    answer.error = code;
    return answer;
  }
  static Answer nothing() {
    Answer answer;
    answer.how = How::nothing;
    return answer;
  }
  double value_or(double right) const { return how == How::value ? value : right; }

  How how = How::right;
  double value = 0;
  hdapi::HDerror error = 0;
};

// The moment of an event that happens once. All but the first of these are ends of frames, when the force has been sent.
enum class Moment {
  never,
  before_start,  // in hdInitDevice, with the device initialised
  settling,      // the tenth frame after the start
  frame,         // this frame after the start, from 1
  free,          // with a force of zero, this frame after the output went on or a later one, before any contact
  contact        // 20 frames in a row sent more than 0.2 N
};

inline constexpr double kContact = 0.2;  // N
inline constexpr int kContactFrames = 20;

struct Kill {
  static constexpr pid_t kDriver = 0, kParent = -1;  // the process that has the driver, and its parent

  pid_t pid = kDriver;
  int signal = 0;
  Moment when = Moment::never;
  std::uint64_t frame = 0;
};

struct Crash {
  enum class How { segmentation_fault, abort, exit, exception, hang };

  How how = How::segmentation_fault;
  Moment when = Moment::never;
  std::uint64_t frame = 0;
};

// Calls that never return: hdEndFrame once the force is sent, the others at once.
enum class Blocks { nothing, init_device, begin_frame, end_frame, start_scheduler, stop_scheduler, disable_device };

// By default what is on any day to be expected of the vendor's library, and nothing worse, but for an init error named in the
// environment's STAND_IN_HD_INIT. An error of a frame is put on the stack in one frame and not again until orders are given
// anew; only one that refuses a call (0x1..) comes with each call.
struct Orders {
  hdapi::HDerror init = 0, rate = 0, schedule = 0, start = 0;  // given by these calls
  hdapi::HDerror start_with_error = 0;                         // on the stack after hdStartScheduler, which runs all the same
  hdapi::HDerror begin = 0, get_position = 0, set = 0;         // in frames
  std::array<hdapi::HDerror, 3> end = {};                      // in frames, in this order
  bool errors_repeat = false;                                  // in every frame
  bool comm_lost = false;            // an error, once; then the last position for ever, and an update rate of 0
  bool init_fails_silently = false;  // no device and no error

  // The answer of hdCheckCalibration until hdUpdateCalibration. nullopt: as its styles have it, anew in each process.
  std::optional<hdapi::HDenum> calibration = hdapi::kCalibrated;
  int styles = hdapi::kCalibratesInInkwell;
  bool update_helps = true;                       // true if hdUpdateCalibration leads to kCalibrated
  bool in_reset_pose = true, in_inkwell = false;  // the arm, and its stylus
  std::uint64_t calibration_lost_at = 0;          // this frame after the start; 0: never
  std::optional<Vector> position = std::nullopt;  // mm, in the driver's frame, instead of the simulated one
  bool withholds_position = false;                // hdGet writes nothing and reports no error

  Answer peak_force = {}, continuous_force = {};                         // N: 8.5, 1.4
  Answer workspace = {}, velocity_limit = {}, impulse_limit = {};        // mm, mm/s: 1500, N/ms: 4
  Answer temperature = {}, encoders = {}, joint_angles = {};             // 0 to 1, counts, rad
  Answer update_rate = {}, instantaneous_rate = {}, input_degrees = {};  // Hz: 1000, Hz: as meant, 6
  int output_degrees = 3;                                                // 3 or 6: as many temperatures are written

  bool safety_switch = false;
  bool output_stays_off = false;
  bool output_goes_off = false;             // as by an emergency switch
  bool hung = false;                        // the scheduler runs no callback
  double frame_hz = 0;                      // of the frames; 0: the rate that was asked for
  std::chrono::milliseconds frame_time{0};  // more than a frame takes anyway
  bool steals_signals = true;               // hdStartScheduler puts a handler of SIGTERM over the program's: _exit(0)
  bool prints = true;                       // to standard output

  // Instead of the simulated hand: from 3 mm above z = 0 of the laws' frame to 2 mm below it, smoothly in 0.2 s, once the
  // output was on for 0.7 s, both counted in frames.
  bool press = false;

  Blocks blocks = Blocks::nothing;
  Crash crash = {};
  Kill kill = {};
};

static_assert(std::is_trivially_copyable_v<Orders>);

}  // namespace forceshade::stand_in_hd
