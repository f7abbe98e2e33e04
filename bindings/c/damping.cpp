// SPDX-License-Identifier: BSD-3-Clause
// Damping of the C interface, behind the forces of any renderer.

#include "bindings/c/damping.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <variant>

#include "bindings/c/errors.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

constexpr std::size_t kNumbers = sizeof(forceshade_damping) - offsetof(forceshade_damping, rate);

// The last damping of a thread, in the state that it left last: to look at numbers, arithmetic and a state takes as long as a
// tick.
struct Last {
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
};

// Not inline: a shared library finds a variable of the thread by a call, and the compiler would repeat it at each use.
[[gnu::noinline]] Last& last_of_this_thread() noexcept {
  constinit static thread_local Last last;
  return last;
}

// Returns what use(last) does, with this damping in it, or an error code after setting the error text.
template <class Use>
forceshade_result with_damping(const forceshade_damping* damping, forceshade_damping_state* states, const Use& use) noexcept {
  return guarded([&]() -> forceshade_result {
    if (damping == nullptr || states == nullptr) return fail(FORCESHADE_NULL_POINTER, "damping or its state is NULL");
    if (damping->size < sizeof *damping) return fail(FORCESHADE_BAD_SIZE, "damping->size: expected sizeof(forceshade_damping)");
    if (states->size < sizeof *states)
      return fail(FORCESHADE_BAD_SIZE, "state->size: expected sizeof(forceshade_damping_state)");
    Last& last = last_of_this_thread();
    if (!last.damping || std::memcmp(&damping->rate, &last.numbers.rate, kNumbers) != 0) {
      const auto built = fast::Damping::build(
          {damping->rate, damping->share, damping->damping, damping->most, damping->drag, damping->full_at});
      if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
      last = {std::get<fast::Damping>(built), *damping, {}};
    }
    return use(last);
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

forceshade_result forceshade_subject_damping(forceshade_subject subject, float rate, forceshade_damping* damping) {
  return guarded([&]() -> forceshade_result {
    const Subject* const its = subject_of(subject);
    if (its == nullptr) return bad_subject();
    if (damping == nullptr) return fail(FORCESHADE_NULL_POINTER, "damping is NULL");
    if (damping->size < sizeof *damping) return fail(FORCESHADE_BAD_SIZE, "damping->size: expected sizeof(forceshade_damping)");
    if (its->limits_damping)
      return fail(FORCESHADE_WRONG_KIND, "the subject's materials limit damping, which the functions of damping do not see");
    const damping::Parameters numbers = its->damping.at(static_cast<double>(rate));
    const auto built = fast::Damping::build(numbers);
    if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
    *damping = {damping->size, numbers.rate, numbers.share, numbers.damping, numbers.most, numbers.drag, numbers.full_at};
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_damping_step(const forceshade_damping* damping, forceshade_damping_state* state, uint32_t periods,
                                          const float* position, float* force, forceshade_status* status) {
  if (position == nullptr || force == nullptr) return fail(FORCESHADE_NULL_POINTER, "position or force is NULL");
  return with_damping(damping, state, [&](Last& its) {
    const Status spring = status == nullptr ? Status::contact : static_cast<Status>(*status);
    its.resume(*state);
    // One by one, as they were just stored (give() in batch.h).
    const volatile float* const components = force;
    const fast::Evaluation answer{{float{components[0]}, float{components[1]}, float{components[2]}}, spring};
    const fast::Evaluation damped = its.damping->tick(*as_vectors(position), periods, answer);
    its.leave(*state);
    return give(damped, force, status);
  });
}

forceshade_result forceshade_damping_steps(const forceshade_damping* damping, forceshade_damping_state* state,
                                           const uint32_t* periods, const forceshade_batch* batch, size_t* invalid) {
  if (const forceshade_result wrong = check_both(batch); wrong != FORCESHADE_OK) return wrong;
  return with_damping(damping, state, [&](Last& its) {
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
  return with_damping(damping, states, [&](const Last& its) {
    const std::size_t size = states->size;  // of each, in a program that was built with a newer header, too
    const auto state_of = [&](std::size_t i) -> forceshade_damping_state& {
      return *reinterpret_cast<forceshade_damping_state*>(reinterpret_cast<char*>(states) + i * size);
    };
    const std::size_t outside = damp_paths(*its.damping, state_of, periods, *batch);
    if (invalid != nullptr) *invalid = outside;
    return FORCESHADE_OK;
  });
}
