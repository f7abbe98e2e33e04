// SPDX-License-Identifier: BSD-3-Clause
// Damping of the C interface, behind the forces of any renderer.

#include "bindings/c/damping.h"

#include <cstddef>
#include <variant>

#include "bindings/c/damped.h"

namespace forceshade::c {
namespace {

forceshade_result check_both(const forceshade_batch* batch) noexcept {
  const forceshade_result result = check(batch);
  if (result == FORCESHADE_OK && batch->count > 0 && batch->positions == batch->forces)
    return fail(FORCESHADE_BAD_VALUE,
                "batch->forces is batch->positions; expected the positions beside the forces of a renderer");
  return result;
}

}  // namespace

[[gnu::noinline]] LastDamping& last_damping_of_this_thread() noexcept {
  constinit static thread_local LastDamping last;
  return last;
}

}  // namespace forceshade::c

using namespace forceshade;
using namespace forceshade::c;

forceshade_result forceshade_subject_damping(forceshade_subject subject, float rate, forceshade_damping* damping) {
  return guarded([&]() -> forceshade_result {
    const Subject* const its = subject_of(subject);
    if (its == nullptr) return bad_subject();
    if (damping == nullptr) return fail(FORCESHADE_NULL_POINTER, "damping is NULL");
    if (damping->size < sizeof *damping) return fail(FORCESHADE_BAD_SIZE, "damping->size: expected sizeof(forceshade_damping)");
    const damping::Parameters numbers = its->damping.at(static_cast<double>(rate));
    const auto built = fast::Damping::build(numbers);
    if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
    *damping = {damping->size, numbers.rate, numbers.share, numbers.damping, numbers.most, numbers.drag, numbers.full_at};
    if (!its->limits_damping) return FORCESHADE_OK;
    return fail(FORCESHADE_WRONG_KIND,
                "the subject's materials limit damping, which only forceshade_session_damped_step() and "
                "forceshade_scene_damped_step() see; the damping was written");
  });
}

forceshade_result forceshade_damping_step(const forceshade_damping* damping, forceshade_damping_state* state, uint32_t periods,
                                          const float* position, float* force, forceshade_status* status) {
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  return with_damping(damping, state, [&](LastDamping& its) {
    const Status spring = status == nullptr ? Status::contact : static_cast<Status>(*status);
    // One by one, as they were just stored (give() in batch.h).
    const volatile float* const components = force;
    const fast::Evaluation answer{{float{components[0]}, float{components[1]}, float{components[2]}}, spring};
    return its.tick(*state, periods, position, answer, force, status);
  });
}

forceshade_result forceshade_damping_steps(const forceshade_damping* damping, forceshade_damping_state* state,
                                           const uint32_t* periods, const forceshade_batch* batch, size_t* invalid) {
  if (const forceshade_result wrong = check_both(batch); wrong != FORCESHADE_OK) return wrong;
  return with_damping(damping, state, [&](LastDamping& its) {
    its.resume(*state);
    const std::size_t outside = damp_path(*its.damping, periods, *batch);
    its.leave(*state);
    if (invalid != nullptr) *invalid = outside;
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_damping_advance(const forceshade_damping* damping, forceshade_damping_state* states,
                                             const uint32_t* periods, const forceshade_batch* batch, size_t* invalid) {
  if (const forceshade_result wrong = check_both(batch); wrong != FORCESHADE_OK) return wrong;
  forceshade_damping_state none{};
  none.size = sizeof none;
  if (batch->count == 0) states = &none;
  return with_damping(damping, states, [&](const LastDamping& its) {
    const std::size_t size = states->size;  // of each, in a program that was built with a newer header, too
    const auto state_of = [&](std::size_t i) -> forceshade_damping_state& {
      return *reinterpret_cast<forceshade_damping_state*>(reinterpret_cast<char*>(states) + i * size);
    };
    const std::size_t outside = damp_paths(*its.damping, state_of, periods, *batch);
    if (invalid != nullptr) *invalid = outside;
    return FORCESHADE_OK;
  });
}
