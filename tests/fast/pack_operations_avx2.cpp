// SPDX-License-Identifier: BSD-3-Clause
// Compiled as fast/simd/batch_avx2.cpp is.

#include "fast/numbers/row.h"
#include "fast/simd/pack_pair.h"
#include "fast/simd/row_avx2.h"
#include "tests/fast/pack_operations.h"

namespace forceshade::tests {
namespace {

#include "tests/fast/pack_operations.inl"
#include "tests/fast/row_operations.inl"

}  // namespace

const char* wrong_operation_avx2() {
  if (const char* wrong = wrong_operation<fast::Pack>()) return wrong;
  if (const char* wrong = wrong_operation_of_floats<fast::Floats, fast::Pack>()) return wrong;
  if (const char* wrong = wrong_watch<fast::Watch, fast::Floats, fast::Pack>()) return wrong;
  if (const char* wrong = wrong_operation<fast::Pair<fast::Pack>>()) return wrong;
  return wrong_operation_of_row<fast::Vector, true>();
}

}  // namespace forceshade::tests
