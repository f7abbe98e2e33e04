// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Eight binary64 numbers with AVX-512 (F and DQ): what batches compute with (fast/simd/form.inl, fast/heights/). For
// fast/*_avx512.cpp alone.

#include <immintrin.h>

#include <cstdint>

#include "fast/domain.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {
namespace {

struct Pack {
  static constexpr std::size_t kLanes = 8;

  struct Mask {
    __mmask8 bits;
    FORCESHADE_INLINE friend Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
  };

  __m512d lanes;

  FORCESHADE_INLINE explicit Pack(double a) : lanes(_mm512_set1_pd(a)) {}
  FORCESHADE_INLINE Pack(__m512d a) : lanes(a) {}

  FORCESHADE_INLINE static Pack load(const float* from) { return _mm512_cvtps_pd(_mm256_loadu_ps(from)); }
  // Load and store use memory aligned to 64 bytes.
  FORCESHADE_INLINE static Pack load(const double* from) { return _mm512_load_pd(from); }
  FORCESHADE_INLINE void store(double* to) const { _mm512_store_pd(to, lanes); }

  FORCESHADE_INLINE friend Pack operator+(Pack a, Pack b) { return _mm512_add_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a, Pack b) { return _mm512_sub_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator*(Pack a, Pack b) { return _mm512_mul_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator/(Pack a, Pack b) { return _mm512_div_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a) { return _mm512_xor_pd(a.lanes, _mm512_set1_pd(-0.0)); }
  FORCESHADE_INLINE friend Mask operator<=(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.lanes, b.lanes, _CMP_LE_OQ)}; }
  FORCESHADE_INLINE friend Mask operator>=(Pack a, Pack b) { return b <= a; }
  FORCESHADE_INLINE friend Pack absolute(Pack a) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a.lanes); }
  // a·b + c, -(a·b) + c and a·b - c, rounded once.
  FORCESHADE_INLINE friend Pack fused_add(Pack a, Pack b, Pack c) { return _mm512_fmadd_pd(a.lanes, b.lanes, c.lanes); }
  FORCESHADE_INLINE friend Pack fused_subtract_from(Pack a, Pack b, Pack c) {
    return _mm512_fnmadd_pd(a.lanes, b.lanes, c.lanes);
  }
  FORCESHADE_INLINE friend Pack fused_less(Pack a, Pack b, Pack c) { return _mm512_fmsub_pd(a.lanes, b.lanes, c.lanes); }
  // The name that any number has for it (fast/heights/spline.h).
  FORCESHADE_INLINE friend Pack multiply_add(Pack a, Pack b, Pack c) { return fused_add(a, b, c); }
  FORCESHADE_INLINE friend Pack square_root(Pack a) { return _mm512_sqrt_pd(a.lanes); }
  FORCESHADE_INLINE friend Pack larger(Pack a, Pack b) { return _mm512_max_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack select(Mask condition, Pack yes, Pack no) {
    return _mm512_mask_blend_pd(condition.bits, no.lanes, yes.lanes);
  }
};

// Sixteen binary32 numbers: as many as two packs.
struct Floats {
  static constexpr std::size_t kLanes = 16;

  struct Mask {
    __mmask16 bits;
    FORCESHADE_INLINE friend Mask operator&(Mask a, Mask b) { return {static_cast<__mmask16>(a.bits & b.bits)}; }
    FORCESHADE_INLINE friend Mask operator|(Mask a, Mask b) { return {static_cast<__mmask16>(a.bits | b.bits)}; }
  };

  __m512 lanes;

  FORCESHADE_INLINE explicit Floats(float a) : lanes(_mm512_set1_ps(a)) {}
  // The number is a binary32, which laws keep in binary64.
  FORCESHADE_INLINE explicit Floats(double a) : Floats(static_cast<float>(a)) {}
  FORCESHADE_INLINE Floats(__m512 a) : lanes(a) {}

  FORCESHADE_INLINE static Floats load(const float* from) { return _mm512_loadu_ps(from); }
  FORCESHADE_INLINE void store(float* to) const { _mm512_storeu_ps(to, lanes); }
  // The two packs, exact, and back, rounded.
  FORCESHADE_INLINE Pack first_half() const { return _mm512_cvtps_pd(_mm512_castps512_ps256(lanes)); }
  FORCESHADE_INLINE Pack second_half() const { return _mm512_cvtps_pd(_mm512_extractf32x8_ps(lanes, 1)); }
  FORCESHADE_INLINE static Floats rounded(Pack first, Pack second) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(first.lanes)), _mm512_cvtpd_ps(second.lanes), 1);
  }

  FORCESHADE_INLINE friend Floats operator+(Floats a, Floats b) { return _mm512_add_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats operator-(Floats a, Floats b) { return _mm512_sub_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats operator*(Floats a, Floats b) { return _mm512_mul_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats operator/(Floats a, Floats b) { return _mm512_div_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Mask operator<(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.lanes, b.lanes, _CMP_LT_OQ)}; }
  FORCESHADE_INLINE friend Mask operator<=(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.lanes, b.lanes, _CMP_LE_OQ)}; }
  FORCESHADE_INLINE friend Mask operator>(Floats a, Floats b) { return {_mm512_cmp_ps_mask(b.lanes, a.lanes, _CMP_LT_OQ)}; }
  FORCESHADE_INLINE friend Mask operator==(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.lanes, b.lanes, _CMP_EQ_OQ)}; }
  FORCESHADE_INLINE friend Floats absolute(Floats a) { return _mm512_andnot_ps(_mm512_set1_ps(-0.0F), a.lanes); }
  // a times the sign of b.
  FORCESHADE_INLINE friend Floats times_sign(Floats a, Floats b) {
    return _mm512_xor_ps(a.lanes, _mm512_and_ps(b.lanes, _mm512_set1_ps(-0.0F)));
  }
  FORCESHADE_INLINE friend Floats square_root(Floats a) { return _mm512_sqrt_ps(a.lanes); }
  // The second, where both are zeros.
  FORCESHADE_INLINE friend Floats larger(Floats a, Floats b) { return _mm512_max_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats select(Mask condition, Floats yes, Floats no) {
    return _mm512_mask_blend_ps(condition.bits, no.lanes, yes.lanes);
  }
  // 0 where the condition does not hold.
  FORCESHADE_INLINE friend Floats operator&(Floats a, Mask condition) { return _mm512_maskz_mov_ps(condition.bits, a.lanes); }
};

// Reasons not to answer a block by packs, gathered over the block and tested once.
struct Watch {
  __m512i largest = _mm512_setzero_si512();  // of the coordinates' sizes, as bits: NaN above infinity above every number
  __m512i smallest = _mm512_set1_epi32(-1);  // of the same less one, which puts 0 last
  __m512i closest = _mm512_setzero_si512();  // of the forces' dropped bits, moved by kTieOffset
  __m512i nearest = _mm512_set1_epi32(-1);   // of the sizes of distances, as the upper halves of their bits
  __mmask16 doubtful = 0;

  // The sizes of two coordinates. They are compared with each other first, so that each result waits for one operation a turn.
  FORCESHADE_INLINE void domain(Floats a, Floats b) {
    largest = _mm512_max_epu32(largest, _mm512_max_epu32(_mm512_castps_si512(a.lanes), _mm512_castps_si512(b.lanes)));
  }
  // The size of a coordinate that changes the force however tiny it is.
  FORCESHADE_INLINE void tiny(Floats size) { smallest = _mm512_min_epu32(smallest, less_one(size)); }
  // The sizes of two such coordinates.
  FORCESHADE_INLINE void coordinates(Floats a, Floats b) {
    domain(a, b);
    smallest = _mm512_min_epu32(smallest, _mm512_min_epu32(less_one(a), less_one(b)));
  }

  // Takes a number that is 0 on the surface, and too rough where it is small. The upper halves of two packs make one vector.
  FORCESHADE_INLINE void distance(Pack first, Pack second) {
    const __m512i high = _mm512_castps_si512(
        _mm512_shuffle_ps(_mm512_castpd_ps(first.lanes), _mm512_castpd_ps(second.lanes), _MM_SHUFFLE(3, 1, 3, 1)));
    nearest = _mm512_min_epu32(nearest, _mm512_and_si512(high, _mm512_set1_epi32(INT32_MAX)));
  }

  FORCESHADE_INLINE void doubt(Floats::Mask where) { doubtful = static_cast<__mmask16>(doubtful | where.bits); }

  // The lower halves of two packs, which hold the dropped bits, make one vector.
  template <int kWindow>
  FORCESHADE_INLINE void rounding(Pack first, Pack second) {
    const __m512i low = _mm512_castps_si512(
        _mm512_shuffle_ps(_mm512_castpd_ps(first.lanes), _mm512_castpd_ps(second.lanes), _MM_SHUFFLE(2, 0, 2, 0)));
    const __m512i moved = _mm512_add_epi32(low, _mm512_set1_epi32(kTieOffset<kWindow>));
    closest = _mm512_max_epu32(closest, _mm512_and_si512(moved, _mm512_set1_epi32(kDroppedMask)));
  }

  // Every coordinate is valid and either 0 or not below least_coordinate in size, no distance is below least_distance (rounded
  // up to 21 bits), no rounding and nothing else is in doubt.
  template <int kWindow>
  FORCESHADE_INLINE bool is_free_of_hazards(float least_coordinate, double least_distance) const {
    constexpr int kLargest = __builtin_bit_cast(int, kLargestCoordinate);
    const int before_least = __builtin_bit_cast(int, least_coordinate) - 1;
    const __mmask16 invalid = _mm512_cmpgt_epu32_mask(largest, _mm512_set1_epi32(kLargest));
    const __mmask16 tiny = _mm512_cmplt_epu32_mask(smallest, _mm512_set1_epi32(before_least));
    const __mmask16 doubt = _mm512_cmpge_epu32_mask(closest, _mm512_set1_epi32(kTieThreshold<kWindow>));
    const int high = static_cast<int>(__builtin_bit_cast(std::uint64_t, least_distance) >> 32);
    const __mmask16 near = _mm512_cmple_epu32_mask(nearest, _mm512_set1_epi32(high));
    return (invalid | tiny | doubt | near | doubtful) == 0;
  }

 private:
  FORCESHADE_INLINE static __m512i less_one(Floats size) {
    return _mm512_sub_epi32(_mm512_castps_si512(size.lanes), _mm512_set1_epi32(1));
  }
};

}  // namespace
}  // namespace forceshade::fast
