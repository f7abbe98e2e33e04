// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recorded hand as a device: it goes its way whatever force it is given.

#include <string>
#include <vector>

#include "forceshade/device/device.h"

namespace forceshade::device {

// The k-th reading is the k-th recorded one, whatever the rate: no recorded point is missed, and the loop sets the pace.
class Replay final : public Device {
 public:
  explicit Replay(std::vector<Reading> recording) noexcept;

  // Reads a CSV with columns t_s, x_mm, y_mm and z_mm; t_s is finite and never decreases. Positions are taken as they are,
  // NaN too: to judge them is the law's business. Throws csv::Error, also when there is no row.
  static Replay load(const std::string& path);

  Capabilities capabilities() const noexcept override { return {.model = "replay"}; }
  std::optional<Fault> start(double) noexcept override { return std::nullopt; }
  ReadResult read() noexcept override;
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    last_command_ = force;
    return std::nullopt;
  }
  std::optional<std::size_t> readings_left() const noexcept override { return recording_.size() - next_; }

  const std::vector<Reading>& recording() const noexcept { return recording_; }
  const Eigen::Vector3f& last_command() const noexcept { return last_command_; }

 private:
  std::vector<Reading> recording_;
  std::size_t next_ = 0;
  Eigen::Vector3f last_command_{0, 0, 0};
};

}  // namespace forceshade::device
