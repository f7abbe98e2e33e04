// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that the numbers side by side in fast/ do, in each lane, the operations that tests/fast/recorded_number.h writes down:
// one file per instruction set.

namespace forceshade::tests {

// The first operation found that does not; null if all do.
const char* wrong_operation_without_vectors();
const char* wrong_operation_avx2();
const char* wrong_operation_avx512();

}  // namespace forceshade::tests
