// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the multiples of a number that fall, modulo one, into a given interval, in as many steps as Euclid's algorithm takes,
// not by trying them. (Among the first N multiples of any number only three distances between neighbours occur, and
// Euclid's algorithm names them: Sós 1958, the three-distance theorem.)

#include <cstdint>

namespace forceshade::tests {

// Numbers modulo one, in units of 2^-62.
inline constexpr std::uint64_t kOne = std::uint64_t{1} << 62;

inline constexpr std::uint64_t kNever = ~std::uint64_t{0};

// The least m >= 0 with low <= step·m mod modulus <= high; kNever if there is none. step < modulus <= 2^62, low <= high.
inline std::uint64_t first_in_range(std::uint64_t step, std::uint64_t modulus, std::uint64_t low, std::uint64_t high) {
  __extension__ using Product = unsigned __int128;
  if (low == 0) return 0;
  if (step == 0) return kNever;
  if (step > modulus / 2) return first_in_range(modulus - step, modulus, modulus - high, modulus - low);
  const std::uint64_t m = (low + step - 1) / step;
  if (m * step <= high) return m;
  // No multiple of the step lies in the range itself, so one must in the range moved up by a multiple of the modulus.
  const std::uint64_t rest = modulus % step;
  const std::uint64_t turns = first_in_range(rest == 0 ? 0 : step - rest, step, low % step, high % step);
  if (turns == kNever) return kNever;
  return static_cast<std::uint64_t>((Product{turns} * modulus + low + step - 1) / step);
}

// The least m >= from with step·m mod one in [low, low + width]; kNever if there is none. All below kOne.
inline std::uint64_t next_in_range(std::uint64_t from, std::uint64_t step, std::uint64_t low, std::uint64_t width) {
  const std::uint64_t start = (low - step * from) % kOne;  // kOne divides 2^64: wrapping does no harm
  if (start + width >= kOne) return from;
  const std::uint64_t m = first_in_range(step, kOne, start, start + width);
  return m == kNever ? kNever : from + m;
}

}  // namespace forceshade::tests
