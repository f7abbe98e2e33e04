// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Damping behind the forces of a batch, which it takes the place of.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "bindings/c/batch.h"
#include "bindings/c/parts.h"
#include "bindings/c/strided.h"
#include "forceshade/fast.h"

namespace forceshade::c {

// State: the struct of the C interface, or another one with members of the same names. One that no tick leaves counts as that
// of a beginning.
template <class State>
damping::State damping_state_of(const State& state) noexcept {
  damping::State its{.has_position = state.has_position != 0, .periods = state.periods};
  std::copy_n(state.position, 3, its.position.begin());
  std::copy_n(state.velocity, 3, its.velocity.begin());
  return its;
}

template <class State>
void put(const damping::State& its, State& state) noexcept {
  state.has_position = its.has_position ? 1 : 0;
  state.periods = its.periods;
  std::copy(its.position.begin(), its.position.end(), state.position);
  std::copy(its.velocity.begin(), its.velocity.end(), state.velocity);
}

// tick(index, position, periods, spring) for one position after the other. Returns how many of its answers were invalid.
template <class Tick>
std::size_t damp_each(const forceshade_batch& batch, const std::uint32_t* periods, const Tick& tick) {
  std::size_t invalid = 0;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const auto position = [&](std::size_t axis) {
      return *at(batch.positions, i, batch.position_stride, axis, batch.position_component);
    };
    const auto force = [&](std::size_t axis) -> float& {
      return *at(batch.forces, i, batch.force_stride, axis, batch.force_component);
    };
    forceshade_status* const status = batch.statuses == nullptr ? nullptr : at(batch.statuses, i, batch.status_stride);
    const fast::Evaluation spring{{force(0), force(1), force(2)},
                                  status == nullptr ? Status::contact : static_cast<Status>(*status)};
    const fast::Evaluation damped =
        tick(i, Eigen::Vector3f(position(0), position(1), position(2)), periods == nullptr ? 1 : periods[i], spring);
    for (std::size_t axis = 0; axis < 3; ++axis) force(axis) = damped.force(static_cast<Eigen::Index>(axis));
    if (status != nullptr) *status = status_of(damped.status);
    invalid += damped.status == Status::invalid ? 1 : 0;
  }
  return invalid;
}

// The next positions of one path.
inline std::size_t damp_path(fast::Damping& damping, const std::uint32_t* periods, const forceshade_batch& batch) noexcept {
  return damp_each(batch, periods, [&](std::size_t, const auto& position, std::uint32_t since, const auto& spring) noexcept {
    return damping.tick(position, since, spring);
  });
}

// One tick of each of many paths; state_of(i): a reference to a state.
template <class StateOf>
std::size_t damp_paths(const fast::Damping& damping, const StateOf& state_of, const std::uint32_t* periods,
                       const forceshade_batch& batch) noexcept {
  return in_parts(batch, [&](const forceshade_batch& part, std::size_t begin) noexcept {
    fast::Damping one = damping;
    const auto tick = [&](std::size_t i, const auto& position, std::uint32_t since, const auto& spring) noexcept {
      auto& state = state_of(begin + i);
      one.resume(damping_state_of(state));
      const fast::Evaluation damped = one.tick(position, since, spring);
      put(one.state(), state);
      return damped;
    };
    return damp_each(part, periods == nullptr ? nullptr : periods + begin, tick);
  });
}

}  // namespace forceshade::c
