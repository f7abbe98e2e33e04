// SPDX-License-Identifier: BSD-3-Clause
#include "reference/enclosure.h"

namespace forceshade::reference {

Interval interval(const Multiprecision& low, const Multiprecision& high) {
  if (mpfr_number_p(low.backend().data()) == 0 || mpfr_number_p(high.backend().data()) == 0 || !(low <= high))
    throw NotEnclosed("an interval from " + low.str(6) + " to " + high.str(6) + "; expected two finite ends in order");
  return {low, high};
}

Interval interval(const Enclosure& value) {
  return interval(lower(value), upper(value));
}

}  // namespace forceshade::reference
