// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Order and choice among enclosures, where "surely" means for every pair of numbers the two may stand for.

#include "reference/numbers/multiprecision.h"

namespace forceshade::reference {

inline bool surely_less(const Enclosure& a, const Enclosure& b) {
  return upper(a) < lower(b);
}

inline bool surely_at_most(const Enclosure& a, const Enclosure& b) {
  return upper(a) <= lower(b);
}

inline Enclosure larger(const Enclosure& a, const Enclosure& b) {
  const Multiprecision low[]{lower(a), lower(b)}, high[]{upper(a), upper(b)};
  return {low[0] < low[1] ? low[1] : low[0], high[0] < high[1] ? high[1] : high[0]};
}

inline Enclosure smaller(const Enclosure& a, const Enclosure& b) {
  return -larger(-a, -b);
}

}  // namespace forceshade::reference
