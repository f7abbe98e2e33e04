// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the binary64 stage of every law is made of: error-free sums, split constants and the rounding test.
//
// A law's first stage is a template over Real: double, or a pack of them in a batch (fast/pack_<set>.h). A Real offers
// Real(double), + - * /, comparisons that give a MaskOf<Real> with & | !, and absolute, square_root, select, never and
// rounding_is_in_doubt as declared here for double.

#include <cstdint>

#include "forceshade/fast/double_double.h"
#include "forceshade/fast/inline.h"

namespace forceshade::fast {

static_assert(__FLT_EVAL_METHOD__ == 0, "binary64 arithmetic must round to binary64");

template <class Real>
struct MaskTrait {
  using Type = typename Real::Mask;
};
template <>
struct MaskTrait<double> {
  using Type = bool;
};
template <class Real>
using MaskOf = typename MaskTrait<Real>::Type;

// A law's answer in binary64, before rounding. x and z are within the law's kErrorBound (relative) of the exact
// components and `contact` is exact, unless `doubt` is set; then only a later stage can tell.
template <class Real>
struct FirstStage {
  Real x, z;  // N; meaningful where contact holds
  MaskOf<Real> contact;
  MaskOf<Real> doubt;
};

FORCESHADE_INLINE double absolute(double a) {
  return __builtin_fabs(a);
}
FORCESHADE_INLINE double square_root(double a) {
  return __builtin_sqrt(a);
}
FORCESHADE_INLINE double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}

template <class Real>
FORCESHADE_INLINE MaskOf<Real> never() {
  return MaskOf<Real>{};
}

// The window of the 29 bits that rounding to binary32 drops in which a relative error of kErrorBound could matter: within
// kErrorBound·2^53 units of the last place of one half (a relative bound e never spans more than e·2^53 of them; one is
// added for the bits being whole). Shifted left by 35, as all of these are, one half is the most negative integer.
template <double kErrorBound>
inline constexpr std::int64_t kDoubtWindow = static_cast<std::int64_t>(kErrorBound * 0x1p53 + (kErrorBound > 0 ? 1 : 0)) << 35;

// Whether some number within kErrorBound (relative) of `value` rounds to another binary32 than `value`, or is a tie.
template <double kErrorBound>
FORCESHADE_INLINE bool rounding_is_in_doubt(double value) {
  if constexpr (kErrorBound == 0) return false;
  constexpr auto kWindow = static_cast<std::uint64_t>(kDoubtWindow<kErrorBound>);
  const std::uint64_t dropped = __builtin_bit_cast(std::uint64_t, value) << 35;
  return static_cast<std::int64_t>(dropped + kWindow) <= INT64_MIN + 2 * kDoubtWindow<kErrorBound>;
}

// A constant as head + tail, the head short enough (29 bits) that its product with a binary32 is exact in binary64.
struct Split {
  double head, tail;
};

inline Split split(const DoubleDouble& value) noexcept {
  // Veltkamp's splitting: 2^24 + 1 leaves 53 - 24 = 29 bits.
  const double c = 0x1.000001p24 * value.hi;
  const double head = c - (c - value.hi);
  return {head, (value.hi - head) + value.lo};
}

template <class Real>
struct Sum {
  Real value, error;
};

// value + error == a + b exactly (Knuth), without a branch.
template <class Real>
FORCESHADE_INLINE Sum<Real> exact_sum(Real a, Real b) {
  const Real s = a + b;
  const Real t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

}  // namespace forceshade::fast
