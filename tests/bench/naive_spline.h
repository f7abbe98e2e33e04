// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The B-spline as one would write it in binary32 without a thought of its errors.

namespace forceshade::bench {

struct NaiveSpline {
  const float* coefficients;
  int samples;  // in each direction
  float pitch, K;
};

struct NaiveForce {
  float x, y, z;
};

NaiveForce naive_force(const NaiveSpline& spline, float x, float y, float z);

}  // namespace forceshade::bench
