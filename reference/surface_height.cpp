// SPDX-License-Identifier: BSD-3-Clause
#include "reference/surface_height.h"

#include <mutex>

#include "reference/heights/sum.h"
#include "reference/numbers/interval_ends.h"
#include "reference/position.h"
#include "rendering/control_words.h"

namespace forceshade::reference {

float surface_height(const HeightMap& map, float x, float y) {
  const ExactArithmetic with_all_bits;
  const Point2 at{quantised(x), quantised(y)};
  const std::lock_guard lock(exact_arithmetic);
  mpfr_set_emin(mpfr_get_emin_min());  // the tail of a Gaussian goes down to exp(-4·10^14)
  for (unsigned bits = 128;; bits *= 2) {
    set_precision(bits);
    const RoundedEnds ends(sum_jet<Enclosure>(map.parts, at).U);
    if (ends.agree()) return ends.low;
    // From here on only a tie is left.
    if (bits < 768 || !ends.are_neighbours()) continue;
    return ends.decided([&](double tie) { return (sum_jet<ExponentialSum>(map.parts, at).U - tie).sign(); });
  }
}

}  // namespace forceshade::reference
