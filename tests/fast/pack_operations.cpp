// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fast/pack_operations.h"

#include "fast/numbers/row.h"

namespace forceshade::tests {
namespace {

#include "tests/fast/pack_operations.inl"
#include "tests/fast/row_operations.inl"

}  // namespace

const char* wrong_operation_without_vectors() {
  return wrong_operation_of_row<fast::Quad, false>();
}

}  // namespace forceshade::tests
