// SPDX-License-Identifier: BSD-3-Clause
// Compiled as fast/batch_avx2.cpp is.

#include "forceshade/fast/pack_pair.h"
#include "forceshade/fast/row.h"
#include "forceshade/fast/row_avx2.h"
#include "forceshade/tests/pack_operations.h"

namespace forceshade::tests {
namespace {

using fast::Pair64;

#include "forceshade/tests/pack_operations.inl"

}  // namespace

const char* wrong_operation_avx2() {
  if (const char* wrong = wrong_operation<fast::Pack>()) return wrong;
  if (const char* wrong = wrong_operation<fast::Pair<fast::Pack>>()) return wrong;
  return wrong_operation_of_row<fast::Vector, true>();
}

}  // namespace forceshade::tests
