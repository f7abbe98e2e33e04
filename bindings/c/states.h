// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The memory of a session, as a struct of numbers: that of the C interface, and others with members of the same names.

#include <algorithm>
#include <array>
#include <cstdint>

#include "forceshade/mesh.h"

namespace forceshade::c {

// True for a struct that also has states on meshes that are not regular.
template <class State>
concept HasCells = requires(const State& state) {
  state.meeting;
};

// True if the state can be one of any mesh; the session checks whether it is one of its own.
template <class State>
bool is_state(const State& state) noexcept {
  if (state.place >= mesh::kPlaceNames.size() || state.side > 1) return false;
  if constexpr (HasCells<State>) {
    // In the order of mesh::Meeting, from the first that is one.
    constexpr std::array kPlaces{mesh::Place::triangle, mesh::Place::edge, mesh::Place::edge,    mesh::Place::triangle,
                                 mesh::Place::triangle, mesh::Place::edge, mesh::Place::triangle};
    if (state.meeting > kPlaces.size()) return false;
    return state.meeting == 0 || static_cast<mesh::Place>(state.place) == kPlaces[state.meeting - 1U];
  }
  return true;
}

// A state that can be one of no mesh is that of a beginning.
template <class State>
mesh::GodObject god_object_of(const State& state) noexcept {
  if (!is_state(state)) return {};
  mesh::GodObject its{.place = static_cast<mesh::Place>(state.place),
                      .side = static_cast<mesh::Side>(state.side),
                      .is_slipping = state.slipping == 1};
  std::copy_n(state.position, 3, its.position.begin());
  std::copy_n(state.index, 2, its.index.begin());
  std::copy_n(state.parameter, 2, its.parameter.begin());
  if constexpr (HasCells<State>) {
    its.meeting = static_cast<mesh::Meeting>(state.meeting);
    std::copy_n(state.further, 2, its.further.begin());
    std::copy_n(state.cell, 2, its.cell.begin());
  }
  return its;
}

template <class State>
void put(const mesh::GodObject& its, State& state) noexcept {
  state.place = static_cast<std::uint8_t>(its.place);
  state.side = static_cast<std::uint8_t>(its.side);
  state.slipping = its.is_slipping ? 1 : 0;
  std::copy(its.position.begin(), its.position.end(), state.position);
  std::copy(its.index.begin(), its.index.end(), state.index);
  std::copy(its.parameter.begin(), its.parameter.end(), state.parameter);
  if constexpr (HasCells<State>) {
    state.meeting = static_cast<std::uint8_t>(its.meeting);
    std::copy(its.further.begin(), its.further.end(), state.further);
    std::copy(its.cell.begin(), its.cell.end(), state.cell);
  }
}

}  // namespace forceshade::c
