// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "certificate/sweep_unit.h"
#include "forceshade/certify.h"

namespace forceshade::properties {

Sweeps continued(Sweeps sweeps, std::uint64_t count, unsigned threads) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t end = std::min(sweeps.end, sweeps.next + count);
  std::vector<UnitTally> tallies(end - sweeps.next);
  std::atomic<std::uint64_t> next = sweeps.next;
  const auto work = [&] {
    for (std::uint64_t unit = next++; unit < end; unit = next++) {
      const Sweep& sweep = sweeps.results[unit / kUnitsPerSweep].sweep;
      const auto law = std::get<fast::Law>(fast::Law::build(sweep.law, sweep.parameters));
      const auto reference = std::get<reference::Law>(reference::Law::build(sweep.law, sweep.parameters));
      tallies[unit - sweeps.next] = check_unit(sweep, law, reference, static_cast<std::uint32_t>(unit % kUnitsPerSweep));
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  for (std::uint64_t unit = sweeps.next; unit < end; ++unit) {
    const UnitTally& tally = tallies[unit - sweeps.next];
    SweepResult& result = sweeps.results[unit / kUnitsPerSweep];
    result.inputs += tally.inputs;
    result.mismatches += tally.mismatches;
    std::transform(tally.stages.begin(), tally.stages.end(), sweeps.stages.begin(), sweeps.stages.begin(), std::plus<>());
    for (const std::string& words : tally.counterexamples)
      if (sweeps.counterexamples.size() < kSweepCounterexamples) sweeps.counterexamples.push_back(words);
  }
  sweeps.next = end;
  sweeps.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sweeps;
}

}  // namespace forceshade::properties
