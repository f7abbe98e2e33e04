// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two and four numbers side by side, in any arithmetic: what a bicubic patch is evaluated with.
//
// Binary64 goes in the vector registers of every x86-64 and AArch64; each lane is IEEE arithmetic all the same.

#include <array>

#include "forceshade/fast/inline.h"

namespace forceshade::fast {

using Pair64 = double __attribute__((vector_size(16)));

template <class T>
struct Row {
  std::array<T, 4> lanes;

  static Row of(const float* from) noexcept {
    return {{exactly(from[0]), exactly(from[1]), exactly(from[2]), exactly(from[3])}};
  }

  friend Row operator+(const Row& a, const Row& b) noexcept {
    return map(a, b, [](const T& x, const T& y) { return x + y; });
  }
  friend Row operator-(const Row& a, const Row& b) noexcept {
    return map(a, b, [](const T& x, const T& y) { return x - y; });
  }
  friend Row operator*(const Row& a, const Row& b) noexcept {
    return map(a, b, [](const T& x, const T& y) { return x * y; });
  }
  friend Row operator*(const T& a, const Row& b) noexcept { return Row{{a, a, a, a}} * b; }
  // Each lane takes the next one's number, the last keeps its own.
  Row shifted() const noexcept { return {{lanes[1], lanes[2], lanes[3], lanes[3]}}; }
  T sum() const noexcept { return (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]); }

 private:
  static T exactly(float value) noexcept { return T::exactly(static_cast<double>(value)); }
  template <class F>
  static Row map(const Row& a, const Row& b, const F& f) noexcept {
    return {{f(a.lanes[0], b.lanes[0]), f(a.lanes[1], b.lanes[1]), f(a.lanes[2], b.lanes[2]), f(a.lanes[3], b.lanes[3])}};
  }
};

template <>
struct Row<double> {
  Pair64 low, high;

  FORCESHADE_INLINE static Row of(const float* from) noexcept {
    const auto lane = [&](std::size_t i) { return static_cast<double>(from[i]); };
    return {Pair64{lane(0), lane(1)}, Pair64{lane(2), lane(3)}};
  }

  FORCESHADE_INLINE friend Row operator+(const Row& a, const Row& b) noexcept { return {a.low + b.low, a.high + b.high}; }
  FORCESHADE_INLINE friend Row operator-(const Row& a, const Row& b) noexcept { return {a.low - b.low, a.high - b.high}; }
  FORCESHADE_INLINE friend Row operator-(const Row& a, double b) noexcept { return {a.low - b, a.high - b}; }
  FORCESHADE_INLINE friend Row operator*(const Row& a, const Row& b) noexcept { return {a.low * b.low, a.high * b.high}; }
  FORCESHADE_INLINE friend Row operator*(double a, const Row& b) noexcept { return {a * b.low, a * b.high}; }
  FORCESHADE_INLINE Row shifted() const noexcept { return {Pair64{low[1], high[0]}, Pair64{high[1], high[1]}}; }
  FORCESHADE_INLINE double sum() const noexcept {
    const Pair64 pairs = low + high;
    return pairs[0] + pairs[1];
  }
};

}  // namespace forceshade::fast
