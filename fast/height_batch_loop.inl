// SPDX-License-Identifier: BSD-3-Clause
// A spline's first stage in vectors, included once by each fast/height_batch_<set>.cpp inside namespace forceshade::fast: what
// fast/height_spline.h and fast/height_force.h do, for a batch with one position a lane, for one position with one row of its
// window a vector. Cells on an edge, or that binary64 misplaces, are left to the scalar call.

namespace {

constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(8 * kLanes)));
using Floats = float __attribute__((vector_size(4 * kLanes)));
using Indices = std::int32_t __attribute__((vector_size(4 * kLanes)));

// g++ takes several instructions to convert vectors; each of these is one.
FORCESHADE_INLINE Lanes to_binary64(Floats a) {
  return _mm256_cvtps_pd(a);
}
FORCESHADE_INLINE Lanes to_binary64(Indices a) {
  return _mm256_cvtepi32_pd(reinterpret_cast<__m128i>(a));
}
FORCESHADE_INLINE Indices towards_zero(Lanes a) {
  return reinterpret_cast<Indices>(_mm256_cvttpd_epi32(a));
}

FORCESHADE_INLINE bool is_plain(float coordinate) {
  const float size = __builtin_fabsf(coordinate);
  return (size <= kLargestCoordinate) && ((size >= kPositionQuantum) || (size == 0));
}

// The l-th row of a window at each of four places, turned: one lane a place, one vector a column.
FORCESHADE_INLINE void load_columns(const float* const from[kLanes], const std::int64_t stride[kLanes], int l, Lanes to[4]) {
  Floats row[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) __builtin_memcpy(&row[i], from[i] + l * stride[i], sizeof row[i]);
  const Floats low01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5),
               high01 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
  const Floats low23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5),
               high23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
  to[0] = to_binary64(__builtin_shufflevector(low01, low23, 0, 1, 4, 5));
  to[1] = to_binary64(__builtin_shufflevector(low01, low23, 2, 3, 6, 7));
  to[2] = to_binary64(__builtin_shufflevector(high01, high23, 0, 1, 4, 5));
  to[3] = to_binary64(__builtin_shufflevector(high01, high23, 2, 3, 6, 7));
}

struct Patches {
  alignas(64) double U[kHeightBlock], Ux[kHeightBlock], Uy[kHeightBlock];
};

// As SplineValues, for kLanes positions from the i-th on.
FORCESHADE_INLINE void evaluate_patches(const HeightGrid& grid, const HeightBlock& positions, std::size_t i, Patches& map,
                                        HeightAnswers& answers) {
  constexpr double kAbove = 0x1p24;
  Floats x_in, y_in;
  __builtin_memcpy(&x_in, positions.x + i, sizeof x_in);
  __builtin_memcpy(&y_in, positions.y + i, sizeof y_in);
  const Lanes x = to_binary64(x_in), y = to_binary64(y_in);
  const Pair64 centre = grid.centre();
  const auto floor_of = [&](const Lanes& coordinate, double middle) {
    return towards_zero(coordinate * grid.per_pitch() + (middle + kAbove)) - static_cast<std::int32_t>(kAbove);
  };
  const Indices column = floor_of(x, centre[0]), row = floor_of(y, centre[1]);
  const Lanes from_x = to_binary64(column) - centre[0], from_y = to_binary64(row) - centre[1];
  const Lanes start_x = from_x * grid.pitch(), start_y = from_y * grid.pitch();
  const Lanes end_x = (from_x + 1) * grid.pitch(), end_y = (from_y + 1) * grid.pitch();
  static constexpr float kNoWindow[16] = {};  // what is read for a cell that is left to the scalar call
  const float* from[kLanes];
  std::int64_t stride[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::int64_t k = column[lane], l = row[lane];
    const bool is_inside = (k >= 1) && (l >= 1) && (k + 2 < grid.columns()) && (l + 2 < grid.rows());
    const bool is_placed =
        (x[lane] >= start_x[lane]) && (x[lane] < end_x[lane]) && (y[lane] >= start_y[lane]) && (y[lane] < end_y[lane]);
    from[lane] = is_inside ? grid.values() + ((l - 1) * grid.columns() + k - 1) : kNoWindow;
    stride[lane] = is_inside ? grid.columns() : 0;
    answers.is_sure[i + lane] = answers.is_sure[i + lane] && is_inside && is_placed;
  }
  Lanes d[4][4];
  for (int l = 0; l < 4; ++l) load_columns(from, stride, l, d[l]);
  const Lanes c = d[1][1];
  for (int l = 0; l < 4; ++l)
    for (int k = 0; k < 4; ++k) d[l][k] = d[l][k] - c;
  const SplineWeights<Lanes> wx((x - start_x) * grid.per_pitch()), wy((y - start_y) * grid.per_pitch());
  Lanes height[4], across[4];
  for (int k = 0; k < 4; ++k) {
    height[k] = (wy.cubic[0] * d[0][k] + wy.cubic[1] * d[1][k]) + (wy.cubic[2] * d[2][k] + wy.cubic[3] * d[3][k]);
    across[k] =
        (wy.quadratic[0] * (d[1][k] - d[0][k]) + wy.quadratic[1] * (d[2][k] - d[1][k])) + wy.quadratic[2] * (d[3][k] - d[2][k]);
  }
  const auto cubic_sum = [&](const Lanes v[4]) {
    return (wx.cubic[0] * v[0] + wx.cubic[2] * v[2]) + (wx.cubic[1] * v[1] + wx.cubic[3] * v[3]);
  };
  const Lanes along = (wx.quadratic[0] * (height[1] - height[0]) + wx.quadratic[2] * (height[3] - height[2])) +
                      wx.quadratic[1] * (height[2] - height[1]);
  const Lanes U = c + cubic_sum(height) * (1.0 / 36), Ux = along * grid.per_twelve_pitches(),
              Uy = cubic_sum(across) * grid.per_twelve_pitches();
  __builtin_memcpy(map.U + i, &U, sizeof U);
  __builtin_memcpy(map.Ux + i, &Ux, sizeof Ux);
  __builtin_memcpy(map.Uy + i, &Uy, sizeof Uy);
}

template <height::Rendering kRendering>
FORCESHADE_INLINE void forces(const Patches& map, const SureSizes& sure, double K, const HeightBlock& positions,
                              HeightAnswers& answers) {
  constexpr int kWindow = doubt_window(0x1p-34);  // as in height_force
  constexpr bool kIsShaded = kRendering == height::Rendering::force_shaded;
  const Pack least_gap(kIsShaded ? 0 : sure.gap);
  alignas(64) double x[kHeightBlock], y[kHeightBlock], M[kHeightBlock], is_clear[kHeightBlock];
  for (std::size_t i = 0; i < kHeightBlock; i += Pack::kLanes) {
    const Pack Ux = Pack::load(map.Ux + i), Uy = Pack::load(map.Uy + i), z = Pack::load(positions.z + i);
    const Pack gap = kIsShaded ? -z : Pack::load(map.U + i) - z;
    Pack magnitude = Pack(K) * gap;
    if constexpr (kRendering != height::Rendering::conservative)
      magnitude = magnitude / square_root(Pack(1) + (Ux * Ux + Uy * Uy));
    magnitude = larger(magnitude, Pack(0));
    magnitude.store(M + i);
    (magnitude * -Ux).store(x + i);
    (magnitude * -Uy).store(y + i);
    const auto is_free = gap <= -least_gap;
    const auto is_deep = (gap >= least_gap) & (absolute(Ux) >= Pack(sure.Ux)) & (absolute(Uy) >= Pack(sure.Uy));
    select(is_free | is_deep, Pack(1), Pack(0)).store(is_clear + i);
  }
  // Apart from the square roots and divisions, as in batch_loop.inl. No contact leaves zeros, which are in no doubt.
  for (std::size_t i = 0; i < kHeightBlock; ++i) {
    const int doubts = static_cast<int>(rounding_is_in_doubt<kWindow>(x[i])) |
                       static_cast<int>(rounding_is_in_doubt<kWindow>(y[i])) |
                       static_cast<int>(rounding_is_in_doubt<kWindow>(M[i]));
    answers.x[i] = static_cast<float>(x[i]) + 0.0F;
    answers.y[i] = static_cast<float>(y[i]) + 0.0F;
    answers.z[i] = static_cast<float>(M[i]) + 0.0F;
    answers.is_sure[i] = answers.is_sure[i] && (is_clear[i] > 0) && (doubts == 0);
  }
}

void answer_block(const HeightGrid& grid, const SureSizes& sure, height::Rendering rendering, double K,
                  const HeightBlock& positions, HeightAnswers& answers) {
  HeightBlock plain;
  for (std::size_t i = 0; i < kHeightBlock; ++i) {
    const bool is_sure = is_plain(positions.x[i]) && is_plain(positions.y[i]) && is_plain(positions.z[i]);
    answers.is_sure[i] = is_sure;
    plain.x[i] = is_sure ? positions.x[i] : 0;
    plain.y[i] = is_sure ? positions.y[i] : 0;
    plain.z[i] = is_sure ? positions.z[i] : 0;
  }
  Patches map;
  for (std::size_t i = 0; i < kHeightBlock; i += kLanes) evaluate_patches(grid, plain, i, map, answers);
  switch (rendering) {
    case height::Rendering::true_height: return forces<height::Rendering::true_height>(map, sure, K, plain, answers);
    case height::Rendering::force_shaded: return forces<height::Rendering::force_shaded>(map, sure, K, plain, answers);
    case height::Rendering::conservative: return forces<height::Rendering::conservative>(map, sure, K, plain, answers);
  }
}

// Lanes 0 and 2, 1 and 3: how a sum begins.
FORCESHADE_INLINE Pair64 halves_of(Lanes a) {
  return __builtin_shufflevector(a, a, 0, 1) + __builtin_shufflevector(a, a, 2, 3);
}

HeightForce answer_one(const HeightGrid& grid, const SureSizes& sure, height::Rendering rendering, double K, float x, float y,
                       float z) {
  constexpr HeightForce kUnknown{0, 0, 0, Sign::unknown};
  if (!is_plain(x) || !is_plain(y) || !is_plain(z)) [[unlikely]]
    return kUnknown;
  const Pair64 at{static_cast<double>(x), static_cast<double>(y)};
  const Pair64 index = _mm_floor_pd(at * grid.per_pitch() + grid.centre());
  const Pair64 past = at - (index - grid.centre()) * grid.pitch();  // mm, into the cell
  const auto k = static_cast<std::int64_t>(index[0]), l = static_cast<std::int64_t>(index[1]), stride = grid.columns();
  const bool is_inside = (k >= 1) && (l >= 1) && (k + 2 < stride) && (l + 2 < grid.rows());
  if (!is_inside || _mm_movemask_pd(reinterpret_cast<__m128d>((past >= 0) & (past < grid.pitch()))) != 3) [[unlikely]]
    return kUnknown;
  const Pair64 t = past * grid.per_pitch();
  const SplineWeights<Lanes> wy(Lanes{} + t[1]);
  const SplineWeights<double> wx(t[0]);
  const Lanes cubic{wx.cubic[0], wx.cubic[1], wx.cubic[2], wx.cubic[3]};
  const Lanes quadratic{wx.quadratic[0], wx.quadratic[1], wx.quadratic[2], 0};
  const float* corner = grid.values() + ((l - 1) * stride + (k - 1));
  const auto c = static_cast<double>(corner[stride + 1]);
  Lanes d[4];
  for (int i = 0; i < 4; ++i) {
    Floats row;
    __builtin_memcpy(&row, corner + i * stride, sizeof row);
    d[i] = to_binary64(row) - c;
  }
  const Lanes height = (wy.cubic[0] * d[0] + wy.cubic[1] * d[1]) + (wy.cubic[2] * d[2] + wy.cubic[3] * d[3]);
  const Lanes across = (wy.quadratic[0] * (d[1] - d[0]) + wy.quadratic[1] * (d[2] - d[1])) + wy.quadratic[2] * (d[3] - d[2]);
  const Pair64 along = halves_of(quadratic * (__builtin_shufflevector(height, height, 1, 2, 3, 3) - height));
  const Pair64 upward = halves_of(cubic * across), terms = halves_of(cubic * height);
  const Pair64 slopes = (Pair64{along[0], upward[0]} + Pair64{along[1], upward[1]}) * grid.per_twelve_pitches();
  return height_force(c + (terms[0] + terms[1]) * (1.0 / 36), slopes[0], slopes[1], sure, rendering, K, static_cast<double>(z));
}

const char* fault_here() {
  return arithmetic_fault_here();
}

constexpr HeightBlocks kBlocks{&answer_block, &answer_one, &fault_here};

}  // namespace
