// SPDX-License-Identifier: BSD-3-Clause
// The first stage of a spline, a row of its window in one register; compiled with -mavx2 -mfma.

#include "fast/heights/spline_force.h"
#include "fast/simd/row_avx2.h"

namespace forceshade::fast {
namespace {

Sign force(const SplineMap& map, const float* position, float* to) noexcept {
  return spline_force<Vector>(map, position, to);
}

const char* fault_here() {
  return arithmetic_fault_here();
}

}  // namespace

const SplineFunctions kAvx2SplineFunctions{&force, &fault_here};

}  // namespace forceshade::fast
