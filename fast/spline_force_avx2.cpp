// SPDX-License-Identifier: BSD-3-Clause
// The first stage of a spline, a row of its window in one register; compiled with -mavx2 -mfma.

#include <immintrin.h>

#include "forceshade/fast/spline_force.h"

namespace forceshade::fast {
namespace {

// As Quad (fast/row.h), in one register and with fused operations.
struct Vector {
  __m256d lanes;

  FORCESHADE_INLINE explicit Vector(double a) : lanes(_mm256_set1_pd(a)) {}
  FORCESHADE_INLINE Vector(__m256d a) : lanes(a) {}
  FORCESHADE_INLINE static Vector load(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }
  FORCESHADE_INLINE static Vector load(const double* from) { return _mm256_load_pd(from); }

  FORCESHADE_INLINE friend Vector operator+(Vector a, Vector b) { return _mm256_add_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Vector operator-(Vector a, Vector b) { return _mm256_sub_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Vector operator*(Vector a, Vector b) { return _mm256_mul_pd(a.lanes, b.lanes); }
  FORCESHADE_INLINE friend Vector multiply_add(Vector a, Vector b, Vector c) {
    return _mm256_fmadd_pd(a.lanes, b.lanes, c.lanes);
  }
  FORCESHADE_INLINE static Pair64 multiply_add_pairs(Pair64 a, Pair64 b, Pair64 c) { return _mm_fmadd_pd(a, b, c); }

  FORCESHADE_INLINE friend double sum(Vector a) {
    const Pair64 two = halves(a.lanes);
    return two[0] + two[1];
  }
  FORCESHADE_INLINE friend Pair64 sums(Vector a, Vector b) { return halves(_mm256_hadd_pd(a.lanes, b.lanes)); }

 private:
  FORCESHADE_INLINE static Pair64 halves(__m256d a) { return _mm256_castpd256_pd128(a) + _mm256_extractf128_pd(a, 1); }
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
