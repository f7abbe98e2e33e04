// SPDX-License-Identifier: BSD-3-Clause
// Damping behind forces in arrays, on both sides.

#include "bindings/c/damping.h"

#include <cstdint>
#include <optional>
#include <variant>

#include "bindings/python/arrays.h"
#include "bindings/python/damping.h"
#include "bindings/python/subject.h"
#include "forceshade/reference.h"

namespace forceshade::python {
namespace {

template <class Side>
Side made_of(const DampingNumbers& its) {
  expect_arithmetic();
  return built(Side::build({its[0], its[1], its[2], its[3], its[4], its[5]}));
}

// DAMPING_STATE of the package.
struct NumbersOfState {
  std::uint8_t has_position, periods;
  float position[3], velocity[3];
};

constexpr std::size_t kExactPart = 1024;  // positions, of some 10 us each: a signal is heard behind each part

// Forces and statuses become the damped ones, of one position after the other; work(batch, its periods or null) returns how
// many were invalid.
template <class Work>
std::size_t damp(const Batches& batches, const std::optional<py::buffer>& periods, const Work& work, std::size_t part = kPart) {
  Periods since(periods, batches.size());
  std::size_t invalid = 0;
  batches.for_each_part(part, [&](const forceshade_batch& batch) { invalid += work(batch, since.next(batch.count)); });
  return invalid;
}

NumbersOfState* states_in(const py::buffer_info& states, std::size_t count) {
  if (static_cast<std::size_t>(states.size) != count || states.itemsize != sizeof(NumbersOfState))
    throw py::value_error("states: expected one for each path");
  return static_cast<NumbersOfState*>(states.ptr);
}

std::size_t damp_path(const DampingNumbers& numbers, const py::buffer& state, const std::optional<py::buffer>& periods,
                      const py::buffer& positions, const py::buffer& forces, const std::optional<py::buffer>& statuses) {
  auto damping = made_of<fast::Damping>(numbers);
  const py::buffer_info its = state.request(true);
  NumbersOfState& kept = *states_in(its, 1);
  damping.resume(c::damping_state_of(kept));
  const std::size_t invalid =
      damp(Batches(positions, forces, statuses), periods,
           [&](const forceshade_batch& batch, const std::uint32_t* since) { return c::damp_path(damping, since, batch); });
  c::put(damping.state(), kept);
  return invalid;
}

std::size_t damp_paths(const DampingNumbers& numbers, const py::buffer& states, const std::optional<py::buffer>& periods,
                       const py::buffer& positions, const py::buffer& forces, const std::optional<py::buffer>& statuses,
                       std::size_t threads) {
  const auto damping = made_of<fast::Damping>(numbers);
  const Batches batches(positions, forces, statuses, threads);
  const py::buffer_info its = states.request(true);
  NumbersOfState* next = states_in(its, batches.size());
  return damp(batches, periods, [&](const forceshade_batch& batch, const std::uint32_t* since) {
    const auto state_of = [next](std::size_t i) -> NumbersOfState& { return next[i]; };
    next += batch.count;
    return c::damp_paths(damping, state_of, since, batch);
  });
}

// By the definition, from the beginning of a path.
std::size_t damp_exactly(const DampingNumbers& numbers, const std::optional<py::buffer>& periods, const py::buffer& positions,
                         const py::buffer& forces, const std::optional<py::buffer>& statuses) {
  auto damping = made_of<reference::Damping>(numbers);
  const auto tick = [&](std::size_t, const Eigen::Vector3f& position, std::uint32_t since, const fast::Evaluation& spring) {
    reference::Rounded exact;
    exact.force = spring.force;
    exact.status = spring.status;
    exact = damping.tick(position, since, exact);
    return fast::Evaluation{exact.force, exact.status};
  };
  return damp(
      Batches(positions, forces, statuses), periods,
      [&](const forceshade_batch& batch, const std::uint32_t* since) { return c::damp_each(batch, since, tick); }, kExactPart);
}

}  // namespace

fast::Damping damping_of(const DampingNumbers& numbers) {
  return made_of<fast::Damping>(numbers);
}

std::optional<fast::Damping> damping_of(const std::optional<DampingNumbers>& numbers) {
  if (!numbers) return std::nullopt;
  return damping_of(*numbers);
}

Periods::Periods(const std::optional<py::buffer>& periods, std::size_t count) {
  if (!periods) return;
  array_ = buffer_of<std::uint32_t>(*periods);
  if (static_cast<std::size_t>(array_->size) != count) throw py::value_error("periods: expected one for each position");
  next_ = static_cast<const std::uint32_t*>(array_->ptr);
}

DampingState numbers_of(const fast::Damping& damping) {
  const damping::State its = damping.state();
  return {its.has_position, its.position, its.velocity, its.periods};
}

void resume_damping(fast::Damping& damping, const DampingState& state) {
  const auto& [has_position, position, velocity, periods] = state;
  damping.resume({has_position, position, velocity, periods});
}

void add_damping(py::module_& module) {
  module.def("check_damping", [](const DampingNumbers& numbers) { damping_of(numbers); });
  module.def("damp_path", &damp_path);
  module.def("damp_paths", &damp_paths);
  module.def("damp_exactly", &damp_exactly);
}

}  // namespace forceshade::python
