// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The deviations from the truth that still count as right. A hand notices a change of a force by about 7 %, and of
// a place at the fingertip by about 1 mm; these are a seventh of the first and the second itself (docs/conformance.md).

namespace forceshade::conformance::simulators {

inline constexpr double kShare = 0.01;         // of the true force or speed
inline constexpr double kPath = 1e-3;          // m
inline constexpr double kLeastSpeed = 1;       // m/s: kShare is taken of this where the true speed is less
inline constexpr double kSettlingTime = 0.25;  // s, after which what a simulation began with no longer matters
inline constexpr double kClear = 1e-3;         // m above the ground: more is out of contact, whatever margin a simulator has

// (1 + kShare)² - 1: the share of its kinetic energy that a body has more if it is faster by kShare.
inline constexpr double kEnergyShare = 2 * kShare + kShare * kShare;

}  // namespace forceshade::conformance::simulators
