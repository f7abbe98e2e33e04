// SPDX-License-Identifier: BSD-3-Clause
// Sessions of the C interface: one path each, for one thread at a time.

#include <algorithm>
#include <memory>
#include <string>

#include "bindings/c/batch.h"
#include "bindings/c/session.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

constinit Lasting<Session> sessions;

// A session that this thread alone is in, as long as this lives. Null where it is none or another thread is in it; then
// `result` and the message say which.
class Entered {
 public:
  explicit Entered(forceshade_session handle) noexcept : slot_(sessions.table.slot_of(handle.handle)) {
    if (slot_.handle.load(std::memory_order_acquire) != handle.handle) [[unlikely]] {
      result = no_session();
      return;
    }
    if (slot_.is_busy.exchange(true, std::memory_order_acquire)) [[unlikely]] {
      result = fail(FORCESHADE_BUSY, "another thread is in this session, which is for one at a time");
      return;
    }
    session_ = sessions.table.find(handle.handle);  // it may have been closed before this thread was in it
    if (session_ != nullptr) [[likely]]
      return;
    slot_.is_busy.store(false, std::memory_order_release);
    result = no_session();
  }
  ~Entered() {
    if (session_ != nullptr) slot_.is_busy.store(false, std::memory_order_release);
  }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

  explicit operator bool() const noexcept { return session_ != nullptr; }
  Session& operator*() const noexcept { return *session_; }
  Session* operator->() const noexcept { return session_; }

  forceshade_result result = FORCESHADE_OK;

 private:
  static forceshade_result no_session() noexcept {
    return fail(FORCESHADE_BAD_HANDLE, "the session is none: it was never opened, or has been closed");
  }

  Table<Session>::Slot& slot_;
  Session* session_ = nullptr;
};

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
    if (const char* fault = fast::arithmetic_fault())
      return fail(FORCESHADE_BAD_ARITHMETIC, std::string("found ") + fault + "; expected rounding to nearest, with subnormals");
    const std::uint64_t handle = sessions.table.add(std::make_unique<c::Session>(*its));
    if (handle == 0) return fail(FORCESHADE_NO_MEMORY, "there are too many sessions; expected some to be closed");
    made->handle = handle;
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_session_close(forceshade_session session) {
  return guarded([&]() -> forceshade_result {
    const Entered entered(session);
    if (!entered) return entered.result;
    sessions.table.take(session.handle);
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_session_step(forceshade_session session, const float* position, float* force,
                                          forceshade_status* status) {
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  const Entered entered(session);
  if (!entered) return entered.result;
  return give(entered->step(*as_vectors(position)), force, status);
}

forceshade_result forceshade_session_steps(forceshade_session session, const forceshade_batch* batch, size_t* invalid) {
  if (const forceshade_result wrong = check(batch); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(session);
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
  const Entered entered(session);
  if (!entered) return entered.result;
  entered->resume({});
  return FORCESHADE_OK;
}

forceshade_result forceshade_session_state(forceshade_session session, forceshade_state* state) {
  if (const forceshade_result wrong = check(state); wrong != FORCESHADE_OK) return wrong;
  const Entered entered(session);
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
  const Entered entered(session);
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
