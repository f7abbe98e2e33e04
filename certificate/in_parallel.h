// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Chunks of a comparison, shared out among threads.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "certificate/tally.h"

namespace forceshade::properties {

// work(chunk, tally) for each chunk below `chunks`, by so many threads, this one included; progress(done in [0, 1]) from one of
// them at a time. The tally does not depend on the number of threads. Rethrows what a thread threw.
inline Tally in_parallel(std::uint64_t chunks, unsigned threads, const std::function<void(double)>& progress,
                         const std::atomic<bool>& stop, const std::function<void(std::uint64_t, Tally&)>& work) {
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  Tally total;
  std::uint64_t finished = 0;
  std::exception_ptr thrown;
  const auto share = [&] {
    Tally mine;
    try {
      for (std::uint64_t chunk = next++; chunk < chunks && !stop; chunk = next++) {
        work(chunk, mine);
        const std::lock_guard lock(mutex);
        progress(static_cast<double>(++finished) / static_cast<double>(chunks));
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      thrown = std::current_exception();
      next = chunks;
    }
    const std::lock_guard lock(mutex);
    total.add(mine);
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < std::min<std::uint64_t>(threads, chunks); ++i) helpers.emplace_back(share);
  share();
  helpers.clear();
  if (thrown) std::rethrow_exception(thrown);
  return total;
}

}  // namespace forceshade::properties
