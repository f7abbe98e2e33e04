// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Four binary64 numbers with AVX2: a Real in the sense of fast/first_stage.h. For fast/batch_avx2.cpp alone.

#include <immintrin.h>

#include "forceshade/fast/first_stage.h"

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
  FORCESHADE_INLINE friend Pack absolute(Pack a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a.lanes); }
  FORCESHADE_INLINE friend Pack square_root(Pack a) { return _mm256_sqrt_pd(a.lanes); }
  FORCESHADE_INLINE friend Pack select(Mask condition, Pack yes, Pack no) {
    return _mm256_blendv_pd(no.lanes, yes.lanes, condition.bits);
  }
};

template <double kErrorBound>
FORCESHADE_INLINE Pack::Mask rounding_is_in_doubt(Pack value) {
  if constexpr (kErrorBound == 0) return {};
  const __m256i dropped = _mm256_slli_epi64(_mm256_castpd_si256(value.lanes), 35);
  const __m256i shifted = _mm256_add_epi64(dropped, _mm256_set1_epi64x(kDoubtWindow<kErrorBound>));
  return {_mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_set1_epi64x(INT64_MIN + 2 * kDoubtWindow<kErrorBound> + 1), shifted))};
}

}  // namespace
}  // namespace forceshade::fast
