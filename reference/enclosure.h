// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A number between two multiprecision ends.

#include <array>
#include <stdexcept>
#include <string>

#include "reference/numbers/multiprecision.h"

namespace forceshade::reference {

// low <= exact <= high, both finite.
struct Interval {
  Multiprecision low, high;
};

// Thrown where a number cannot be enclosed between two finite ones: there is no verdict then.
struct NotEnclosed : std::domain_error {
  explicit NotEnclosed(const std::string& why) : std::domain_error("not enclosed: " + why) {}
};

// Throws NotEnclosed unless both ends are finite and in order.
Interval interval(const Multiprecision& low, const Multiprecision& high);
Interval interval(const Enclosure& value);

// The binary64 interval around it, [low, high].
inline std::array<double, 2> binary64(const Interval& interval) {
  return {mpfr_get_d(interval.low.backend().data(), MPFR_RNDD) + 0.0,
          mpfr_get_d(interval.high.backend().data(), MPFR_RNDU) + 0.0};
}

}  // namespace forceshade::reference
