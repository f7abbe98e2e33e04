// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A batch that several threads share: each has a part of its positions, one after the other.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

#include "bindings/c/strided.h"
#include "forceshade.h"

namespace forceshade::c {

// The end of the struct in programs that were built before a batch had threads.
inline constexpr std::size_t kWithoutThreads = offsetof(forceshade_batch, threads);

// The most threads of a batch, and the fewest positions for which one is started: it takes some 20 us to start.
inline constexpr std::size_t kMostThreads = 256, kLeastOfThread = 1024;

// The number of parts in which a batch is done; at least one.
inline std::size_t parts_of(const forceshade_batch& batch) noexcept {
  if (batch.size == kWithoutThreads) return 1;
  return std::clamp<std::size_t>(batch.count / kLeastOfThread, 1, std::clamp<std::size_t>(batch.threads, 1, kMostThreads));
}

// So many positions of a batch from this one on.
inline forceshade_batch part_of(const forceshade_batch& batch, std::size_t begin, std::size_t count) noexcept {
  return {.size = kWithoutThreads,
          .count = count,
          .positions = at(batch.positions, begin, batch.position_stride),
          .position_stride = batch.position_stride,
          .position_component = batch.position_component,
          .forces = at(batch.forces, begin, batch.force_stride),
          .force_stride = batch.force_stride,
          .force_component = batch.force_component,
          .statuses = batch.statuses == nullptr ? nullptr : at(batch.statuses, begin, batch.status_stride),
          .status_stride = batch.status_stride,
          .threads = 1};
}

// The sum of work(part, begin), which must not throw, over parts that are together the batch; begin: the index of the part's
// first position. All of them but one have a thread of their own. Where the system starts no further thread, this one does what
// is left. With one part, nothing is allocated.
template <class Work>
std::size_t in_parts(const forceshade_batch& batch, const Work& work) noexcept {
  const std::size_t parts = parts_of(batch), each = batch.count / parts, rest = batch.count % parts;
  std::atomic<std::size_t> sum = 0;
  const auto do_part = [&](std::size_t i) noexcept {
    const std::size_t begin = i * each + std::min(i, rest);
    sum += work(part_of(batch, begin, each + (i < rest ? 1 : 0)), begin);
  };
  std::vector<std::thread> others;
  std::size_t started = 1;
  try {
    for (; started < parts; ++started) others.emplace_back(do_part, started);
  } catch (const std::exception&) {
  }
  do_part(0);
  for (std::size_t i = started; i < parts; ++i) do_part(i);
  for (std::thread& other : others) other.join();
  return sum;
}

}  // namespace forceshade::c
