// SPDX-License-Identifier: BSD-3-Clause
// The batch loop, compiled with -mavx512f -mavx512dq -mavx512vl -mavx512bw: eight binary64 numbers at a time.

#include "fast/simd/batch.h"
#include "fast/simd/pack_avx512.h"

// The code made of packs:
#include "fast/simd/form_of.inl"
#include "fast/simd/position_rows_avx2.h"

namespace forceshade::fast {

#include "fast/simd/batch_loop.inl"

const BlockTable kAvx512Blocks = kBlocks;

}  // namespace forceshade::fast
