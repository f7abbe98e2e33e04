// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/timing.h"

#include <cstdlib>
#include <new>

namespace forceshade::bench {

std::atomic<std::size_t> allocations{0};

Scale scale() {
  const auto start = Clock::now();
  const std::uint64_t first = now();
  while (seconds_since(start) < 0.05) continue;
  const double per_count = 1e6 * seconds_since(start) / static_cast<double>(now() - first);
  std::vector<std::uint64_t> idle(2001);
  for (std::uint64_t& one : idle) {
    const std::uint64_t before = now();
    one = now() - before;
  }
  std::ranges::nth_element(idle, idle.begin() + 1000);
  return {per_count, static_cast<double>(idle[1000])};
}

}  // namespace forceshade::bench

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++forceshade::bench::allocations;
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++forceshade::bench::allocations;
  const auto to = static_cast<std::size_t>(alignment);
  if (void* place = std::aligned_alloc(to, (size + to - 1) / to * to)) return place;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* place) noexcept {
  std::free(place);
}
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept {
  std::free(place);
}
[[gnu::noinline]] void operator delete(void* place, std::align_val_t) noexcept {
  std::free(place);
}
[[gnu::noinline]] void operator delete(void* place, std::size_t, std::align_val_t) noexcept {
  std::free(place);
}
