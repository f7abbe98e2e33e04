// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Times of single ticks by the processor's own clock, what they allocate, and memory that no cache holds.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "fast/meshes/large_pages.h"

namespace forceshade::bench {

// The number of calls of operator new, which timing.cpp replaces.
extern std::atomic<std::size_t> allocations;

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

#if defined(__x86_64__)
inline std::uint64_t now() {
  unsigned processor = 0;
  const std::uint64_t count = __builtin_ia32_rdtscp(&processor);
  __builtin_ia32_lfence();
  return count;
}
#else
inline std::uint64_t now() {
  return static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
}
#endif

// The unit of now(), by the steady clock; and what reading it takes.
struct Scale {
  double microseconds_per_count, counts_to_read;
};
Scale scale();

inline constexpr int kPasses = 5;

struct Times {
  double median, most_of_1000, longest;  // µs; 999 of 1000 ticks are no longer than the second
  std::size_t allocations;
};

template <class Step>
double time_of(const Scale& scale, const Step& step) {
  const std::uint64_t before = now();
  step();
  return std::max(0.0, (static_cast<double>(now() - before) - scale.counts_to_read) * scale.microseconds_per_count);
}

inline Times summary(std::vector<double> times, std::size_t allocated) {
  std::ranges::sort(times);
  return {times[times.size() / 2], times[times.size() * 999 / 1000], times.back(), allocated};
}

// times: those of the path's ticks, in order.
template <class Step>
Times measure(const std::vector<std::array<float, 3>>& path, const Scale& scale, std::vector<double>& times, const Step& step) {
  times.clear();
  times.reserve(path.size());
  const std::size_t before = allocations;
  for (const auto& p : path) times.push_back(time_of(scale, [&] { step(p); }));
  const std::size_t allocated = allocations - before;
  return summary(times, allocated);
}
inline constexpr Times kNone{HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
inline Times least(const Times& a, const Times& b) {
  return {std::min(a.median, b.median), std::min(a.most_of_1000, b.most_of_1000), std::min(a.longest, b.longest),
          a.allocations + b.allocations};
}

template <class Value>
void keep(const Value& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

// Memory that no cache of this machine holds, in pages like those of a mesh.
class Memory {
 public:
  // A ring through all lines in random order, as many as the mesh has triangles, but 2^22 at least.
  explicit Memory(std::size_t triangles) : lines_(std::max(triangles, kLeastLines)) {
    std::vector<std::uint32_t> order(lines_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    for (std::size_t i = 0; i < order.size(); ++i) lines_[order[i]].next = order[(i + 1) % order.size()];
  }
  // µs that one load takes which depends on the one before: the least of five medians.
  double latency(const Scale& scale) {
    constexpr int kLoads = 500, kTries = 40;
    double least = HUGE_VAL;
    for (int pass = 0; pass < kPasses; ++pass) {
      std::vector<double> times;
      for (int i = 0; i < kTries; ++i)
        times.push_back(time_of(scale, [&] {
          for (int k = 0; k < kLoads; ++k) at_ = lines_[at_].next;
          keep(at_);
        }));
      std::ranges::sort(times);
      least = std::min(least, times[kTries / 2] / kLoads);
    }
    return least;
  }
  // Reads enough of it that nothing else is left in the caches.
  void flush_caches() {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < kFlush; ++i) sum += lines_[i].next;
    sum_ = sum;
  }

 private:
  struct alignas(64) Line {
    std::uint32_t next;
  };
  static constexpr std::size_t kLeastLines = std::size_t{1} << 22, kFlush = std::size_t{1} << 20;  // 256 MB, 64 MB
  std::vector<Line, fast::LargePages<Line>> lines_;
  std::uint32_t at_ = 0;
  volatile std::uint32_t sum_ = 0;
};

inline void print(const char* what, const Times& times) {
  std::printf("  %-28s p50 %6.3f  p99.9 %6.3f  longest %8.3f us, %zu allocations\n", what, times.median, times.most_of_1000,
              times.longest, times.allocations);
}

}  // namespace forceshade::bench
