// SPDX-License-Identifier: BSD-3-Clause
// The first stage of a spline, a row of its window in one register; compiled with -mavx2 -mfma.

#include "forceshade/fast/pack_avx2.h"
#include "forceshade/fast/spline_force.h"

namespace forceshade::fast {
namespace {

FORCESHADE_INLINE Pair64 halves(Pack a) {
  return _mm256_castpd256_pd128(a.lanes) + _mm256_extractf128_pd(a.lanes, 1);
}
FORCESHADE_INLINE double sum(Pack a) {
  const Pair64 two = halves(a);
  return two[0] + two[1];
}
FORCESHADE_INLINE Pair64 sums(Pack a, Pack b) {
  return halves(_mm256_hadd_pd(a.lanes, b.lanes));
}

// As Quad (fast/row.h), in one register and with fused operations.
struct Vector : Pack {
  using Pack::Pack;
  FORCESHADE_INLINE Vector(Pack a) : Pack(a) {}
  FORCESHADE_INLINE static Pair64 multiply_add_pairs(Pair64 a, Pair64 b, Pair64 c) { return _mm_fmadd_pd(a, b, c); }
};

Sign force(const SplineMap& map, const float* position, float* to) noexcept {
  return spline_force<Vector>(map, position, to);
}

const char* fault_here() {
  return arithmetic_fault_here();
}

}  // namespace

const SplineFunctions kAvx2SplineFunctions{&force, &fault_here};

}  // namespace forceshade::fast
