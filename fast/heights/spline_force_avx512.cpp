// SPDX-License-Identifier: BSD-3-Clause
// The first stage of a spline at eight positions, one a lane: what fast/heights/spline_force.h does, line by line; compiled
// with -mavx512f -mavx512dq -mavx512vl -mavx512bw.

#include "fast/heights/spline_force.h"
#include "fast/simd/pack_avx512.h"

namespace forceshade::fast {
namespace {

// Eight x, y, z one after the other, and three vectors of them.
struct Triples {
  __m256 x, y, z;

  FORCESHADE_INLINE Triples(__m256 a, __m256 b, __m256 c) : x(a), y(b), z(c) {}
  FORCESHADE_INLINE explicit Triples(const float* from) {
    const __m512 first = _mm512_loadu_ps(from), rest = _mm512_castps256_ps512(_mm256_loadu_ps(from + 16));
    const __m512i every_third = _mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 0, 0, 0, 0, 0, 0, 0, 0);
    const auto from_axis = [&](int axis) {
      return _mm512_castps512_ps256(
          _mm512_permutex2var_ps(first, _mm512_add_epi32(every_third, _mm512_set1_epi32(axis)), rest));
    };
    x = from_axis(0);
    y = from_axis(1);
    z = from_axis(2);
  }
  FORCESHADE_INLINE void store(float* to) const {
    const __m512 xy = _mm512_insertf32x8(_mm512_castps256_ps512(x), y, 1), zs = _mm512_castps256_ps512(z);
    const __m512i first = _mm512_setr_epi32(0, 8, 16, 1, 9, 17, 2, 10, 18, 3, 11, 19, 4, 12, 20, 5);
    const __m512i rest = _mm512_setr_epi32(13, 21, 6, 14, 22, 7, 15, 23, 0, 0, 0, 0, 0, 0, 0, 0);
    _mm512_storeu_ps(to, _mm512_permutex2var_ps(xy, first, zs));
    _mm256_storeu_ps(to + 16, _mm512_castps512_ps256(_mm512_permutex2var_ps(xy, rest, zs)));
  }
};

// As is_plain (fast/domain.h).
FORCESHADE_INLINE __mmask8 are_plain(__m256 coordinates) {
  constexpr int kLeast = __builtin_bit_cast(int, kPositionQuantum), kMost = __builtin_bit_cast(int, kLargestCoordinate);
  const __m256i sizes = _mm256_and_si256(_mm256_castps_si256(coordinates), _mm256_set1_epi32(INT32_MAX));
  const __m256i above_least = _mm256_sub_epi32(sizes, _mm256_set1_epi32(kLeast));
  return static_cast<__mmask8>(_mm256_cmple_epu32_mask(above_least, _mm256_set1_epi32(kMost - kLeast)) |
                               _mm256_testn_epi32_mask(sizes, sizes));
}

// As rounding_is_in_doubt (fast/numbers/first_stage.h).
template <int kWindow>
FORCESHADE_INLINE __mmask8 roundings_in_doubt(Pack values) {
  const __m512i moved = _mm512_add_epi64(_mm512_castpd_si512(values.lanes), _mm512_set1_epi64(kTieOffset<kWindow>));
  return _mm512_cmpge_epu64_mask(_mm512_and_si512(moved, _mm512_set1_epi64(kDroppedMask)),
                                 _mm512_set1_epi64(kTieThreshold<kWindow>));
}

// As NearCell, along one axis.
struct NearCells {
  __m256i index;
  Pack t;  // 0 to 1

  FORCESHADE_INLINE NearCells(__m256 coordinates, double centre, const HeightGrid& grid) : t(0) {
    const Pack at = _mm512_cvtps_pd(coordinates), middle(centre), per_pitch(grid.per_pitch()[0]);
    index = _mm512_cvttpd_epi32(multiply_add(at, per_pitch, middle).lanes);
    t = multiply_add(middle - Pack(_mm512_cvtepi32_pd(index)), Pack(grid.pitch()), at) * per_pitch;
  }
};

// The l-th row of eight windows: columns[k][l], one lane a window.
FORCESHADE_INLINE void load_row(const float* row, const int* windows, int l, __m512d columns[4][4]) {
  const auto two = [&](int i) {
    const __m128 here = _mm_loadu_ps(row + windows[i]), there = _mm_loadu_ps(row + windows[i + 4]);
    return _mm256_insertf128_ps(_mm256_castps128_ps256(here), there, 1);
  };
  const __m256 a = two(0), b = two(1), c = two(2), d = two(3);
  const __m256d ab_low = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)), ab_high = _mm256_castps_pd(_mm256_unpackhi_ps(a, b)),
                cd_low = _mm256_castps_pd(_mm256_unpacklo_ps(c, d)), cd_high = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
  const auto to_binary64 = [](__m256d pairs) { return _mm512_cvtps_pd(_mm256_castpd_ps(pairs)); };
  columns[0][l] = to_binary64(_mm256_unpacklo_pd(ab_low, cd_low));
  columns[1][l] = to_binary64(_mm256_unpackhi_pd(ab_low, cd_low));
  columns[2][l] = to_binary64(_mm256_unpacklo_pd(ab_high, cd_high));
  columns[3][l] = to_binary64(_mm256_unpackhi_pd(ab_high, cd_high));
}

unsigned forces(const SplineMap& map, const float* positions, float* to) noexcept {
  const Triples at(positions);
  const HeightGrid& grid = map.grid;
  const NearCells across(at.x, grid.centre()[0], grid), along(at.y, grid.centre()[1], grid);
  const __m256i one = _mm256_set1_epi32(1), left = _mm256_sub_epi32(across.index, one),
                low = _mm256_sub_epi32(along.index, one);
  const auto is_inside =
      static_cast<__mmask8>(_mm256_cmplt_epu32_mask(left, _mm256_set1_epi32(static_cast<int>(grid.inner_columns()))) &
                            _mm256_cmplt_epu32_mask(low, _mm256_set1_epi32(static_cast<int>(grid.inner_rows()))) &
                            are_plain(at.x) & are_plain(at.y) & are_plain(at.z));
  if (is_inside == 0) return 0;           // then there may be no window at all
  alignas(32) int windows[kSplineBatch];  // the first one for lanes without
  const __m256i columns = _mm256_set1_epi32(static_cast<int>(grid.columns()));
  _mm256_store_si256(reinterpret_cast<__m256i*>(windows),
                     _mm256_maskz_add_epi32(is_inside, _mm256_mullo_epi32(low, columns), left));
  __m512d d[4][4];
  for (int l = 0; l < 4; ++l) load_row(grid.values() + l * grid.columns(), windows, l, d);
  const auto coefficient = [&](std::size_t k, std::size_t l) { return Pack(d[k][l]); };
  const auto [rise, Ux, Uy] = SplineJets<Pack>(coefficient, across.t, along.t, grid.per_slope());

  constexpr int kWindow = doubt_window(4 * kErrorBudgetShare);  // from here on as height_force
  const bool is_shaded = map.mode == height::Mode::force_shaded;
  const Pack depth = -Pack(_mm512_cvtps_pd(at.z)), gap = is_shaded ? depth : rise + (coefficient(1, 1) + depth),
             sure_gap(is_shaded ? 0 : map.sure.gap);
  const Pack::Mask is_free = gap <= -sure_gap;
  const Pack::Mask is_deep = (gap >= sure_gap) & (absolute(Ux) >= Pack(map.sure.Ux)) & (absolute(Uy) >= Pack(map.sure.Uy));
  // Over free lanes no depth, for a force of exactly 0.
  const auto [x, y, M] = gap_force(select(is_free, Pack(0), gap), Ux, Uy, map.mode, Pack(map.K));
  const auto doubt = roundings_in_doubt<kWindow>(x) | roundings_in_doubt<kWindow>(y) | roundings_in_doubt<kWindow>(M);
  const auto negated = [](Pack a) { return _mm256_sub_ps(_mm256_setzero_ps(), _mm512_cvtpd_ps(a.lanes)); };
  Triples(negated(x), negated(y), _mm512_cvtpd_ps(M.lanes)).store(to);
  return is_inside & (is_free.bits | (is_deep.bits & ~static_cast<unsigned>(doubt)));
}

const char* fault_here() {
  return arithmetic_fault_here();
}

}  // namespace

const SplineBatchFunctions kAvx512SplineFunctions{&forces, &fault_here};

}  // namespace forceshade::fast
