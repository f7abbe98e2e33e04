// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two ends of an interval of MPFI in fewer bits. N: such an interval, an Enclosure or one of a fixed precision.

#include <boost/multiprecision/mpfi.hpp>
#include <cmath>

#include "reference/numbers/ball64.h"
#include "reference/numbers/tie.h"

namespace forceshade::reference {

// Encloses the interval: the ends are rounded outwards, and where they are neighbours then, the middle is one of them.
template <class N>
Ball64 to_64_bits(const N& interval) {
  const long double low = mpfr_get_ld(&interval.backend().data()->left, MPFR_RNDD);
  const long double high = mpfr_get_ld(&interval.backend().data()->right, MPFR_RNDU);
  return {low + (high - low) / 2, high - low};
}

inline const Ball64& to_64_bits(const Ball64& number) {
  return number;
}

// The binary32 that the ends of an interval round to; a zero is +0.
struct RoundedEnds {
  float low, high;

  template <class N>
  explicit RoundedEnds(const N& interval)
      : low(mpfr_get_flt(&interval.backend().data()->left, MPFR_RNDN) + 0.0F),
        high(mpfr_get_flt(&interval.backend().data()->right, MPFR_RNDN) + 0.0F) {}
  bool agree() const { return low == high; }
  bool are_neighbours() const { return std::nextafter(low, high) == high; }
  // The binary32 nearest to the enclosed number, if the two are neighbours at most. sign_of_excess(tie): the sign of the
  // number less the tie between them.
  template <class SignOfExcess>
  float decided(const SignOfExcess& sign_of_excess) const {
    if (agree()) return low;
    return rounded_between(low, high, sign_of_excess(0.5 * (static_cast<double>(low) + static_cast<double>(high))));
  }
};

}  // namespace forceshade::reference
