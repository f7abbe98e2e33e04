// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a force-feedback device is to the servo loop: it gives positions and takes forces. No law knows a device, no device a
// law.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <variant>

namespace forceshade::device {

struct Reading {
  Eigen::Vector3f position{0, 0, 0};  // mm
  double time = 0;                    // s, by the device's own clock
};

// Nothing is wrong and nothing more will come.
struct EndOfData {};

struct Fault {
  const char* words;  // for people; lives as long as the program
};

using ReadResult = std::variant<Reading, EndOfData, Fault>;

// Both calls are made from the servo loop: they allocate nothing, throw nothing and return well within a tick.
class Device {
 public:
  virtual ~Device() = default;

  virtual ReadResult read() noexcept = 0;

  // Holds this force, in N, until the next command. Zero must be obeyed even after a fault.
  virtual void command(const Eigen::Vector3f& force) noexcept = 0;

  // How many readings are still to come, from a device that knows.
  virtual std::optional<std::size_t> readings_left() const noexcept { return std::nullopt; }
};

}  // namespace forceshade::device
