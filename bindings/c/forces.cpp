// SPDX-License-Identifier: BSD-3-Clause
// Forces of the C interface, of subjects that remember nothing.

#include "bindings/c/forces.h"

#include "bindings/c/batch.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

forceshade_result needs_a_session() noexcept {
  return fail(FORCESHADE_WRONG_KIND,
              "the force of a mesh depends on the path; expected forceshade_session_open() and its steps");
}

// Kept out of line, so that the call of a law makes room on the stack for what a law needs alone.
[[gnu::noinline]] forceshade_result force_on_map(const fast::HeightMapField& map, const float* position, float* force,
                                                 forceshade_status* status) noexcept {
  return give(map.evaluate(*as_vectors(position)), force, status);
}

}  // namespace
}  // namespace forceshade::c

using namespace forceshade;
using namespace forceshade::c;

forceshade_result forceshade_force(forceshade_subject subject, const float* position, float* force, forceshade_status* status) {
  const Subject* const its = subject_of(subject);
  if (its == nullptr) return bad_subject();
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  if (const auto* law = std::get_if<fast::Law>(&its->field)) [[likely]]
    return give(law->evaluate(*as_vectors(position)), force, status);
  if (const auto* map = std::get_if<fast::HeightMapField>(&its->field)) return force_on_map(*map, position, force, status);
  return needs_a_session();
}

forceshade_result forceshade_forces(forceshade_subject subject, const forceshade_batch* batch, size_t* invalid) {
  const Subject* const its = subject_of(subject);
  if (its == nullptr) return bad_subject();
  if (!its->renderer.batch) return needs_a_session();
  if (const forceshade_result wrong = check(batch); wrong != FORCESHADE_OK) return wrong;
  const std::size_t outside = forces_of(*its, *batch);
  if (invalid != nullptr) *invalid = outside;
  return FORCESHADE_OK;
}
