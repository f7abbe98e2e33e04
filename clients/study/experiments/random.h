// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random numbers that are the same on every machine: std::shuffle and the distributions of <random> differ between libraries.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace forceshade::experiments {

// The output of splitmix64 (Steele, Lea and Flood 2014) for a state.
constexpr std::uint64_t mixed(std::uint64_t state) {
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebU;
  return state ^ (state >> 31U);
}

// splitmix64: 2^64 numbers before it repeats.
class Random {
 public:
  static constexpr std::uint64_t kIncrement = 0x9e3779b97f4a7c15U;

  // Each stream of a seed is another sequence.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mixed(seed + kIncrement) ^ (stream * 0xd1342543de82ef95U)) {}

  std::uint64_t next() { return mixed(state_ += kIncrement); }

  // 0 to count - 1, each as likely as the others: numbers in the last, incomplete multiple of count are drawn again.
  std::size_t below(std::size_t count) {
    const std::uint64_t most = UINT64_MAX - (UINT64_MAX % count + 1) % count;
    std::uint64_t drawn = next();
    while (drawn > most) drawn = next();
    return static_cast<std::size_t>(drawn % count);
  }

  // A number in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

  // Mean 0, standard deviation 1, never beyond 6: the sum of twelve uniform numbers, which needs no function of a library.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

  // Every order as likely as the others (Fisher and Yates).
  template <class T>
  void shuffle(std::span<T> all) {
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace forceshade::experiments
