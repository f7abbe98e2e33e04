// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "certificate/sweep_unit.h"
#include "forceshade/certify.h"
#include "rendering/control_words.h"

namespace forceshade::properties {

Sweeps continued(Sweeps sweeps, std::uint64_t count, unsigned threads) {
  const ExactArithmetic with_all_bits;
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t end = std::min(sweeps.end, sweeps.next + count);
  std::vector<Tally> tallies(end - sweeps.next);
  std::atomic<std::uint64_t> next = sweeps.next;
  const auto work = [&] {
    for (std::uint64_t unit = next++; unit < end; unit = next++) {
      const Sweep& sweep = sweeps.results[unit / kUnitsPerSweep].sweep;
      tallies[unit - sweeps.next] = check_unit(sweep, static_cast<std::uint32_t>(unit % kUnitsPerSweep));
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  for (std::uint64_t unit = sweeps.next; unit < end; ++unit) add(sweeps, unit / kUnitsPerSweep, tallies[unit - sweeps.next]);
  sweeps.next = end;
  sweeps.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sweeps;
}

}  // namespace forceshade::properties
