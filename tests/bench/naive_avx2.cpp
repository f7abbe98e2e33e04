// SPDX-License-Identifier: BSD-3-Clause
// The naive loops with the instructions of fast/simd/batch_avx2.cpp.

#include "tests/bench/naive.h"

namespace forceshade::bench {

const NaiveTable kNaiveAvx2 = kNaiveLoops;

}  // namespace forceshade::bench
