// SPDX-License-Identifier: BSD-3-Clause
// Recordings, as structured arrays.

#include <cstring>
#include <span>

#include "bindings/python/arrays.h"
#include "bindings/python/subject.h"
#include "forceshade/error.h"
#include "forceshade/recording.h"
#include "run/recorder/layout.h"

namespace forceshade::python {
namespace {

// The samples' bytes in an array of the recording's own layout, the metadata, and the problems.
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
  const py::dtype layout = py::dtype::from_args(columns);
  py::array samples(layout, static_cast<py::ssize_t>(bytes.size() / sizeof(device::Sample)));
  std::memcpy(samples.mutable_data(), bytes.data(), bytes.size());
  return py::make_tuple(samples, recording.metadata(), problems);
}

}  // namespace

void add_recordings(py::module_& module) {
  module.def("read_recording", &read);
}

}  // namespace forceshade::python
