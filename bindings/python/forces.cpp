// SPDX-License-Identifier: BSD-3-Clause
// Forces of laws and height maps: of one position, and of arrays.

#include "bindings/c/forces.h"

#include <memory>

#include "bindings/python/arrays.h"
#include "bindings/python/subject.h"
#include "forceshade/error.h"

namespace forceshade::python {
namespace {

constexpr const char* kNeedsSession =
    "the force of a mesh depends on the path; expected a session of it, forceshade.Session(mesh), and its step() or steps()";

PyObject* force_of_one(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
  float position[3];
  if (!read_position(arguments, count, names, position)) return nullptr;
  const auto* const subject = object_of<Subject>(self);
  if (subject == nullptr) {
    PyErr_SetString(PyExc_TypeError, "force() needs a subject whose __init__ has run");
    return nullptr;
  }
  if (const auto* law = std::get_if<fast::Law>(&subject->field)) {
    const fast::Evaluation answer = law->evaluate(*c::as_vectors(position));
    return tuple_of(answer.force.data());
  }
  if (const auto* map = std::get_if<fast::HeightMapField>(&subject->field)) {
    const fast::Evaluation answer = map->evaluate(*c::as_vectors(position));
    return tuple_of(answer.force.data());
  }
  PyErr_SetString(py::module_::import("forceshade._forceshade").attr("Error").ptr(), kNeedsSession);
  return nullptr;
}

PyMethodDef force_method{
    "force", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&force_of_one)), METH_FASTCALL | METH_KEYWORDS,
    "force($self, x, y, z, *, rounding=None)\n--\n\n"
    "The force (N) at one position (mm), as a tuple of three floats.\n\n"
    "x, y, z: numbers. One that binary32 does not hold is rounded to the nearest, with a RoundingWarning unless "
    "rounding=\"nearest\".\n\n"
    "For many positions, forces() takes an array. A position that is not a number, or beyond 10 000 mm, gives no force.\n"};

// Returns how many positions were invalid.
std::size_t forces_of_many(const Subject& subject, const py::buffer& positions, const py::buffer& forces,
                           const std::optional<py::buffer>& statuses, std::size_t threads) {
  if (!subject.renderer.batch) throw Error(kNeedsSession);
  expect_arithmetic();
  const Batches batches(positions, forces, statuses, threads);
  std::size_t invalid = 0;
  batches.for_each_part(kPart, [&](const forceshade_batch& batch) { invalid += c::forces_of(subject, batch); });
  return invalid;
}

}  // namespace

void expect_arithmetic() {
  if (const char* fault = fast::arithmetic_fault())
    throw Error(std::string("found ") + fault + " on this thread; expected the arithmetic of IEEE 754, rounded to nearest");
}

void add_forces(py::module_&, py::class_<Subject, std::shared_ptr<Subject>>& subject) {
  add_method(subject, force_method);
  subject.def("_forces", &forces_of_many, py::arg(), py::arg(), py::arg() = py::none(), py::arg() = 1);
}

}  // namespace forceshade::python
