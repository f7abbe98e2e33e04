// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Four binary64 numbers with AVX2: what a batch computes with (fast/simd/form.inl). For fast/*_avx2.cpp alone.

#include <immintrin.h>

#include <cstdint>

#include "fast/domain.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {
namespace {

struct Pack {
  static constexpr std::size_t kLanes = 4;

  struct Mask {
    __m256d bits;
  };

  __m256d lanes;

  FORCESHADE_INLINE explicit Pack(double a) : lanes(_mm256_set1_pd(a)) {}
  FORCESHADE_INLINE Pack(__m256d a) : lanes(a) {}

  FORCESHADE_INLINE static Pack load(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }
  // Load and store use memory aligned to 32 bytes.
  FORCESHADE_INLINE static Pack load(const double* from) { return _mm256_load_pd(from); }
  FORCESHADE_INLINE void store(double* to) const { _mm256_store_pd(to, lanes); }

  FORCESHADE_INLINE friend Pack operator+(Pack a, Pack b) { return _mm256_add_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a, Pack b) { return _mm256_sub_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator*(Pack a, Pack b) { return _mm256_mul_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack operator-(Pack a) { return _mm256_xor_pd(a.lanes, _mm256_set1_pd(-0.0)); }
  FORCESHADE_INLINE friend Mask operator<=(Pack a, Pack b) { return {_mm256_cmp_pd(a.lanes, b.lanes, _CMP_LE_OQ)}; }
  // a·b + c, -(a·b) + c and a·b - c, rounded once.
  FORCESHADE_INLINE friend Pack fused_add(Pack a, Pack b, Pack c) { return _mm256_fmadd_pd(a.lanes, b.lanes, c.lanes); }
  FORCESHADE_INLINE friend Pack fused_subtract_from(Pack a, Pack b, Pack c) {
    return _mm256_fnmadd_pd(a.lanes, b.lanes, c.lanes);
  }
  FORCESHADE_INLINE friend Pack fused_less(Pack a, Pack b, Pack c) { return _mm256_fmsub_pd(a.lanes, b.lanes, c.lanes); }
  // The name that any number has for it (fast/heights/spline.h).
  FORCESHADE_INLINE friend Pack multiply_add(Pack a, Pack b, Pack c) { return fused_add(a, b, c); }
  FORCESHADE_INLINE friend Pack square_root(Pack a) { return _mm256_sqrt_pd(a.lanes); }
  FORCESHADE_INLINE friend Pack larger(Pack a, Pack b) { return _mm256_max_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Pack select(Mask condition, Pack yes, Pack no) {
    return _mm256_blendv_pd(no.lanes, yes.lanes, condition.bits);
  }
};

// Eight binary32 numbers: as many as two packs.
struct Floats {
  static constexpr std::size_t kLanes = 8;

  struct Mask {
    __m256 bits;
    FORCESHADE_INLINE friend Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.bits, b.bits)}; }
    FORCESHADE_INLINE friend Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.bits, b.bits)}; }
  };

  __m256 lanes;

  FORCESHADE_INLINE explicit Floats(float a) : lanes(_mm256_set1_ps(a)) {}
  // The number is a binary32, which laws keep in binary64.
  FORCESHADE_INLINE explicit Floats(double a) : Floats(static_cast<float>(a)) {}
  FORCESHADE_INLINE Floats(__m256 a) : lanes(a) {}

  FORCESHADE_INLINE static Floats load(const float* from) { return _mm256_loadu_ps(from); }
  FORCESHADE_INLINE void store(float* to) const { _mm256_storeu_ps(to, lanes); }
  // The two packs, exact, and back, rounded.
  FORCESHADE_INLINE Pack first_half() const { return _mm256_cvtps_pd(_mm256_castps256_ps128(lanes)); }
  FORCESHADE_INLINE Pack second_half() const { return _mm256_cvtps_pd(_mm256_extractf128_ps(lanes, 1)); }
  FORCESHADE_INLINE static Floats rounded(Pack first, Pack second) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(first.lanes)), _mm256_cvtpd_ps(second.lanes), 1);
  }

  FORCESHADE_INLINE friend Floats operator+(Floats a, Floats b) { return _mm256_add_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats operator-(Floats a, Floats b) { return _mm256_sub_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats operator*(Floats a, Floats b) { return _mm256_mul_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats operator/(Floats a, Floats b) { return _mm256_div_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Mask operator<(Floats a, Floats b) { return {_mm256_cmp_ps(a.lanes, b.lanes, _CMP_LT_OQ)}; }
  FORCESHADE_INLINE friend Mask operator<=(Floats a, Floats b) { return {_mm256_cmp_ps(a.lanes, b.lanes, _CMP_LE_OQ)}; }
  FORCESHADE_INLINE friend Mask operator>(Floats a, Floats b) { return b < a; }
  FORCESHADE_INLINE friend Mask operator==(Floats a, Floats b) { return {_mm256_cmp_ps(a.lanes, b.lanes, _CMP_EQ_OQ)}; }
  FORCESHADE_INLINE friend Floats absolute(Floats a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.lanes); }
  // a times the sign of b.
  FORCESHADE_INLINE friend Floats times_sign(Floats a, Floats b) {
    return _mm256_xor_ps(a.lanes, _mm256_and_ps(b.lanes, _mm256_set1_ps(-0.0F)));
  }
  FORCESHADE_INLINE friend Floats square_root(Floats a) { return _mm256_sqrt_ps(a.lanes); }
  // The second, where both are zeros.
  FORCESHADE_INLINE friend Floats larger(Floats a, Floats b) { return _mm256_max_ps(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Floats select(Mask condition, Floats yes, Floats no) {
    return _mm256_blendv_ps(no.lanes, yes.lanes, condition.bits);
  }
  // 0 where the condition does not hold.
  FORCESHADE_INLINE friend Floats operator&(Floats a, Mask b) { return _mm256_and_ps(a.lanes, b.bits); }
};

// Reasons not to answer a block by packs, gathered over the block and tested once, all in integers: they leave
// the floating-point units free, and cost no masks.
struct Watch {
  __m256i largest = _mm256_setzero_si256();  // of the coordinates' sizes, as bits: NaN above infinity above every number
  __m256i smallest = _mm256_set1_epi32(-1);  // of the same less one, which puts 0 last
  __m256i closest = _mm256_setzero_si256();  // of the forces' dropped bits, moved by kTieOffset
  __m256 doubtful = _mm256_setzero_ps();
  __m256i nearest = _mm256_set1_epi32(-1);  // of the sizes of distances, as the upper halves of their bits

  // The sizes of two coordinates. They are compared with each other first, so that each result waits for one operation a turn.
  FORCESHADE_INLINE void domain(Floats a, Floats b) {
    largest = _mm256_max_epu32(largest, _mm256_max_epu32(_mm256_castps_si256(a.lanes), _mm256_castps_si256(b.lanes)));
  }
  // The size of a coordinate that changes the force however tiny it is.
  FORCESHADE_INLINE void tiny(Floats size) { smallest = _mm256_min_epu32(smallest, less_one(size)); }
  // The sizes of two such coordinates.
  FORCESHADE_INLINE void coordinates(Floats a, Floats b) {
    domain(a, b);
    smallest = _mm256_min_epu32(smallest, _mm256_min_epu32(less_one(a), less_one(b)));
  }

  // Takes a number that is 0 on the surface, and too rough where it is small. The upper halves of two packs make one vector.
  FORCESHADE_INLINE void distance(Pack first, Pack second) {
    const __m256i high = _mm256_castps_si256(
        _mm256_shuffle_ps(_mm256_castpd_ps(first.lanes), _mm256_castpd_ps(second.lanes), _MM_SHUFFLE(3, 1, 3, 1)));
    nearest = _mm256_min_epu32(nearest, _mm256_and_si256(high, _mm256_set1_epi32(INT32_MAX)));
  }

  FORCESHADE_INLINE void doubt(Floats::Mask where) { doubtful = _mm256_or_ps(doubtful, where.bits); }

  // The lower halves of two packs, which hold the dropped bits, make one vector.
  template <int kWindow>
  FORCESHADE_INLINE void rounding(Pack first, Pack second) {
    const __m256i low = _mm256_castps_si256(
        _mm256_shuffle_ps(_mm256_castpd_ps(first.lanes), _mm256_castpd_ps(second.lanes), _MM_SHUFFLE(2, 0, 2, 0)));
    const __m256i moved = _mm256_add_epi32(low, _mm256_set1_epi32(kTieOffset<kWindow>));
    closest = _mm256_max_epu32(closest, _mm256_and_si256(moved, _mm256_set1_epi32(kDroppedMask)));
  }

  // Every coordinate is valid and either 0 or not below least_coordinate in size, no distance is below least_distance (rounded
  // up to 21 bits), no rounding and nothing else is in doubt.
  template <int kWindow>
  FORCESHADE_INLINE bool is_free_of_hazards(float least_coordinate, double least_distance) const {
    constexpr int kLargest = __builtin_bit_cast(int, kLargestCoordinate);
    const int before_least = __builtin_bit_cast(int, least_coordinate) - 1;
    // largest and closest are below 2^31; smallest may not be, and AVX2 compares signed integers alone.
    const __m256i invalid = _mm256_cmpgt_epi32(largest, _mm256_set1_epi32(kLargest));
    const __m256i tiny = _mm256_cmpeq_epi32(_mm256_min_epu32(smallest, _mm256_set1_epi32(before_least - 1)), smallest);
    const __m256i doubt = _mm256_cmpgt_epi32(closest, _mm256_set1_epi32(kTieThreshold<kWindow> - 1));
    const int high = static_cast<int>(__builtin_bit_cast(std::uint64_t, least_distance) >> 32);
    const __m256i near = _mm256_cmpeq_epi32(_mm256_min_epu32(nearest, _mm256_set1_epi32(high)), nearest);
    const __m256i any = _mm256_or_si256(_mm256_or_si256(invalid, tiny),
                                        _mm256_or_si256(_mm256_or_si256(doubt, near), _mm256_castps_si256(doubtful)));
    return _mm256_testz_si256(any, any) != 0;
  }

 private:
  FORCESHADE_INLINE static __m256i less_one(Floats size) {
    return _mm256_sub_epi32(_mm256_castps_si256(size.lanes), _mm256_set1_epi32(1));
  }
};

}  // namespace
}  // namespace forceshade::fast
