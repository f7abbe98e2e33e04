// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subject, as Python has it: its description, from which the exact side is built too, and its renderer.

#include <pybind11/pybind11.h>

#include <utility>
#include <variant>

#include "bindings/c/described.h"
#include "forceshade/description.h"
#include "forceshade/error.h"

namespace forceshade::python {

// Does not change, so that threads share it.
struct Subject : c::Subject {
  explicit Subject(Description what);

  Description description;  // of which the exact side is built, too
};

// The result of a build(). Throws Error for the fault of this thread's arithmetic, and py::value_error for a parameter.
template <class Built>
Built built(std::variant<Built, ParameterError> made) {
  if (const auto* error = std::get_if<ParameterError>(&made)) {
    if (error->arithmetic_fault != nullptr) throw Error(error->message());
    throw pybind11::value_error(error->message());
  }
  return std::get<Built>(std::move(made));
}

// Throws Error: what this thread's arithmetic does otherwise than the proofs need. A library that switches on flush to zero,
// as some that are compiled with -ffast-math do when they are imported, is the usual cause.
void expect_arithmetic();

// The text of every RoundingWarning. It is the same for all numbers, so that Python shows it once for each line that calls.
inline constexpr const char* kRounded =
    "a number that binary32 does not hold was rounded to the nearest that it holds, and the force is that of the rounded one; "
    "rounding=\"nearest\" says that this is meant";

// A number as binary32, rounded where it has to be; unless is_rounded, with a RoundingWarning. name: "x"; unit: "mm". False and
// a Python error for anything else.
bool read_float(PyObject* number, const char* name, const char* unit, bool is_rounded, float& read) noexcept;

// Adds a method `name` to the type, for calls that take less time than pybind11 needs to look at the arguments.
void add_method(pybind11::handle type, PyMethodDef& method);

// The object that an instance of the type holds; null where its __init__ has not run, which pybind11's own cast would answer
// with memory that nothing has been made in.
template <class T>
T* object_of(PyObject* self) noexcept {
  const pybind11::detail::value_and_holder held = reinterpret_cast<pybind11::detail::instance*>(self)->get_value_and_holder();
  return held.holder_constructed() ? held.value_ptr<T>() : nullptr;
}

// Three coordinates and whether they may be rounded, of a call (x, y, z, *, rounding=None), each by its place or its name.
// False and a Python error for anything else.
bool read_position(PyObject* const* arguments, Py_ssize_t count, PyObject* names, float (&position)[3]) noexcept;

// (x, y, z) of floats.
PyObject* tuple_of(const float* force) noexcept;

// The positions that are answered between two looks for Ctrl-C: some ms of work.
inline constexpr std::size_t kPart = std::size_t{1} << 18U;

// Adds the part of each file to the module.
void add_numbers(pybind11::module_& module);
void add_subjects(pybind11::module_& module);
void add_forces(pybind11::module_& module, pybind11::class_<Subject, std::shared_ptr<Subject>>& subject);
void add_paths(pybind11::class_<Subject, std::shared_ptr<Subject>>& subject);
void add_sessions(pybind11::module_& module);
void add_scenes(pybind11::module_& module);
void add_damping(pybind11::module_& module);
void add_exact(pybind11::module_& module);
void add_checks(pybind11::module_& module);
void add_conform(pybind11::module_& module);
void add_recordings(pybind11::module_& module);

}  // namespace forceshade::python
