// SPDX-License-Identifier: BSD-3-Clause
// Sessions of the C interface: one path each, for one thread at a time.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "bindings/c/batch.h"
#include "bindings/c/damped.h"
#include "bindings/c/entered.h"
#include "bindings/c/paths.h"
#include "bindings/c/session.h"
#include "bindings/c/states.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

constinit Lasting<Session> sessions;

// The struct of programs that were built before any set of triangles was taken.
struct FormerState {
  std::size_t size;
  std::uint8_t place, side, slipping;
  float position[3];
  std::uint32_t index[2], parameter[2];
};
static_assert(sizeof(FormerState) == offsetof(forceshade_state, meeting) &&
              offsetof(FormerState, parameter) == offsetof(forceshade_state, parameter));

// Returns OK, or an error code after setting the error text. is_regular: of the subject, which any struct can have states of.
forceshade_result check(const forceshade_state* state, bool is_regular) noexcept {
  if (state == nullptr) return fail(FORCESHADE_NULL_POINTER, "state is NULL");
  if (state->size >= sizeof(forceshade_state)) return FORCESHADE_OK;
  if (state->size != sizeof(FormerState)) return fail(FORCESHADE_BAD_SIZE, "state->size: expected sizeof(forceshade_state)");
  if (is_regular) return FORCESHADE_OK;
  return fail(FORCESHADE_BAD_SIZE,
              "state->size: expected sizeof(forceshade_state) of this version for a mesh that is not regular, since its states "
              "have the name of a cell");
}

// use(state), as the struct that the program has.
template <class State, class Use>
auto as_known(State& state, const Use& use) {
  using Former = std::conditional_t<std::is_const_v<State>, const FormerState, FormerState>;
  return state.size == sizeof(FormerState) ? use(reinterpret_cast<Former&>(state)) : use(state);
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

forceshade_result forceshade_session_damped_step(forceshade_session session, const forceshade_damping* damping,
                                                 forceshade_damping_state* state, uint32_t periods, const float* position,
                                                 float* force, forceshade_status* status) {
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  return with_damping(damping, state, [&](LastDamping& its) {
    const Entered entered(sessions.table, session.handle);
    if (!entered) return entered.result;
    return its.tick(*state, periods, position, entered->step(*as_vectors(position)), force, status);
  });
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
  if (const forceshade_result wrong = check(state, true); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  if (const forceshade_result wrong = check(state, entered->is_regular()); wrong != FORCESHADE_OK) return wrong;
  as_known(*state, [&](auto& its) { put(entered->state(), its); });
  return FORCESHADE_OK;
}

forceshade_result forceshade_session_resume(forceshade_session session, const forceshade_state* state) {
  if (const forceshade_result wrong = check(state, true); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(sessions.table, session.handle);
  if (!entered) return entered.result;
  if (const forceshade_result wrong = check(state, entered->is_regular()); wrong != FORCESHADE_OK) return wrong;
  return as_known(*state, [&](const auto& its) {
    if (!is_state(its))
      return fail(FORCESHADE_BAD_VALUE, "state->place, state->side or state->meeting: expected those that a session gives");
    if (!entered->remembers() && its.place != FORCESHADE_NOWHERE)
      return fail(FORCESHADE_WRONG_KIND, "the state is that of a god-object; a law or a height map remembers nothing");
    entered->resume(god_object_of(its));
    return forceshade_result{FORCESHADE_OK};
  });
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
      if (const forceshade_result wrong = check(states, its->is_regular); wrong != FORCESHADE_OK) return wrong;
      const std::size_t size = states->size;  // of each, in a program that was built with a newer header, too
      outside = as_known(*states, [&]<class State>(State& first) {
        return advance(*its, *batch, [&](std::size_t i) -> State& {
          return *reinterpret_cast<State*>(reinterpret_cast<char*>(&first) + i * size);
        });
      });
    }
    if (invalid != nullptr) *invalid = outside;
    return FORCESHADE_OK;
  });
}
