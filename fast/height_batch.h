// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vector side of a height map's batch call: per instruction set one table, exported by fast/height_batch_<set>.cpp.

#include "forceshade/fast/arithmetic.h"
#include "forceshade/fast/height_force.h"
#include "forceshade/fast/height_spline.h"

namespace forceshade::fast {

inline constexpr std::size_t kHeightBlock = 128;

struct HeightBlock {
  float x[kHeightBlock], y[kHeightBlock], z[kHeightBlock];
};

struct HeightAnswers {
  float x[kHeightBlock], y[kHeightBlock], z[kHeightBlock];  // N, where sure
  bool is_sure[kHeightBlock];                               // else the scalar call must answer
};

struct HeightBlocks {
  // A spline's first stage at every position of a block. K: N/mm.
  void (*answer)(const HeightGrid& grid, const SureSizes& sure, height::Rendering rendering, double K,
                 const HeightBlock& positions, HeightAnswers& answers);
  // The same at one position, mm, in a tick of its own: unknown where stages without vectors must answer.
  HeightForce (*answer_one)(const HeightGrid& grid, const SureSizes& sure, height::Rendering rendering, double K, float x,
                            float y, float z);
  const char* (*arithmetic_fault_here)();
};

extern const HeightBlocks kAvx2HeightBlocks;
extern const HeightBlocks kAvx512HeightBlocks;

}  // namespace forceshade::fast
