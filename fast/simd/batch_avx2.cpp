// SPDX-License-Identifier: BSD-3-Clause
// The batch loop, compiled with -mavx2 -mfma: four binary64 numbers at a time.

#include "fast/simd/batch.h"
#include "fast/simd/pack_avx2.h"

// The code made of packs:
#include "fast/simd/form_of.inl"
#include "fast/simd/position_rows_avx2.h"

namespace forceshade::fast {

#include "fast/simd/batch_loop.inl"

const BlockTable kAvx2Blocks = kBlocks;

}  // namespace forceshade::fast
