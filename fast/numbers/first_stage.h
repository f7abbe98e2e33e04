// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of the binary64 stage of every law: exact products, split constants and the rounding test.
//
// A law's first stage is a template over Real: double, and in tests numbers that write down what is done with them or track its
// error. A Real offers Real(double), + - * /, comparisons that give a MaskOf<Real> with & | !, and absolute, square_root,
// larger, select, multiply_add, multiply_subtract and never as declared here (square_root: fast/numbers/double_double.h) for
// double. A batch computes the same forces in forms of its own (fast/simd/form.inl).

#include <cstdint>

#include "fast/numbers/double_double.h"
#include "fast/numbers/inline.h"

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
// components and `contact` is exact, unless `doubt` is set; then only a later stage can decide.
template <class Real>
struct FirstStage {
  Real x, z;  // N; +0 or -0 where contact does not hold
  MaskOf<Real> contact;
  MaskOf<Real> doubt;
};

FORCESHADE_INLINE double absolute(double a) {
  return __builtin_fabs(a);
}
FORCESHADE_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}
FORCESHADE_INLINE double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}

// a·b + c and c - a·b, for products that are exact in binary64: then fused or not, the result is the same.
FORCESHADE_INLINE double multiply_add(double a, double b, double c) {
  return a * b + c;
}
FORCESHADE_INLINE double multiply_subtract(double a, double b, double c) {
  return c - a * b;
}

template <class Real>
FORCESHADE_INLINE MaskOf<Real> never() {
  return MaskOf<Real>{};
}

// The bits of a binary64 that rounding to binary32 drops; one half of the last place kept is (kDroppedMask + 1)/2.
inline constexpr int kDroppedMask = (1 << 29) - 1;

// The window of the dropped bits in which a relative error of kErrorBound could matter, in units of the last place on either
// side of one half.
constexpr int doubt_window(double error_bound) {
  return static_cast<int>(error_bound * 0x1p53) + (error_bound > 0 ? 1 : 0);
}

// True if the true number is fewer than kWindow units of the last place away from the computed one: a relative error e of the
// true number is at most e(1 + 2e) of the computed one, which is less than 2^53 units.
constexpr bool window_covers(int window, double error_bound) {
  return 0x1p53 * error_bound * (1 + 2 * error_bound) <= window;
}

// Added to the dropped bits, moves the window to the top of their range: in doubt are those from kTieThreshold on.
template <int kWindow>
inline constexpr int kTieOffset = kDroppedMask / 2 - kWindow;
template <int kWindow>
inline constexpr int kTieThreshold = kDroppedMask - 2 * kWindow;

// True if some number within kErrorBound (relative) of `value` rounds to another binary32 than `value`, or is a tie.
template <int kWindow>
FORCESHADE_INLINE bool rounding_is_in_doubt(double value) {
  if constexpr (kWindow == 0) return false;
  const std::uint64_t moved = __builtin_bit_cast(std::uint64_t, value) + kTieOffset<kWindow>;
  return (moved & kDroppedMask) >= kTieThreshold<kWindow>;
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

}  // namespace forceshade::fast
