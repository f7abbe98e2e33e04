// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The batch's form of the wall (fast/simd/form.inl): the binary32 product of two binary32 numbers is the force, rounded.

#include "fast/laws/wall.h"
#include "fast/simd/form.inl"

namespace forceshade::fast {
namespace {

struct WallForm {
  Floats minus_K;

  explicit WallForm(double K) : minus_K(-K) {}
  explicit WallForm(const Wall& law) : WallForm(law.K) {}

  FORCESHADE_INLINE Floats force_z(Floats z) const { return larger(minus_K * z, Floats(0.0F)); }
};

bool answer(const WallForm& wall, std::size_t count, const float* x, const float* z, float* fx, float* fz) {
  Watch watch;
#pragma GCC unroll 4  // the loop is so short that its own instructions count
  for (std::size_t i = 0; i < count; i += Floats::kLanes) {
    const Floats at_z = Floats::load(z + i), size_of_z = absolute(at_z);
    watch.domain(absolute(Floats::load(x + i)), size_of_z);
    watch.tiny(size_of_z);
    Floats(0.0F).store(fx + i);
    wall.force_z(at_z).store(fz + i);
  }
  return watch.is_free_of_hazards<0>(kPositionQuantum, 0);
}

}  // namespace
}  // namespace forceshade::fast
