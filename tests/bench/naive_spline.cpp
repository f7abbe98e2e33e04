// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/naive_spline.h"

namespace forceshade::bench {
namespace {

struct Basis {
  float value[4], slope[4];
};

Basis basis(float t) {
  const float s = 1 - t;
  return {{s * s * s * (1 / 6.0F), (3 * t * t * t - 6 * t * t + 4) * (1 / 6.0F), (3 * s * s * s - 6 * s * s + 4) * (1 / 6.0F),
           t * t * t * (1 / 6.0F)},
          {s * s * -0.5F, (3 * t * t - 4 * t) * 0.5F, (-3 * t * t + 2 * t + 1) * 0.5F, t * t * 0.5F}};
}

}  // namespace

NaiveForce naive_force(const NaiveSpline& spline, float x, float y, float z) {
  const float per_pitch = 1 / spline.pitch, centre = 0.5F * static_cast<float>(spline.samples - 1);
  const float column = x * per_pitch + centre, row = y * per_pitch + centre;
  const int i = static_cast<int>(column), j = static_cast<int>(row);
  if (i < 1 || j < 1 || i + 2 >= spline.samples || j + 2 >= spline.samples) return {0, 0, 0};
  const Basis bx = basis(column - static_cast<float>(i)), by = basis(row - static_cast<float>(j));
  float U = 0, Ux = 0, Uy = 0;
  for (int l = 0; l < 4; ++l) {
    const float* c = spline.coefficients + (j - 1 + l) * spline.samples + i - 1;
    float value = 0, slope = 0;
    for (int k = 0; k < 4; ++k) {
      value += bx.value[k] * c[k];
      slope += bx.slope[k] * c[k];
    }
    U += by.value[l] * value;
    Ux += by.value[l] * slope;
    Uy += by.slope[l] * value;
  }
  Ux *= per_pitch;
  Uy *= per_pitch;
  const float gap = U - z;
  if (!(gap > 0)) return {0, 0, 0};
  const float M = spline.K * gap / __builtin_sqrtf(1 + Ux * Ux + Uy * Uy);
  return {-M * Ux, -M * Uy, M};
}

}  // namespace forceshade::bench
