// SPDX-License-Identifier: BSD-3-Clause
// Recordings, as the bytes of structured arrays.

#include <pybind11/stl.h>

#include <span>

#include "bindings/python/subject.h"
#include "forceshade/error.h"
#include "forceshade/recording.h"
#include "run/recorder/layout.h"

namespace forceshade::python {
namespace {

namespace py = pybind11;

// The samples' bytes, their columns by name and type, the metadata, and the problems.
py::tuple read(const std::string& path) {
  recorder::Recording recording(path);
  std::string bytes;
  std::vector<std::string> problems;
  {
    const py::gil_scoped_release released;
    problems = recorder::problems_of(recording);
    recording.for_each_chunk([&](std::span<const device::Sample> samples) {
      bytes.append(reinterpret_cast<const char*>(samples.data()), samples.size_bytes());
    });
  }
  py::list columns;
  for (const recorder::Column& column : recorder::kColumns) columns.append(py::make_tuple(column.name, column.type));
  return py::make_tuple(py::bytearray(bytes), columns, recording.metadata(), problems);
}

}  // namespace

void add_recordings(py::module_& module) {
  module.def("read_recording", &read);
}

}  // namespace forceshade::python
