// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers that look random, by their place in a sequence.

#include <cstdint>

namespace forceshade::properties {

// The n-th number of a sequence: SplitMix64 (Steele, Lea and Flood 2014). Two places of one sequence have two numbers.
constexpr std::uint64_t split_mix(std::uint64_t sequence, std::uint64_t n) {
  std::uint64_t z = sequence + (n + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

}  // namespace forceshade::properties
