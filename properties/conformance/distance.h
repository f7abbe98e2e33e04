// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The distance of an answer from the exact force.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "forceshade/reference.h"
#include "properties/conformance/tolerance.h"

namespace forceshade::conformance {

// Larger than any distance: of an answer that is infinite or not a number.
inline constexpr std::uint64_t kNoNumber = std::numeric_limits<std::uint64_t>::max();

// The number of binary32 numbers from one to the other, counting one of both; -0 and +0 are one number. Both are finite.
std::uint64_t ulps_between(float a, float b);

// A number that lies in [low, high].
struct Bounds {
  double low = 0, high = 0;
};

struct Distance {
  std::uint64_t ulps = 0;  // the most of the three components, from the correctly rounded force; kNoNumber
  Bounds newtons;          // the length of answer - exact; infinite where ulps is kNoNumber
  Bounds exact_newtons;    // the length of the exact force
};

// rounded: what the exact force is, rounded once.
Distance distance(const Eigen::Vector3f& answer, const reference::Rounded& rounded);

// The exact force in so many significant decimal digits, each component correctly rounded; nothing where the definition has
// none.
using Digits = std::function<std::optional<std::array<std::string, 3>>(unsigned digits)>;

// True if an answer is within the tolerance. If the bounds of the distance do not decide, digits of the exact force do, up to
// 1000 of them; a distance that agrees with the tolerance to all of these counts as within it. Without digits, the correctly
// rounded force stands for the exact one.
bool is_within(const Tolerance& tolerance, const Eigen::Vector3f& answer, const reference::Rounded& rounded,
               const Digits& digits);

}  // namespace forceshade::conformance
