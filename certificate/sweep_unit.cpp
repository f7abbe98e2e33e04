// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/sweep_unit.h"

#include "certificate/sweep_checker.h"

namespace forceshade::properties {

UnitTally check_unit(const Sweep& sweep, const fast::Law& law, const reference::Law& reference, std::uint32_t unit) {
  return SweepChecker(sweep, law, reference).check(unit);
}

}  // namespace forceshade::properties
