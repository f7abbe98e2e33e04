// SPDX-License-Identifier: BSD-3-Clause
// Sessions of the C interface: one path each, for one thread at a time.

#include <algorithm>
#include <memory>
#include <string>

#include "bindings/c/batch.h"
#include "bindings/c/entered.h"
#include "bindings/c/session.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

constinit Lasting<Session> sessions;

// OK, or what is wrong with the struct, which has been said.
forceshade_result check(const forceshade_state* state) noexcept {
  if (state == nullptr) return fail(FORCESHADE_NULL_POINTER, "state is NULL");
  if (state->size < sizeof(forceshade_state))
    return fail(FORCESHADE_BAD_SIZE, "state->size: expected sizeof(forceshade_state)");
  return FORCESHADE_OK;
}

// Whether a state can be one of any mesh; the session looks whether it is one of its own.
bool is_state(const forceshade_state& state) noexcept {
  return state.place <= FORCESHADE_IN_TRIANGLE && state.side <= 1;
}

}  // namespace
}  // namespace forceshade::c

using namespace forceshade;
using namespace forceshade::c;

forceshade_result forceshade_session_open(forceshade_subject subject, forceshade_session* made) {
  return guarded([&]() -> forceshade_result {
    const Subject* const its = subject_of(subject);
    if (its == nullptr) return bad_subject();
    if (made == nullptr) return fail(FORCESHADE_NULL_POINTER, "made is NULL");
    return open(
        sessions.table, [&] { return std::make_unique<c::Session>(*its); }, made->handle);
  });
}

forceshade_result forceshade_session_close(forceshade_session session) {
  return guarded([&]() -> forceshade_result {
    const Entered entered(sessions.table, session.handle);
    if (!entered) return entered.result;
    sessions.table.take(session.handle);
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_session_step(forceshade_session session, const float* position, float* force,
                                          forceshade_status* status) {
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  return give(entered->step(*as_vectors(position)), force, status);
}

forceshade_result forceshade_session_steps(forceshade_session session, const forceshade_batch* batch, size_t* invalid) {
  if (const forceshade_result wrong = check(batch); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  const std::size_t outside = for_each_block(*batch, [&](auto positions, auto forces, auto statuses) noexcept {
    std::size_t found = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const fast::Evaluation answer = entered->step(positions[i]);
      forces[i] = answer.force;
      found += answer.status == Status::invalid ? 1 : 0;
      if (!statuses.empty()) statuses[i] = status_of(answer);
    }
    return found;
  });
  if (invalid != nullptr) *invalid = outside;
  return FORCESHADE_OK;
}

forceshade_result forceshade_session_reset(forceshade_session session) {
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  entered->resume({});
  return FORCESHADE_OK;
}

forceshade_result forceshade_session_state(forceshade_session session, forceshade_state* state) {
  if (const forceshade_result wrong = check(state); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  const mesh::GodObject& its = entered->state();
  state->place = static_cast<std::uint8_t>(its.place);
  state->side = static_cast<std::uint8_t>(its.side);
  state->slipping = its.is_slipping ? 1 : 0;
  std::copy(its.position.begin(), its.position.end(), state->position);
  std::copy(its.index.begin(), its.index.end(), state->index);
  std::copy(its.parameter.begin(), its.parameter.end(), state->parameter);
  return FORCESHADE_OK;
}

forceshade_result forceshade_session_resume(forceshade_session session, const forceshade_state* state) {
  if (const forceshade_result wrong = check(state); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  if (!is_state(*state)) return fail(FORCESHADE_BAD_VALUE, "state->place or state->side: expected one that a session gives");
  if (!entered->remembers() && state->place != FORCESHADE_NOWHERE)
    return fail(FORCESHADE_WRONG_KIND, "the state is that of a god-object; a law or a height map remembers nothing");
  mesh::GodObject its{.place = static_cast<mesh::Place>(state->place),
                      .side = static_cast<mesh::Side>(state->side),
                      .is_slipping = state->slipping == 1};
  std::copy_n(state->position, 3, its.position.begin());
  std::copy_n(state->index, 2, its.index.begin());
  std::copy_n(state->parameter, 2, its.parameter.begin());
  entered->resume(its);
  return FORCESHADE_OK;
}
