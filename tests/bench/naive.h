// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The code that the batch call is compared with: the thesis's formulas (as docs/laws.md corrects them) written in binary32,
// in a plain loop that the compiler turns into vector code. No domain check, no rounding promise: what a haptics programmer
// would have without this library. Included by each tests/bench/naive_<set>.cpp, compiled for the instructions of
// fast/batch_<set>.cpp.

#include <array>
#include <cstddef>

#include "forceshade/law.h"

namespace forceshade::bench {

// Lengths in mm, K in N/mm, angles as their sine and cosine.
struct NaiveBump {
  float R, w, K;
  float d, h;                // the axis' depth below the plane, the height of a two-polygon bump
  float w_top, h_top;        // w′, h′: the flat top of a three-polygon bump
  float sine_2p, cosine_2p;  // normal of a side face, right of x = 0
  float sine_3p, cosine_3p;
};

NaiveBump naive_bump(const Parameters& p);

using NaiveLoop = void (*)(const NaiveBump& bump, std::size_t count, const float* x, const float* z, float* fx, float* fz);
using NaiveTable = std::array<NaiveLoop, kLaws.size()>;  // by LawId

extern const NaiveTable kNaive;  // this machine type's base instructions
extern const NaiveTable kNaiveAvx2;
extern const NaiveTable kNaiveAvx512;

namespace {

struct Force {
  float x, z;
};

struct Cylinder {
  static Force at(const NaiveBump& b, float x, float z) {
    const float l = z + b.d;
    const float rho = __builtin_sqrtf(x * x + l * l);
    const float scale = rho < b.R ? b.K * (b.R - rho) / rho : 0.0F;
    return {scale * x, scale * l};
  }
};

struct Wall {
  static Force at(const NaiveBump& b, float, float z) { return {0.0F, z < 0 ? -b.K * z : 0.0F}; }
};

struct BumpCylinder {
  static Force at(const NaiveBump& b, float x, float z) {
    const Force cylinder = Cylinder::at(b, x, z);
    return {cylinder.x, cylinder.z + Wall::at(b, x, z).z};
  }
};

struct Height1p {
  static float at(const NaiveBump&, float) { return 0.0F; }
};

struct Height2p {
  static float at(const NaiveBump& b, float x) {
    const float size = __builtin_fabsf(x);
    return 2 * size <= b.w ? b.h * (1 - 2 * size / b.w) : 0.0F;
  }
};

struct Height3p {
  static float at(const NaiveBump& b, float x) {
    const float size = __builtin_fabsf(x);
    const float side = b.h_top * (b.w / 2 - size) / (b.w / 2 - b.w_top / 2);
    return 2 * size <= b.w_top ? b.h_top : (2 * size <= b.w ? side : 0.0F);
  }
};

struct Normal1p {
  static Force at(const NaiveBump&, float) { return {0.0F, 1.0F}; }
};

struct Normal2p {
  static Force at(const NaiveBump& b, float x) {
    const bool on_side = 2 * __builtin_fabsf(x) <= b.w;
    return {on_side ? (x >= 0 ? b.sine_2p : -b.sine_2p) : 0.0F, on_side ? b.cosine_2p : 1.0F};
  }
};

struct Normal3p {
  static Force at(const NaiveBump& b, float x) {
    const float size = __builtin_fabsf(x);
    const bool on_side = (2 * size > b.w_top) & (2 * size <= b.w);
    return {on_side ? (x >= 0 ? b.sine_3p : -b.sine_3p) : 0.0F, on_side ? b.cosine_3p : 1.0F};
  }
};

struct ShadedNormal {
  static Force at(const NaiveBump& b, float x) {
    const bool inside = 2 * __builtin_fabsf(x) <= b.w;
    const float sine = x / b.R;
    const float cosine = __builtin_sqrtf(b.R * b.R - x * x) / b.R;
    return {inside ? sine : 0.0F, inside ? cosine : 1.0F};
  }
};

template <class Height, class Normal>
struct Bump {
  static Force at(const NaiveBump& b, float x, float z) {
    const float gap = Height::at(b, x) - z;
    const float magnitude = gap > 0 ? b.K * gap : 0.0F;
    const Force normal = Normal::at(b, x);
    return {magnitude * normal.x, magnitude * normal.z};
  }
};

template <class Law>
void naive_loop(const NaiveBump& bump, std::size_t count, const float* __restrict x, const float* __restrict z,
                float* __restrict fx, float* __restrict fz) {
  const NaiveBump b = bump;  // a copy that the stores below cannot alias
  for (std::size_t i = 0; i < count; ++i) {
    const Force force = Law::at(b, x[i], z[i]);
    fx[i] = force.x;
    fz[i] = force.z;
  }
}

[[maybe_unused]] constexpr NaiveTable kNaiveLoops{
    &naive_loop<Wall>,
    &naive_loop<Cylinder>,
    &naive_loop<BumpCylinder>,
    &naive_loop<Bump<Height1p, Normal1p>>,
    &naive_loop<Bump<Height2p, Normal2p>>,
    &naive_loop<Bump<Height3p, Normal3p>>,
    &naive_loop<Bump<Height1p, ShadedNormal>>,
    &naive_loop<Bump<Height2p, ShadedNormal>>,
    &naive_loop<Bump<Height3p, ShadedNormal>>,
};

}  // namespace
}  // namespace forceshade::bench
