// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Eight binary64 numbers with AVX-512 (F and DQ): a Real in the sense of fast/numbers/first_stage.h. For fast/*_avx512.cpp
// alone.

#include <immintrin.h>

#include "fast/domain.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {
namespace {

struct Pack {
  static constexpr std::size_t kLanes = 8;

  struct Mask {
    __mmask8 bits = 0;
    FORCESHADE_INLINE friend Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
    FORCESHADE_INLINE friend Mask operator|(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits | b.bits)}; }
    FORCESHADE_INLINE friend Mask operator!(Mask a) { return {static_cast<__mmask8>(~a.bits)}; }
    FORCESHADE_INLINE bool any() const { return bits != 0; }
  };

  __m512d lanes;

  FORCESHADE_INLINE explicit Pack(double a) : lanes(_mm512_set1_pd(a)) {}
  FORCESHADE_INLINE Pack(__m512d a) : lanes(a) {}

  FORCESHADE_INLINE static Pack load(const float* from) { return _mm512_cvtps_pd(_mm256_loadu_ps(from)); }
  // Load and store use memory aligned to 64 bytes.
  FORCESHADE_INLINE static Pack load(const double* from) { return _mm512_load_pd(from); }
  FORCESHADE_INLINE void store(double* to) const { _mm512_store_pd(to, lanes); }
  // Rounds to binary32.
  FORCESHADE_INLINE void store(float* to) const { _mm256_storeu_ps(to, _mm512_cvtpd_ps(lanes)); }

  FORCESHADE_INLINE friend Pack operator+(Pack a, Pack b) { return _mm512_add_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a, Pack b) { return _mm512_sub_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator*(Pack a, Pack b) { return _mm512_mul_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator/(Pack a, Pack b) { return _mm512_div_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a) { return _mm512_xor_pd(a.lanes, _mm512_set1_pd(-0.0)); }
  FORCESHADE_INLINE friend Mask operator<(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.lanes, b.lanes, _CMP_LT_OQ)}; }
  FORCESHADE_INLINE friend Mask operator<=(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.lanes, b.lanes, _CMP_LE_OQ)}; }
  FORCESHADE_INLINE friend Mask operator>(Pack a, Pack b) { return b < a; }
  FORCESHADE_INLINE friend Mask operator>=(Pack a, Pack b) { return b <= a; }
  FORCESHADE_INLINE friend Mask operator==(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.lanes, b.lanes, _CMP_EQ_OQ)}; }
  FORCESHADE_INLINE friend Pack absolute(Pack a) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a.lanes); }
  FORCESHADE_INLINE friend Pack multiply_add(Pack a, Pack b, Pack c) { return _mm512_fmadd_pd(a.lanes, b.lanes, c.lanes); }
  FORCESHADE_INLINE friend Pack multiply_subtract(Pack a, Pack b, Pack c) {
    return _mm512_fnmadd_pd(a.lanes, b.lanes, c.lanes);
  }
  FORCESHADE_INLINE friend Pack square_root(Pack a) { return _mm512_sqrt_pd(a.lanes); }
  FORCESHADE_INLINE friend Pack larger(Pack a, Pack b) { return _mm512_max_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack select(Mask condition, Pack yes, Pack no) {
    return _mm512_mask_blend_pd(condition.bits, no.lanes, yes.lanes);
  }
};

// What keeps a block from being answered by packs, gathered over the block and tested once, all in integers: they leave
// the floating-point units free, and cost no masks.
struct Watch {
  __m512i largest = _mm512_setzero_si512();  // of the coordinates' sizes, as bits: NaN above infinity above every number
  __m512i smallest = _mm512_set1_epi32(-1);  // of the same less one, which puts 0 last
  __m512i closest = _mm512_setzero_si512();  // of the forces' dropped bits, moved by kTieOffset

  // Twice kLanes of them.
  FORCESHADE_INLINE void coordinates(const float* from) {
    const __m512i bits = _mm512_loadu_si512(from);
    const __m512i size = _mm512_and_si512(bits, _mm512_set1_epi32(INT32_MAX));
    largest = _mm512_max_epu32(largest, size);
    smallest = _mm512_min_epu32(smallest, _mm512_sub_epi32(size, _mm512_set1_epi32(1)));
  }

  template <int kWindow>
  FORCESHADE_INLINE void rounding(Pack value) {
    const __m512i moved = _mm512_add_epi64(_mm512_castpd_si512(value.lanes), _mm512_set1_epi64(kTieOffset<kWindow>));
    closest = _mm512_max_epu32(closest, _mm512_and_si512(moved, _mm512_set1_epi64(kDroppedMask)));
  }

  // Every coordinate is valid and either 0 or not below the quantum, no rounding is in doubt.
  template <int kWindow>
  FORCESHADE_INLINE bool is_free_of_hazards() const {
    constexpr int kLargest = __builtin_bit_cast(int, kLargestCoordinate);
    constexpr int kSmallest = __builtin_bit_cast(int, kPositionQuantum) - 1;
    const __mmask16 invalid = _mm512_cmpgt_epu32_mask(largest, _mm512_set1_epi32(kLargest));
    const __mmask16 tiny = _mm512_cmplt_epu32_mask(smallest, _mm512_set1_epi32(kSmallest));
    const __mmask16 doubt = _mm512_cmpge_epu32_mask(closest, _mm512_set1_epi32(kTieThreshold<kWindow>));
    return (invalid | tiny | doubt) == 0;
  }
};

}  // namespace
}  // namespace forceshade::fast
