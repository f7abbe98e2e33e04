// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the two ends of an interval of MPFI give in fewer bits. N: such an interval, an Enclosure or one of a fixed precision.

#include <boost/multiprecision/mpfi.hpp>

#include "reference/numbers/ball64.h"

namespace forceshade::reference {

// Encloses the interval: the ends are rounded outwards, and where they are neighbours then, the middle is one of them.
template <class N>
Ball64 to_64_bits(const N& interval) {
  const long double low = mpfr_get_ld(&interval.backend().data()->left, MPFR_RNDD);
  const long double high = mpfr_get_ld(&interval.backend().data()->right, MPFR_RNDU);
  return {low + (high - low) / 2, high - low};
}

}  // namespace forceshade::reference
