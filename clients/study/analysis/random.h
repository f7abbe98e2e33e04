// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random numbers that are the same on every machine: the C++ standard defines the output of std::mt19937_64, but not that of
// its distributions, so none of them is used.

#include <cstdint>
#include <random>
#include <string_view>

namespace forceshade::analysis {

// FNV-1a, 64 bits.
constexpr std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

class Random {
 public:
  // Each purpose has a stream of its own, so that one more participant changes no other's intervals.
  Random(std::uint64_t seed, std::string_view purpose) : engine_(seed ^ hash_of(purpose)) {}

  // Each of 0 to count - 1 with the same probability; count > 0. What would favour small numbers is drawn again.
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t unfair = (0 - count) % count;  // 2^64 mod count
    std::uint64_t bits = engine_();
    while (bits < unfair) bits = engine_();
    return bits % count;
  }

  // A multiple of 2^-53 plus 2^-54: neither 0 nor 1.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53 + 0x1p-54; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace forceshade::analysis
