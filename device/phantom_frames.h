// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is done with a PHANToM in its driver's thread: one frame a tick, the only place where the driver is asked or told
// anything while its scheduler runs. Through the two mailboxes the servo loop gets samples and gives orders.

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "forceshade/device/hdapi_library.h"
#include "forceshade/device/hdapi_words.h"
#include "forceshade/device/latest.h"

namespace forceshade::device {

class PhantomFrames {
 public:
  using Clock = std::chrono::steady_clock;

  // The driver's frame and units: x right, y up, z to the user; mm, N, rad.
  enum class Phase { settling, ready, closed };  // closed: zero was sent last and the output is off, for good
  struct Sample {
    Phase phase = Phase::settling;
    hdapi::Trouble trouble;  // the first; from then on the force is zero and the output off
    Clock::time_point time{};
    Eigen::Vector3d position{0, 0, 0}, gimbal{0, 0, 0};
    int buttons = 0;
    std::optional<std::array<std::int64_t, 3>> encoder = std::nullopt;
    bool calibrated = false, forces_on = false;
    double temperature = 0;
  };
  struct Order {
    Eigen::Vector3d force{0, 0, 0};
    Clock::time_point time{};
    bool close = false;  // send zero, switch the output off, and keep it off
  };

  // A force older than `patience` is not obeyed any more: its giver has stalled.
  PhantomFrames(const hdapi::Functions& hd, hdapi::HHD device, bool gimbal, Clock::duration patience) noexcept
      : hd_(hd), device_(device), has_gimbal_(gimbal), patience_(patience) {}

  // To be scheduled with `self`. Forces are switched on once kSettling frames in a row were good.
  static unsigned tick(void* self) noexcept;
  static constexpr int kSettling = 50;

  Latest<Sample> samples;
  Latest<Order> orders;

 private:
  void frame(const Order& order) noexcept;
  void measure() noexcept;
  void check_calibration() noexcept;
  void switch_on() noexcept;
  bool went_well(const char* step) noexcept;
  bool went_well(const char* step, const hdapi::HDErrorInfo& error) noexcept;
  bool known_and_well(const char* step, bool& known) noexcept;
  void note(const char* words) noexcept;

  const hdapi::Functions& hd_;
  hdapi::HHD device_;
  bool has_gimbal_, has_temperature_ = true, has_encoders_ = true, updated_calibration_ = false;
  Clock::duration patience_;
  Sample sample_;
  int good_frames_ = 0, at_uncalibrated_pose_ = 0;
};

}  // namespace forceshade::device
