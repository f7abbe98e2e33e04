// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The limits of a PHANToM, from what its driver says of it. A driver that says nothing or nonsense never makes a limit wider.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <variant>

namespace forceshade::device {

// The limits as the driver gave them; none where it gave an error. What it did not write is NaN.
struct DriversLimits {
  std::optional<double> peak, continuous;                         // N
  std::optional<double> speed;                                    // mm/s
  std::optional<double> impulse;                                  // N/ms
  std::optional<std::array<double, 6>> workspace = std::nullopt;  // mm, in the driver's frame: lowest x, y, z, highest x, y, z
};

struct PhantomLimits {
  double peak, continuous;    // N
  double speed, slew;         // mm/s, N/s; infinite where the driver names none, and the supervisor's own hold
  Eigen::Vector3f low, high;  // mm, in the laws' frame
  std::string words;          // about each that the driver did not give; empty if it gave all
};

// Peak, speed and slew are a twentieth below what the driver ends a run for. Where it gives no usable continuous force or
// workspace, the smallest of all PHANToMs' data sheets stands in, the Omni's. A string: why such a device cannot be driven,
// since without a peak nothing could be clamped.
std::variant<PhantomLimits, std::string> phantom_limits(const DriversLimits& driver);

}  // namespace forceshade::device
