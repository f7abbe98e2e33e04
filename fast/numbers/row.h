// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two and four numbers side by side: what a bicubic patch is evaluated with.

#include <array>
#include <cstdint>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "fast/numbers/inline.h"

namespace forceshade::fast {

// Two numbers in a vector register of any x86-64 or AArch64; each lane is IEEE arithmetic all the same.
using Pair64 = double __attribute__((vector_size(16)));
using PairOfBits = std::int64_t __attribute__((vector_size(16)));
using Four32 = float __attribute__((vector_size(16)));
using FourOfBits = std::int32_t __attribute__((vector_size(16)));

struct Pair32 {
  std::int32_t first, second;
};

// Towards zero: 0x80000000 for what does not fit. SSE2 where there is any: g++ makes several instructions of what is one.
FORCESHADE_INLINE Pair32 truncated(const Pair64& a) {
#if defined(__SSE2__)
  const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_cvttpd_epi32(a)));
  return {static_cast<std::int32_t>(both), static_cast<std::int32_t>(both >> 32)};
#else
  return {static_cast<std::int32_t>(a[0]), static_cast<std::int32_t>(a[1])};
#endif
}
FORCESHADE_INLINE Pair64 to_binary64(const float& first, const float& second) {
#if defined(__SSE2__)
  return _mm_cvtps_pd(_mm_unpacklo_ps(_mm_load_ss(&first), _mm_load_ss(&second)));
#else
  return Pair64{static_cast<double>(first), static_cast<double>(second)};
#endif
}

// A row of numbers in any arithmetic.
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

// Four binary64 for every machine: two pairs. With AVX2 a vector of four takes its place (fast/simd/row_avx2.h).
struct Quad {
  using Number = double;
  using Two = Pair64;

  Pair64 low, high;

  FORCESHADE_INLINE explicit Quad(double a) : low{a, a}, high{a, a} {}
  FORCESHADE_INLINE Quad(Pair64 first, Pair64 last) : low(first), high(last) {}
  FORCESHADE_INLINE static Quad load(const float* from) {
    const auto lane = [&](std::size_t i) { return static_cast<double>(from[i]); };
    return {Pair64{lane(0), lane(1)}, Pair64{lane(2), lane(3)}};
  }
  FORCESHADE_INLINE static Quad load(const double* from) { return {Pair64{from[0], from[1]}, Pair64{from[2], from[3]}}; }

  FORCESHADE_INLINE friend Quad operator+(Quad a, Quad b) { return {a.low + b.low, a.high + b.high}; }
  FORCESHADE_INLINE friend Quad operator-(Quad a, Quad b) { return {a.low - b.low, a.high - b.high}; }
  FORCESHADE_INLINE friend Quad operator*(Quad a, Quad b) { return {a.low * b.low, a.high * b.high}; }
  FORCESHADE_INLINE friend Quad multiply_add(Quad a, Quad b, Quad c) { return a * b + c; }
  FORCESHADE_INLINE static Pair64 multiply_add_pairs(Pair64 a, Pair64 b, Pair64 c) { return a * b + c; }
  // (0 + 2) + (1 + 3), and of two at once (0 + 1) + (2 + 3).
  FORCESHADE_INLINE friend double sum(Quad a) {
    const Pair64 two = a.low + a.high;
    return two[0] + two[1];
  }
  FORCESHADE_INLINE friend Pair64 sums(Quad a, Quad b) {
    return (Pair64{a.low[0], b.low[0]} + Pair64{a.low[1], b.low[1]}) +
           (Pair64{a.high[0], b.high[0]} + Pair64{a.high[1], b.high[1]});
  }

  FORCESHADE_INLINE friend Quad absolute(Quad a) {
    return {reinterpret_cast<Pair64>(reinterpret_cast<PairOfBits>(a.low) & INT64_MAX),
            reinterpret_cast<Pair64>(reinterpret_cast<PairOfBits>(a.high) & INT64_MAX)};
  }
};

FORCESHADE_INLINE Four32 absolute(Four32 a) {
  return reinterpret_cast<Four32>(reinterpret_cast<FourOfBits>(a) & INT32_MAX);
}
// 0 in place of what is below `least` in size.
FORCESHADE_INLINE Four32 flushed(Four32 a, Four32 least) {
  return reinterpret_cast<Four32>(reinterpret_cast<FourOfBits>(a) & (absolute(a) >= least));
}

// Each lane rounded to binary32; each lane exactly; and whether two are the same, where 0 and -0 are.
#if defined(__SSE2__)
FORCESHADE_INLINE Four32 to_binary32(Quad a) {
  return _mm_movelh_ps(_mm_cvtpd_ps(a.low), _mm_cvtpd_ps(a.high));
}
FORCESHADE_INLINE Quad to_binary64(Four32 a) {
  return {_mm_cvtps_pd(a), _mm_cvtps_pd(_mm_movehl_ps(a, a))};
}
FORCESHADE_INLINE bool are_equal(Four32 a, Four32 b) {
  return _mm_movemask_ps(_mm_cmpneq_ps(a, b)) == 0;
}
FORCESHADE_INLINE bool are_equal(Quad a, Quad b) {
  return (_mm_movemask_pd(_mm_cmpneq_pd(a.low, b.low)) | _mm_movemask_pd(_mm_cmpneq_pd(a.high, b.high))) == 0;
}
FORCESHADE_INLINE bool are_at_most(Four32 a, Four32 most) {
  return _mm_movemask_ps(_mm_cmple_ps(a, most)) == 15;
}
#else
// By __builtin_convertvector: g++ 12 takes a lane that is converted to binary32 and back for the lane itself.
using Pair32F = float __attribute__((vector_size(8)));
FORCESHADE_INLINE Four32 to_binary32(Quad a) {
  const Pair32F low = __builtin_convertvector(a.low, Pair32F), high = __builtin_convertvector(a.high, Pair32F);
  return Four32{low[0], low[1], high[0], high[1]};
}
FORCESHADE_INLINE Quad to_binary64(Four32 a) {
  return {__builtin_convertvector((Pair32F{a[0], a[1]}), Pair64), __builtin_convertvector((Pair32F{a[2], a[3]}), Pair64)};
}
FORCESHADE_INLINE bool are_equal(Four32 a, Four32 b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}
FORCESHADE_INLINE bool are_equal(Quad a, Quad b) {
  return a.low[0] == b.low[0] && a.low[1] == b.low[1] && a.high[0] == b.high[0] && a.high[1] == b.high[1];
}
FORCESHADE_INLINE bool are_at_most(Four32 a, Four32 most) {
  return a[0] <= most[0] && a[1] <= most[1] && a[2] <= most[2] && a[3] <= most[3];
}
#endif

}  // namespace forceshade::fast
