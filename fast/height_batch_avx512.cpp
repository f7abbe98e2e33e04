// SPDX-License-Identifier: BSD-3-Clause
// The batch loop of a spline, compiled with -mavx512f -mavx512dq -mavx512vl -mavx512bw.

#include "forceshade/fast/height_batch.h"
#include "forceshade/fast/pack_avx512.h"

namespace forceshade::fast {

#include "forceshade/fast/height_batch_loop.inl"

const HeightBlocks kAvx512HeightBlocks = kBlocks;

}  // namespace forceshade::fast
