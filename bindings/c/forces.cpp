// SPDX-License-Identifier: BSD-3-Clause
// Forces of the C interface, of subjects that remember nothing.

#include <cstdint>
#include <string>

#include "bindings/c/batch.h"
#include "bindings/c/statuses.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

forceshade_result needs_a_session() noexcept {
  return fail(FORCESHADE_WRONG_KIND,
              "the force of a mesh depends on the path; expected forceshade_session_open() and its steps");
}

bool is_aligned(const void* pointer) noexcept {
  return reinterpret_cast<std::uintptr_t>(pointer) % alignof(float) == 0;
}

}  // namespace

forceshade_result check(const forceshade_batch* batch) noexcept {
  if (batch == nullptr) return fail(FORCESHADE_NULL_POINTER, "batch is NULL");
  if (batch->size < sizeof(forceshade_batch))
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

using namespace forceshade;
using namespace forceshade::c;

forceshade_result forceshade_force(forceshade_subject subject, const float* position, float* force, forceshade_status* status) {
  const Subject* const its = subject_of(subject);
  if (its == nullptr) return FORCESHADE_BAD_HANDLE;
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  if (const auto* law = std::get_if<fast::Law>(&its->field)) [[likely]]
    return give(law->evaluate(*as_vectors(position)), force, status);
  if (const auto* map = std::get_if<fast::HeightMapField>(&its->field))
    return give(map->evaluate(*as_vectors(position)), force, status);
  return needs_a_session();
}

forceshade_result forceshade_forces(forceshade_subject subject, const forceshade_batch* batch, size_t* invalid) {
  const Subject* const its = subject_of(subject);
  if (its == nullptr) return FORCESHADE_BAD_HANDLE;
  if (!its->renderer.batch) return needs_a_session();
  if (const forceshade_result wrong = check(batch); wrong != FORCESHADE_OK) return wrong;
  const fast::InstructionSet set = fast::best_instruction_set();
  const std::size_t outside = for_each_block(*batch, [&](auto positions, auto forces, auto statuses) noexcept {
    const std::size_t found = its->renderer.batch(positions, forces, set).invalid;
    if (const auto* law = std::get_if<fast::Law>(&its->field))
      add_statuses(*law, positions, forces, statuses);
    else if (const auto* map = std::get_if<fast::HeightMapField>(&its->field))
      add_statuses(*map, positions, forces, statuses);
    return found;
  });
  if (invalid != nullptr) *invalid = outside;
  return FORCESHADE_OK;
}
