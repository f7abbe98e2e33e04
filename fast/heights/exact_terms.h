// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A part as the exact stage sees it: the terms of its height and slopes, which each kind's add_terms() gives in the kind's
// own header, and the room that their numbers take, which its denominator_bits() bounds.

#include <bit>
#include <cstddef>
#include <cstdint>

#include "fast/heights/jet.h"
#include "fast/numbers/fraction.h"

namespace forceshade::fast {

class ExactPlace;

// Collects the terms of one part.
class ExactTerms {
 public:
  // The numbers of a part that are used, and their factor: the gap, the slopes, or both.
  struct Use {
    bool gap, slopes;
    double factor;  // 1 or -1
  };
  ExactTerms(ExactPlace& place, const Use& use) noexcept : place_(place), use_(use) {}

  void add_rational(const Jet<Fraction>& jet) noexcept;
  // Factors of √radicand, the slopes' times the radicand: their division by it is left to the exact stage.
  void add_root(const Fraction& radicand, const Jet<Fraction>& factors) noexcept;
  // Factors of e^(-q).
  void add_decay(const Fraction& q, const Jet<Fraction>& factors) noexcept;
  // Factors of the angle's cosine, in the height, and of its sine, in the slopes; the angle is positive.
  void add_wave(const Fraction& angle, const Jet<Fraction>& factors) noexcept;

 private:
  ExactPlace& place_;
  Use use_;
};

// Bits of the denominators that a part brings into the sum's height and into its slopes, powers of two left out, where
// denominators multiply and nothing is reduced.
struct DenominatorBits {
  std::size_t height = 0, slopes = 0;
  bool has_roots = false;
};

inline std::size_t odd_bits(float value) noexcept {
  const std::uint32_t significand = (std::bit_cast<std::uint32_t>(value) & 0x7FFFFF) | 0x800000;
  return 24 - static_cast<std::size_t>(std::countr_zero(significand));
}

}  // namespace forceshade::fast
