// SPDX-License-Identifier: BSD-3-Clause
// Sessions of the C interface: one path each, for one thread at a time.

#include <memory>

#include "bindings/c/batch.h"
#include "bindings/c/entered.h"
#include "bindings/c/paths.h"
#include "bindings/c/session.h"
#include "bindings/c/states.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

constinit Lasting<Session> sessions;

// Returns OK, or an error code after setting the error text.
forceshade_result check(const forceshade_state* state) noexcept {
  if (state == nullptr) return fail(FORCESHADE_NULL_POINTER, "state is NULL");
  if (state->size < sizeof(forceshade_state))
    return fail(FORCESHADE_BAD_SIZE, "state->size: expected sizeof(forceshade_state)");
  return FORCESHADE_OK;
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
  const std::size_t outside =
      answer_each(*batch, [&](const Eigen::Vector3f& position, std::size_t) noexcept { return entered->step(position); });
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
  put(entered->state(), *state);
  return FORCESHADE_OK;
}

forceshade_result forceshade_session_resume(forceshade_session session, const forceshade_state* state) {
  if (const forceshade_result wrong = check(state); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  if (!is_state(*state)) return fail(FORCESHADE_BAD_VALUE, "state->place or state->side: expected one that a session gives");
  if (!entered->remembers() && state->place != FORCESHADE_NOWHERE)
    return fail(FORCESHADE_WRONG_KIND, "the state is that of a god-object; a law or a height map remembers nothing");
  entered->resume(god_object_of(*state));
  return FORCESHADE_OK;
}

forceshade_result forceshade_advance(forceshade_subject subject, forceshade_state* states, const forceshade_batch* batch,
                                     size_t* invalid) {
  return guarded([&]() -> forceshade_result {
    const Subject* const its = subject_of(subject);
    if (its == nullptr) return bad_subject();
    if (const forceshade_result wrong = check(batch); wrong != FORCESHADE_OK) return wrong;
    if (const forceshade_result wrong = check_arithmetic(); wrong != FORCESHADE_OK) return wrong;
    std::size_t outside = 0;
    if (batch->count > 0) {
      if (const forceshade_result wrong = check(states); wrong != FORCESHADE_OK) return wrong;
      const std::size_t size = states->size;  // of each, in a program that was built with a newer header, too
      outside = advance(*its, *batch, [&](std::size_t i) -> forceshade_state& {
        return *reinterpret_cast<forceshade_state*>(reinterpret_cast<char*>(states) + i * size);
      });
    }
    if (invalid != nullptr) *invalid = outside;
    return FORCESHADE_OK;
  });
}
