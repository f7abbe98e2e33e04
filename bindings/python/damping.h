// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Damping as the package has it: numbers that it has read.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>

#include "bindings/python/arrays.h"
#include "bindings/python/entered.h"
#include "forceshade/fast.h"

namespace forceshade::python {

// The members of damping::Parameters and of damping::State.
using DampingNumbers = std::array<float, 6>;
using DampingState = std::tuple<bool, std::array<float, 3>, std::array<float, 3>, std::uint8_t>;

// Throws py::value_error for a number outside its range, and Error for a fault of this thread's arithmetic.
fast::Damping damping_of(const DampingNumbers& numbers);
std::optional<fast::Damping> damping_of(const std::optional<DampingNumbers>& numbers);

DampingState numbers_of(const fast::Damping& damping);
void resume_damping(fast::Damping& damping, const DampingState& state);

// The periods since the tick before, of one position after the other: an array without gaps, or none for 1 each.
class Periods {
 public:
  Periods(const std::optional<py::buffer>& periods, std::size_t count);

  // Those of so many positions; null for 1 each.
  const std::uint32_t* next(std::size_t count) noexcept {
    const std::uint32_t* const its = next_;
    if (its != nullptr) next_ += count;
    return its;
  }

 private:
  std::optional<py::buffer_info> array_;
  const std::uint32_t* next_ = nullptr;
};

// Adds the state of its damping to a session or a scene, which the package asks for only where it has one.
template <class T>
void add_damping_state(py::class_<T>& its) {
  its.def("_damping_state", [](T& of) {
    const Entered entered(of);
    entered.or_throw();
    return numbers_of(of.damping.value());
  });
  its.def("_resume_damping", [](T& of, const DampingState& state) {
    const Entered entered(of);
    entered.or_throw();
    resume_damping(of.damping.value(), state);
  });
}

}  // namespace forceshade::python
