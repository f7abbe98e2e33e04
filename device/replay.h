// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recorded hand as a device: it goes its way whatever force it is given.

#include <string>
#include <vector>

#include "device/device.h"

namespace forceshade::device {

// Plays at the pace of its own time stamps, whatever the rate: the k-th reading is where the hand was k periods after the first
// time stamp. At a time stamp, within kSameTime, that is the recorded position to the bit; between two of them it is on the
// straight line from one to the other, in proportion to the time, and buttons, gimbal and encoder are those of the earlier.
// Nothing is read beyond the last time stamp. A recording of a higher rate than the loop's loses the positions between ticks.
class Replay final : public Device {
 public:
  static constexpr double kSameTime = 1e-9;  // s: more than rounding moves a multiple of a period, less than any hand does

  // Times are finite and increase from each reading to the next; throws std::invalid_argument where they do not, or when there
  // is no reading.
  explicit Replay(std::vector<Reading> recording);

  // Reads a CSV with columns t_s, x_mm, y_mm and z_mm. Positions are taken as they are, NaN too: to judge them is the law's
  // business. Throws files::Error with the line of a time that is not finite or does not increase, also when there is no row.
  static Replay load(const std::string& path);

  Capabilities capabilities() const noexcept override { return {.model = "replay", .moves_an_arm = false}; }
  std::optional<Fault> start(double rate) noexcept override;
  ReadResult read() noexcept override;
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    last_command_ = force;
    return std::nullopt;
  }
  // Not known until it is started.
  std::optional<std::size_t> readings_left() const noexcept override;

  const std::vector<Reading>& recording() const noexcept { return recording_; }
  const Eigen::Vector3f& last_command() const noexcept { return last_command_; }

 private:
  // s since the first time stamp
  double time_of(std::size_t recorded) const noexcept { return recording_[recorded].time - recording_.front().time; }

  std::vector<Reading> recording_;
  double period_ = 0;                    // s; 0 until started
  std::size_t readings_ = 0, read_ = 0;  // how many there are at this period, and have been
  std::size_t last_ = 0;                 // the last recorded one that is not after the time of the reading
  Eigen::Vector3f last_command_{0, 0, 0};
};

}  // namespace forceshade::device
