// SPDX-License-Identifier: BSD-3-Clause
// Damping of the C interface, behind the forces of any renderer.

#include "bindings/c/damping.h"

#include <optional>
#include <variant>

#include "bindings/c/errors.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

// The last one that this thread has built: to look at the numbers and at the arithmetic takes longer than a tick.
constinit thread_local std::optional<fast::Damping> built_last;

// Returns what use(damping) does, or an error code after setting the error text.
template <class Use>
forceshade_result with_damping(const forceshade_damping* damping, forceshade_damping_state* states, const Use& use) noexcept {
  return guarded([&]() -> forceshade_result {
    if (damping == nullptr || states == nullptr) return fail(FORCESHADE_NULL_POINTER, "damping or its state is NULL");
    if (damping->size < sizeof *damping) return fail(FORCESHADE_BAD_SIZE, "damping->size: expected sizeof(forceshade_damping)");
    if (states->size < sizeof *states)
      return fail(FORCESHADE_BAD_SIZE, "state->size: expected sizeof(forceshade_damping_state)");
    const damping::Parameters numbers{damping->rate, damping->share, damping->damping,
                                      damping->most, damping->drag,  damping->full_at};
    if (!built_last || built_last->parameters() != numbers) {
      const auto built = fast::Damping::build(numbers);
      if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
      built_last = std::get<fast::Damping>(built);
    }
    return use(*built_last);
  });
}

forceshade_result check_both(const forceshade_batch* batch) noexcept {
  const forceshade_result result = check(batch);
  if (result == FORCESHADE_OK && batch->count > 0 && batch->positions == batch->forces)
    return fail(FORCESHADE_BAD_VALUE,
                "batch->forces is batch->positions; expected the positions beside the forces of a renderer");
  return result;
}

}  // namespace
}  // namespace forceshade::c

using namespace forceshade;
using namespace forceshade::c;

forceshade_result forceshade_damping_step(const forceshade_damping* damping, forceshade_damping_state* state, uint32_t periods,
                                          const float* position, float* force, forceshade_status* status) {
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  return with_damping(damping, state, [&](fast::Damping& its) {
    const Status spring = status == nullptr ? Status::contact : static_cast<Status>(*status);
    its.resume(damping_state_of(*state));
    const fast::Evaluation damped = its.tick(*as_vectors(position), periods, {*as_vectors(force), spring});
    put(its.state(), *state);
    return give(damped, force, status);
  });
}

forceshade_result forceshade_damping_steps(const forceshade_damping* damping, forceshade_damping_state* state,
                                           const uint32_t* periods, const forceshade_batch* batch, size_t* invalid) {
  if (const forceshade_result wrong = check_both(batch); wrong != FORCESHADE_OK) return wrong;
  return with_damping(damping, state, [&](fast::Damping& its) {
    its.resume(damping_state_of(*state));
    const std::size_t outside = damp_path(its, periods, *batch);
    put(its.state(), *state);
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
  return with_damping(damping, states, [&](fast::Damping& its) {
    const std::size_t size = states->size;  // of each, in a program that was built with a newer header, too
    const auto state_of = [&](std::size_t i) -> forceshade_damping_state& {
      return *reinterpret_cast<forceshade_damping_state*>(reinterpret_cast<char*>(states) + i * size);
    };
    const std::size_t outside = damp_paths(its, state_of, periods, *batch);
    if (invalid != nullptr) *invalid = outside;
    return FORCESHADE_OK;
  });
}
