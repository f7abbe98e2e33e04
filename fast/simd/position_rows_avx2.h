// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rows (x, y, z) as coordinates apart and back, eight rows at a time with AVX2: for the files that have a Pack alone.
//
// Eight rows are three vectors of eight floats. Coordinate c of row i is float 3i + c of them, so that the eight numbers of one
// coordinate lie in lanes that all differ: a blend of the three vectors has them all, and one permutation puts them in order.

#include <immintrin.h>

#include "fast/domain.h"
#include "fast/simd/batch.h"

namespace forceshade::fast {
namespace {

// The lanes l of a vector with l mod 3 = 0, 1 and 2.
constexpr int kLanes036 = 0b01001001, kLanes147 = 0b10010010, kLanes25 = 0b00100100;

// Puts coordinate c of row i, which a blend leaves in lane (3i + c) mod 8, into lane i; for x and z, c = 0 and 2, the same
// permutation puts it back.
FORCESHADE_INLINE __m256 x_in_order(__m256 x) {
  return _mm256_permutevar8x32_ps(x, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
}
FORCESHADE_INLINE __m256 z_in_order(__m256 z) {
  return _mm256_permutevar8x32_ps(z, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
}

bool take_rows_apart(const float* rows, std::size_t count, float* x, float* z) {
  __m256i largest = _mm256_setzero_si256();  // the sizes of y, as bits: NaN above infinity above every number
  for (std::size_t i = 0; i < count; i += 8) {
    const __m256 a = _mm256_loadu_ps(rows + 3 * i), b = _mm256_loadu_ps(rows + 3 * i + 8),
                 c = _mm256_loadu_ps(rows + 3 * i + 16);
    const __m256 all_x = _mm256_blend_ps(_mm256_blend_ps(a, b, kLanes147), c, kLanes25);
    const __m256 all_y = _mm256_blend_ps(_mm256_blend_ps(a, b, kLanes25), c, kLanes036);
    const __m256 all_z = _mm256_blend_ps(_mm256_blend_ps(a, b, kLanes036), c, kLanes147);
    _mm256_storeu_ps(x + i, x_in_order(all_x));
    _mm256_storeu_ps(z + i, z_in_order(all_z));
    const __m256i size = _mm256_and_si256(_mm256_castps_si256(all_y), _mm256_set1_epi32(INT32_MAX));
    largest = _mm256_max_epi32(largest, size);
  }
  constexpr int kLargest = __builtin_bit_cast(int, kLargestCoordinate);
  return _mm256_movemask_epi8(_mm256_cmpgt_epi32(largest, _mm256_set1_epi32(kLargest))) == 0;
}

void put_rows_together(const float* fx, const float* fz, std::size_t count, float* rows) {
  for (std::size_t i = 0; i < count; i += 8) {
    const __m256 x = x_in_order(_mm256_loadu_ps(fx + i));
    const __m256 z = z_in_order(_mm256_loadu_ps(fz + i));
    const __m256 y = _mm256_setzero_ps();
    _mm256_storeu_ps(rows + 3 * i, _mm256_blend_ps(_mm256_blend_ps(x, y, kLanes147), z, kLanes25));
    _mm256_storeu_ps(rows + 3 * i + 8, _mm256_blend_ps(_mm256_blend_ps(x, y, kLanes25), z, kLanes036));
    _mm256_storeu_ps(rows + 3 * i + 16, _mm256_blend_ps(_mm256_blend_ps(x, y, kLanes036), z, kLanes147));
  }
}

}  // namespace
}  // namespace forceshade::fast
