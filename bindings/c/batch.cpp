// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/batch.h"

#include <cstdint>

#include "bindings/c/parts.h"

namespace forceshade::c {
namespace {

bool is_aligned(const void* pointer) noexcept {
  return reinterpret_cast<std::uintptr_t>(pointer) % alignof(float) == 0;
}

}  // namespace

forceshade_result check(const forceshade_batch* batch) noexcept {
  if (batch == nullptr) return fail(FORCESHADE_NULL_POINTER, "batch is NULL");
  if (batch->size != kWithoutThreads && batch->size < sizeof(forceshade_batch))
    return fail(FORCESHADE_BAD_SIZE, "batch->size: expected sizeof(forceshade_batch)");
  if (batch->count == 0) return FORCESHADE_OK;
  if (batch->positions == nullptr || batch->forces == nullptr)
    return fail(FORCESHADE_NULL_POINTER, "batch->positions or batch->forces is NULL");
  if (!is_aligned(batch->positions) || !is_aligned(batch->forces))
    return fail(FORCESHADE_BAD_SIZE, "batch->positions or batch->forces: expected an address that is a multiple of 4");
  for (const std::ptrdiff_t stride :
       {batch->position_stride, batch->position_component, batch->force_stride, batch->force_component})
    if (!is_stride(stride)) return fail(FORCESHADE_BAD_SIZE, "a stride of the batch: expected a multiple of 4 bytes");
  if (batch->force_component == 0 || (batch->force_stride == 0 && batch->count > 1) ||
      (batch->statuses != nullptr && batch->status_stride == 0 && batch->count > 1))
    return fail(FORCESHADE_BAD_SIZE, "a stride of what is written: expected one that is not 0");
  // The largest offset has to be a ptrdiff_t.
  const auto most = static_cast<std::size_t>(PTRDIFF_MAX / 4);
  for (const std::ptrdiff_t stride : {batch->position_stride, batch->force_stride, batch->status_stride})
    if (stride != 0 && batch->count > most / static_cast<std::size_t>(stride < 0 ? -stride : stride))
      return fail(FORCESHADE_BAD_SIZE, "batch->count: expected fewer than the memory can hold at this stride");
  return FORCESHADE_OK;
}

}  // namespace forceshade::c
