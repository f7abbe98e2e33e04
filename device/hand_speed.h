// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How fast a hand on a device moves, in mm/s: what distinguishes a hand from a device that runs away or an encoder that fails.

namespace forceshade::device {

// Under force. The hand feels for something, at some 100 mm/s; a stylus that slipped out of it and is thrown is faster.
inline constexpr double kFastestUnderForce = 1000;

// Anywhere: half a metre, the diagonal of the largest workspace, reached for in 0.2 s. A hand that reaches as smoothly as it
// can (Flash and Hogan 1985) is 15/8 times as fast in the middle as on average: 4.7 m/s.
inline constexpr double kFastest = 5000;

// The longest step, in mm, between two readings `seconds` apart. Each reading may be off by resolution/2 an axis, which makes
// a step at most √3 times the resolution too long.
constexpr double longest_step(double speed, double seconds, double resolution) noexcept {
  return speed * seconds + 2 * resolution;
}

}  // namespace forceshade::device
