// SPDX-License-Identifier: BSD-3-Clause
// Numbers of Python as binary32; where they are rounded unasked, a warning says so.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>

#include "bindings/python/subject.h"

namespace py = pybind11;

namespace forceshade::python {
namespace {

bool fail(PyObject* kind, const char* name, const char* unit, const char* expected, PyObject* got) noexcept {
  PyErr_Format(kind, "%s: expected %s%s, got %R", name, expected, unit, got);
  return false;
}

PyObject* rounding_warning = nullptr;  // the class, which lives as long as the module

// A binary64 number as binary32. One beyond the range is infinite, as rounding has it. False where the warning is an error.
bool narrowed(double number, bool is_rounded, float& read) noexcept {
  read = static_cast<float>(number);
  if (is_rounded || static_cast<double>(read) == number || std::isnan(number)) return true;
  return PyErr_WarnEx(rounding_warning, kRounded, 1) == 0;
}

// True for NumPy's scalars that binary64 holds. A further look would take microseconds.
bool is_held(PyObject* number) noexcept {
  const std::string_view type = Py_TYPE(number)->tp_name;
  return type == "numpy.float32" || type == "numpy.float16" || type.starts_with("numpy.int") || type.starts_with("numpy.uint");
}

// True for what float() takes and that is no real number: booleans, complex numbers, of which it takes a part, and masked
// ones, NumPy's too. It runs nothing of Python, which could fail.
bool is_no_real(PyObject* number) noexcept {
  const std::string_view type = Py_TYPE(number)->tp_name;
  return PyBool_Check(number) || PyComplex_Check(number) || type.starts_with("numpy.bool") ||
         type.starts_with("numpy.complex") || type == "numpy.clongdouble" || type == "MaskedArray" || type == "MaskedConstant";
}

// Turns the binary64 number that is nearest to a Fraction or a long double into the one beside it whose last digit is odd,
// unless it is the very number. Rounded to binary32, either is as the number is. One that says its float and has no order is
// that. False and a Python error where there is no memory, or where comparing was interrupted.
bool rounded_to_odd(PyObject* number, double& value) noexcept {
  if (std::isnan(value)) return true;
  PyObject* const nearest = PyFloat_FromDouble(value);
  if (nearest == nullptr) return false;
  const int is_same = PyObject_RichCompareBool(number, nearest, Py_EQ);
  const int is_above = is_same == 0 ? PyObject_RichCompareBool(number, nearest, Py_GT) : is_same;
  Py_DECREF(nearest);
  if (is_above < 0) {
    if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) return false;
    PyErr_Clear();
  }
  if (is_same == 0 && is_above >= 0 && (std::bit_cast<std::uint64_t>(value) & 1U) == 0)
    value = std::nextafter(value, is_above == 1 ? HUGE_VAL : -HUGE_VAL);
  return true;
}

}  // namespace

bool read_float(PyObject* number, const char* name, const char* unit, bool is_rounded, float& read) noexcept {
  if (PyFloat_Check(number)) return narrowed(PyFloat_AS_DOUBLE(number), is_rounded, read);
  if (is_held(number)) {
    const double value = PyFloat_AsDouble(number);
    return (value != -1 || PyErr_Occurred() == nullptr) && narrowed(value, is_rounded, read);
  }
  if (PyUnicode_Check(number) || is_no_real(number)) return fail(PyExc_TypeError, name, unit, "a number in ", number);
  if (PyLong_Check(number)) {
    int beyond = 0;
    const long long integer = PyLong_AsLongLongAndOverflow(number, &beyond);
    if (beyond == 0 && integer == -1 && PyErr_Occurred() != nullptr) return false;
    // Beyond 2^24 only some are binary32 numbers, and all are beyond what a coordinate can be.
    constexpr long long kMost = 1LL << 53;
    if (beyond != 0 || integer > kMost || integer < -kMost) return fail(PyExc_ValueError, name, unit, "-2^53 to 2^53 ", number);
    return narrowed(static_cast<double>(integer), is_rounded, read);
  }
  double value = PyFloat_AsDouble(number);
  if ((value == -1 && PyErr_Occurred() != nullptr) || !rounded_to_odd(number, value)) {
    if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) return false;
    PyErr_Clear();
    return fail(PyExc_TypeError, name, unit, "a number in ", number);
  }
  return narrowed(value, is_rounded, read);
}

bool read_position(PyObject* const* arguments, Py_ssize_t count, PyObject* names, float (&position)[3]) noexcept {
  bool is_rounded = false;
  const Py_ssize_t named = names == nullptr ? 0 : PyTuple_GET_SIZE(names);
  constexpr const char* kNames[]{"x", "y", "z"};
  PyObject *given[3]{}, *rounding = Py_None;
  for (Py_ssize_t i = 0; i < std::min<Py_ssize_t>(count, 3); ++i) given[i] = arguments[i];
  for (Py_ssize_t i = 0; i < named; ++i) {
    const char* const name = PyUnicode_AsUTF8(PyTuple_GetItem(names, i));
    if (name == nullptr) return false;
    const auto axis =
        std::find_if(std::begin(kNames), std::end(kNames), [&](const char* one) { return std::strcmp(one, name) == 0; }) -
        std::begin(kNames);
    if (axis == 3 && std::strcmp(name, "rounding") != 0) {
      PyErr_Format(PyExc_TypeError, "expected the keywords x, y, z and rounding, got %s", name);
      return false;
    }
    if (axis < 3 && given[axis] != nullptr) {
      PyErr_Format(PyExc_TypeError, "%s: expected it once, got it by its place and by its name", name);
      return false;
    }
    (axis == 3 ? rounding : given[axis]) = arguments[count + i];
  }
  if (count > 3 || given[0] == nullptr || given[1] == nullptr || given[2] == nullptr) {
    PyErr_Format(PyExc_TypeError,
                 "expected three numbers x, y, z in mm, and at most rounding=\"nearest\" behind them; got %zd arguments%s",
                 count + named, count == 1 ? "; forces() takes arrays of positions" : "");
    return false;
  }
  if (rounding != Py_None) {
    const bool is_text = PyUnicode_Check(rounding);
    if (!is_text || PyUnicode_CompareWithASCIIString(rounding, "nearest") != 0) {
      PyErr_Format(is_text ? PyExc_ValueError : PyExc_TypeError, "rounding: expected \"nearest\" or None, got %R", rounding);
      return false;
    }
    is_rounded = true;
  }
  for (int axis = 0; axis < 3; ++axis)
    if (!read_float(given[axis], kNames[axis], "mm", is_rounded, position[axis])) return false;
  return true;
}

PyObject* tuple_of(const float* force) noexcept {
  PyObject* const tuple = PyTuple_New(3);
  if (tuple == nullptr) return nullptr;
  for (int axis = 0; axis < 3; ++axis) {
    PyObject* const component = PyFloat_FromDouble(static_cast<double>(force[axis]));
    if (component == nullptr) {
      Py_DECREF(tuple);
      return nullptr;
    }
    PyTuple_SET_ITEM(tuple, axis, component);
  }
  return tuple;
}

void add_numbers(py::module_& module) {
  rounding_warning =
      PyErr_NewExceptionWithDoc("forceshade.RoundingWarning",
                                "A number was rounded to the nearest that binary32 holds, without rounding=\"nearest\". "
                                "To refuse it: warnings.simplefilter(\"error\", forceshade.RoundingWarning).",
                                PyExc_UserWarning, nullptr);
  if (rounding_warning == nullptr) throw py::error_already_set();
  module.attr("RoundingWarning") = py::handle(rounding_warning);
  module.attr("rounded") = kRounded;
  module.def("nearest", [](const py::object& number) {
    float read = 0;
    if (!read_float(number.ptr(), "number", "binary32", true, read)) throw py::error_already_set();
    return read;
  });
}

void add_method(py::handle type, PyMethodDef& method) {
  auto* const of = reinterpret_cast<PyTypeObject*>(type.ptr());
  const auto descriptor = py::reinterpret_steal<py::object>(PyDescr_NewMethod(of, &method));
  if (!descriptor) throw py::error_already_set();
  type.attr(method.ml_name) = descriptor;
}

}  // namespace forceshade::python
