// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A row of a spline's window in one register of AVX2. For fast/*_avx2.cpp alone.

#include "fast/numbers/row.h"
#include "fast/simd/pack_avx2.h"

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

// The same as Quad (fast/numbers/row.h), in one register and with fused operations.
struct Vector : Pack {
  using Number = double;
  using Two = Pair64;

  using Pack::Pack;
  FORCESHADE_INLINE Vector(Pack a) : Pack(a) {}
  FORCESHADE_INLINE static Pair64 multiply_add_pairs(Pair64 a, Pair64 b, Pair64 c) { return _mm_fmadd_pd(a, b, c); }
};

}  // namespace
}  // namespace forceshade::fast
