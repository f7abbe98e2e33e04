// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The distance of an answer from the exact force, and the largest one that counts as right.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "files/decimal.h"
#include "forceshade/reference.h"

namespace forceshade::conformance {

// ulp: how many binary32 numbers an answer may be away from the correctly rounded force, in each component. newton: how long
// the difference of the answer and the exact force may be. percent: how long that is to the exact force; where this is zero,
// the answer has to be zero.
enum class Unit { ulp, newton, percent };

struct Tolerance {
  Unit unit = Unit::ulp;
  files::Decimal value = {};  // as it was typed, exactly; 0 ulp is correctly rounded
};

// "4 ulp", "1e-6 N", "0.1 %", also without the space. A number of ulp is whole. Nothing for another text.
std::optional<Tolerance> tolerance_of(std::string_view text);

// "correctly rounded", "4 ulp", "1e-06 N".
std::string words_of(const Tolerance& tolerance);

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
