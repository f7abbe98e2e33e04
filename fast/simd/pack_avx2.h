// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Four binary64 numbers with AVX2: a Real in the sense of fast/numbers/first_stage.h. For fast/*_avx2.cpp alone.

#include <immintrin.h>

#include "fast/domain.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {
namespace {

struct Pack {
  static constexpr std::size_t kLanes = 4;

  struct Mask {
    __m256d bits = _mm256_setzero_pd();
    FORCESHADE_INLINE friend Mask operator&(Mask a, Mask b) { return {_mm256_and_pd(a.bits, b.bits)}; }
    FORCESHADE_INLINE friend Mask operator|(Mask a, Mask b) { return {_mm256_or_pd(a.bits, b.bits)}; }
    FORCESHADE_INLINE friend Mask operator!(Mask a) {
      return {_mm256_xor_pd(a.bits, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))};
    }
    FORCESHADE_INLINE bool any() const { return _mm256_movemask_pd(bits) != 0; }
  };

  __m256d lanes;

  FORCESHADE_INLINE explicit Pack(double a) : lanes(_mm256_set1_pd(a)) {}
  FORCESHADE_INLINE Pack(__m256d a) : lanes(a) {}

  FORCESHADE_INLINE static Pack load(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }
  // Load and store use memory aligned to 32 bytes.
  FORCESHADE_INLINE static Pack load(const double* from) { return _mm256_load_pd(from); }
  FORCESHADE_INLINE void store(double* to) const { _mm256_store_pd(to, lanes); }
  // Rounds to binary32.
  FORCESHADE_INLINE void store(float* to) const { _mm_storeu_ps(to, _mm256_cvtpd_ps(lanes)); }

  FORCESHADE_INLINE friend Pack operator+(Pack a, Pack b) { return _mm256_add_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a, Pack b) { return _mm256_sub_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator*(Pack a, Pack b) { return _mm256_mul_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator/(Pack a, Pack b) { return _mm256_div_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a) { return _mm256_xor_pd(a.lanes, _mm256_set1_pd(-0.0)); }
  FORCESHADE_INLINE friend Mask operator<(Pack a, Pack b) { return {_mm256_cmp_pd(a.lanes, b.lanes, _CMP_LT_OQ)}; }
  FORCESHADE_INLINE friend Mask operator<=(Pack a, Pack b) { return {_mm256_cmp_pd(a.lanes, b.lanes, _CMP_LE_OQ)}; }
  FORCESHADE_INLINE friend Mask operator>(Pack a, Pack b) { return b < a; }
  FORCESHADE_INLINE friend Mask operator>=(Pack a, Pack b) { return b <= a; }
  FORCESHADE_INLINE friend Mask operator==(Pack a, Pack b) { return {_mm256_cmp_pd(a.lanes, b.lanes, _CMP_EQ_OQ)}; }
  FORCESHADE_INLINE friend Pack absolute(Pack a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a.lanes); }
  FORCESHADE_INLINE friend Pack multiply_add(Pack a, Pack b, Pack c) { return _mm256_fmadd_pd(a.lanes, b.lanes, c.lanes); }
  FORCESHADE_INLINE friend Pack multiply_subtract(Pack a, Pack b, Pack c) {
    return _mm256_fnmadd_pd(a.lanes, b.lanes, c.lanes);
  }
  FORCESHADE_INLINE friend Pack square_root(Pack a) { return _mm256_sqrt_pd(a.lanes); }
  FORCESHADE_INLINE friend Pack larger(Pack a, Pack b) { return _mm256_max_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack select(Mask condition, Pack yes, Pack no) {
    return _mm256_blendv_pd(no.lanes, yes.lanes, condition.bits);
  }
};

// What keeps a block from being answered by packs, gathered over the block and tested once, all in integers: they leave
// the floating-point units free, and cost no masks.
struct Watch {
  __m256i largest = _mm256_setzero_si256();  // of the coordinates' sizes, as bits: NaN above infinity above every number
  __m256i smallest = _mm256_set1_epi32(-1);  // of the same less one, which puts 0 last
  __m256i closest = _mm256_setzero_si256();  // of the forces' dropped bits, moved by kTieOffset

  // Twice kLanes of them.
  FORCESHADE_INLINE void coordinates(const float* from) {
    const __m256i bits = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    const __m256i size = _mm256_and_si256(bits, _mm256_set1_epi32(INT32_MAX));
    largest = _mm256_max_epu32(largest, size);
    smallest = _mm256_min_epu32(smallest, _mm256_sub_epi32(size, _mm256_set1_epi32(1)));
  }

  template <int kWindow>
  FORCESHADE_INLINE void rounding(Pack value) {
    const __m256i moved = _mm256_add_epi64(_mm256_castpd_si256(value.lanes), _mm256_set1_epi64x(kTieOffset<kWindow>));
    closest = _mm256_max_epu32(closest, _mm256_and_si256(moved, _mm256_set1_epi64x(kDroppedMask)));
  }

  // Every coordinate is valid and either 0 or not below the quantum, no rounding is in doubt.
  template <int kWindow>
  FORCESHADE_INLINE bool is_free_of_hazards() const {
    constexpr int kLargest = __builtin_bit_cast(int, kLargestCoordinate);
    constexpr int kSmallest = __builtin_bit_cast(int, kPositionQuantum) - 1;
    // largest and closest are below 2^31; smallest may not be, and AVX2 compares signed integers alone.
    const __m256i invalid = _mm256_cmpgt_epi32(largest, _mm256_set1_epi32(kLargest));
    const __m256i tiny = _mm256_cmpeq_epi32(_mm256_min_epu32(smallest, _mm256_set1_epi32(kSmallest - 1)), smallest);
    const __m256i doubt = _mm256_cmpgt_epi32(closest, _mm256_set1_epi32(kTieThreshold<kWindow> - 1));
    const __m256i any = _mm256_or_si256(_mm256_or_si256(invalid, tiny), doubt);
    return _mm256_testz_si256(any, any) != 0;
  }
};

}  // namespace
}  // namespace forceshade::fast
