// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Eight binary64 numbers with AVX-512 (F and DQ): a Real in the sense of fast/first_stage.h. For fast/batch_avx512.cpp alone.

#include <immintrin.h>

#include "forceshade/fast/first_stage.h"

namespace forceshade::fast {
namespace {

struct Pack {
  static constexpr std::size_t kLanes = 8;

  struct Mask {
    __mmask8 bits = 0;
    FORCESHADE_INLINE friend Mask operator&(Mask a, Mask b) { return {_kand_mask8(a.bits, b.bits)}; }
    FORCESHADE_INLINE friend Mask operator|(Mask a, Mask b) { return {_kor_mask8(a.bits, b.bits)}; }
    FORCESHADE_INLINE friend Mask operator!(Mask a) { return {_knot_mask8(a.bits)}; }
    FORCESHADE_INLINE bool any() const { return bits != 0; }
  };

  __m512d lanes;

  FORCESHADE_INLINE explicit Pack(double a) : lanes(_mm512_set1_pd(a)) {}
  FORCESHADE_INLINE Pack(__m512d a) : lanes(a) {}

  FORCESHADE_INLINE static Pack load(const float* from) { return _mm512_cvtps_pd(_mm256_loadu_ps(from)); }
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
  FORCESHADE_INLINE friend Pack absolute(Pack a) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a.lanes); }
  FORCESHADE_INLINE friend Pack square_root(Pack a) { return _mm512_sqrt_pd(a.lanes); }
  FORCESHADE_INLINE friend Pack select(Mask condition, Pack yes, Pack no) {
    return _mm512_mask_blend_pd(condition.bits, no.lanes, yes.lanes);
  }
};

template <double kErrorBound>
FORCESHADE_INLINE Pack::Mask rounding_is_in_doubt(Pack value) {
  if constexpr (kErrorBound == 0) return {};
  const __m512i dropped = _mm512_slli_epi64(_mm512_castpd_si512(value.lanes), 35);
  const __m512i shifted = _mm512_add_epi64(dropped, _mm512_set1_epi64(kDoubtWindow<kErrorBound>));
  return {_mm512_cmple_epi64_mask(shifted, _mm512_set1_epi64(INT64_MIN + 2 * kDoubtWindow<kErrorBound>))};
}

}  // namespace
}  // namespace forceshade::fast
