// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Damping of the C interface behind one answer of a renderer.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <variant>

#include "bindings/c/batch.h"
#include "bindings/c/damping.h"
#include "bindings/c/errors.h"
#include "bindings/c/subject.h"

namespace forceshade::c {

// The last damping of a thread, in the state that it left last: to look at numbers, arithmetic and a state takes as long as a
// tick.
struct LastDamping {
  std::optional<fast::Damping> damping;
  forceshade_damping numbers{};
  forceshade_damping_state left{};  // 0: of a beginning

  void resume(const forceshade_damping_state& from) noexcept {
    // In the pieces that leave() stores: a load across two of them would wait for both.
    const bool is_same = from.has_position == left.has_position && from.periods == left.periods &&
                         std::memcmp(from.position, left.position, sizeof left.position) == 0 &&
                         std::memcmp(from.velocity, left.velocity, sizeof left.velocity) == 0;
    if (!is_same) damping->resume(damping_state_of(from));
  }
  // Two times from the numbers: a copy of what was just stored would wait for it.
  void leave(forceshade_damping_state& state) noexcept {
    const damping::State its = damping->state();
    put(its, state);
    put(its, left);
  }
  // Gives the damped answer, and leaves the state that it has then.
  forceshade_result tick(forceshade_damping_state& state, std::uint32_t periods, const float* position,
                         const fast::Evaluation& answer, float* force, forceshade_status* status) noexcept {
    resume(state);
    const fast::Evaluation damped = damping->tick(*as_vectors(position), periods, answer);
    leave(state);
    return give(damped, force, status);
  }
};

// Not inline: a shared library finds a variable of the thread by a call, and the compiler would repeat it at each use.
LastDamping& last_damping_of_this_thread() noexcept;

// Returns what use(last) does, with this damping in it, or an error code after setting the error text.
template <class Use>
forceshade_result with_damping(const forceshade_damping* damping, forceshade_damping_state* states, const Use& use) noexcept {
  constexpr std::size_t kNumbers = sizeof(forceshade_damping) - offsetof(forceshade_damping, rate);
  return guarded([&]() -> forceshade_result {
    if (damping == nullptr || states == nullptr) return fail(FORCESHADE_NULL_POINTER, "damping or its state is NULL");
    if (damping->size < sizeof *damping) return fail(FORCESHADE_BAD_SIZE, "damping->size: expected sizeof(forceshade_damping)");
    if (states->size < sizeof *states)
      return fail(FORCESHADE_BAD_SIZE, "state->size: expected sizeof(forceshade_damping_state)");
    LastDamping& last = last_damping_of_this_thread();
    if (!last.damping || std::memcmp(&damping->rate, &last.numbers.rate, kNumbers) != 0) {
      const auto built = fast::Damping::build(
          {damping->rate, damping->share, damping->damping, damping->most, damping->drag, damping->full_at});
      if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
      last = {std::get<fast::Damping>(built), *damping, {}};
    }
    return use(last);
  });
}

}  // namespace forceshade::c
