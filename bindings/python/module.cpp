// SPDX-License-Identifier: BSD-3-Clause
// The extension module forceshade._forceshade. Its functions are called by the package around it, which has read the arguments;
// what users see is documented there.

#include <pybind11/pybind11.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include "bindings/python/arrays.h"
#include "bindings/python/subject.h"
#include "forceshade/checks.h"
#include "forceshade/error.h"

namespace py = pybind11;
using namespace forceshade;

namespace {

// Sets it with its words, in which a name or a line of a file may be no UTF-8.
void set_error(PyObject* kind, const std::exception& error) {
  const auto words = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(error.what(), static_cast<py::ssize_t>(std::strlen(error.what())), "backslashreplace"));
  if (words) PyErr_SetObject(kind, words.ptr());
}

// An object whose __init__ has not run, as that of Law.__new__(Law), has no room that has to be made: it is refused.
void expect_made(py::handle type) {
  py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(type.ptr()))->operator_new = [](std::size_t) -> void* {
    throw py::type_error("expected an object whose __init__ has run");
  };
}

}  // namespace

// pybind11 waits for ever in a sub-interpreter, as web servers have them: for the lock that this thread has. So another
// function is called first, which has the name that Python looks for.
#define PyInit__forceshade init_in_the_main_interpreter
PYBIND11_MODULE(_forceshade, module) {
  module.doc() = "The compiled part of forceshade.";
  static py::exception<Error> error(module, "Error");
  error.attr("__module__") = "forceshade";
  error.attr("__doc__") =
      "A refusal that is no wrong value or type: a file, the arithmetic of this thread, a session that another "
      "thread is in, a question that a subject of this kind cannot answer.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const py::value_error& wrong) {
      set_error(PyExc_ValueError, wrong);
    } catch (const py::type_error& wrong) {
      set_error(PyExc_TypeError, wrong);
    } catch (const py::builtin_exception&) {
      throw;
    } catch (const std::domain_error& undecided) {
      set_error(error.ptr(), undecided);
    } catch (const std::runtime_error& refused) {
      set_error(error.ptr(), refused);
    }
  });
  module.attr("version") = FORCESHADE_VERSION;
  module.def(
      "library_digest", [] { return fast::library_digest(); },
      "SHA-256 of the compiled code that computes forces, in hexadecimal digits, as certificates have it.");
  module.def("instruction_set", [] { return std::string(fast::name_of(fast::best_instruction_set())); });
  python::add_numbers(module);
  python::add_arrays(module);
  python::add_subjects(module);
  python::add_sessions(module);
  python::add_scenes(module);
  python::add_damping(module);
  python::add_exact(module);
  python::add_recordings(module);
  python::add_checks(module);
  python::add_conform(module);
  for (const char* const type : {"Subject", "Session", "Scene"}) expect_made(module.attr(type));
}

#undef PyInit__forceshade
PyMODINIT_FUNC PyInit__forceshade() {
  if (PyInterpreterState_Get() == PyInterpreterState_Main()) return init_in_the_main_interpreter();
  PyErr_SetString(PyExc_ImportError,
                  "forceshade cannot be imported in a sub-interpreter; expected the main one of its process");
  return nullptr;
}
