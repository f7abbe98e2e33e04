// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A stand-in for the vendor's libHD.so: the same binary interface over the simulated PHANToM, with a scheduler thread of its
// own. It fails as told, and notes every breach of the discipline that the real one expects of its callers.

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/device/hdapi_abi.h"

namespace forceshade::stand_in_hd {

namespace hdapi = device::hdapi;

// What it does wrong; nothing by default, but for an init error named in the environment's STAND_IN_HD_INIT.
struct Orders {
  hdapi::HDerror init = 0, rate = 0, schedule = 0, start = 0, peak = 0;                        // given by these calls
  hdapi::HDerror begin = 0, get_position = 0, get_temperature = 0, get_encoders = 0, set = 0;  // in every frame
  std::array<hdapi::HDerror, 3> end = {};                                                      // in every frame, in this order
  bool init_fails_silently = false;                                                            // no device and no error
  int input_degrees = 6;
  hdapi::HDenum calibration = hdapi::kCalibrated;
  int styles = hdapi::kCalibratesInInkwell;
  bool update_helps = true;                                // whether hdUpdateCalibration leads to kCalibrated
  std::optional<Eigen::Vector3d> position = std::nullopt;  // mm, in the driver's frame, instead of the simulated one
  double peak_force = 8.5, temperature = 0.25;
  bool output_stays_off = false;
  bool output_goes_off = false;             // as by an emergency switch
  bool withholds_position = false;          // hdGet writes nothing and reports no error
  bool hung = false;                        // the scheduler runs no callback
  std::chrono::milliseconds frame_time{0};  // more than a frame takes anyway
};

// What it gave and got in a frame: mm, N, in the driver's frame.
struct Frame {
  Eigen::Vector3d position, force;
};

struct Seen {
  std::vector<std::string> breaches;
  std::optional<std::string> name;  // hdInitDevice's
  bool initialised = false, scheduler = false, output = false;
  int updates = 0;  // of the calibration
  double rate = 1000;
  std::vector<Frame> frames;
  std::chrono::steady_clock::time_point pushed_until{};  // when the arm was last let go, by zero sent or the output off
};

// As though freshly loaded. Not while its scheduler runs.
void reset();
void tell(const Orders& orders);
Seen seen();

}  // namespace forceshade::stand_in_hd
