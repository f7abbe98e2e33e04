// SPDX-License-Identifier: BSD-3-Clause
// The batch loop of a spline, compiled with -mavx2 -mfma.

#include "forceshade/fast/height_batch.h"
#include "forceshade/fast/pack_avx2.h"

namespace forceshade::fast {

#include "forceshade/fast/height_batch_loop.inl"

const HeightBlocks kAvx2HeightBlocks = kBlocks;

}  // namespace forceshade::fast
