// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The longest way of a hand between two readings.

namespace forceshade::device {

// The longest step, in mm, between two readings `seconds` apart. Each reading may be off by resolution/2 an axis, which makes
// a step at most √3 times the resolution too long.
constexpr double longest_step(double speed, double seconds, double resolution) noexcept {
  return speed * seconds + 2 * resolution;
}

}  // namespace forceshade::device
