// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/sweep_unit.h"

#include <algorithm>
#include <functional>

#include "certificate/sweep_checker.h"

namespace forceshade::properties {

Tally check_unit(const Sweep& sweep, const fast::Law& law, const reference::Law& reference, std::uint32_t unit) {
  return SweepChecker(sweep, law, reference).check(unit);
}

Tally check_unit(const Sweep& sweep, std::uint32_t unit) {
  return check_unit(sweep, std::get<fast::Law>(fast::Law::build(sweep.law, sweep.parameters)),
                    std::get<reference::Law>(reference::Law::build(sweep.law, sweep.parameters)), unit);
}

void add(Sweeps& sweeps, std::size_t sweep, const Tally& tally) {
  SweepResult& result = sweeps.results[sweep];
  result.inputs += tally.points;
  result.mismatches += tally.mismatches;
  std::transform(tally.stages.begin(), tally.stages.end(), sweeps.stages.begin(), sweeps.stages.begin(), std::plus<>());
  for (const auto& [unit, words] : tally.counterexamples)
    if (sweeps.counterexamples.size() < kCounterexamples) sweeps.counterexamples.push_back(words);
}

}  // namespace forceshade::properties
