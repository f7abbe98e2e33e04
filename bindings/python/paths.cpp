// SPDX-License-Identifier: BSD-3-Clause
// Many paths over one subject, a tick of each.

#include "bindings/c/paths.h"

#include <cstdint>
#include <optional>

#include "bindings/python/arrays.h"
#include "bindings/python/subject.h"

namespace forceshade::python {
namespace {

// STATE of the package.
struct PathState {
  std::uint8_t place, side, slipping, meeting;
  float position[3];
  std::uint32_t index[2], parameter[2], further[2], cell[2];
};

// True if the elements lie one after the other.
bool has_no_gaps(const py::buffer_info& array) {
  py::ssize_t step = array.itemsize;
  for (std::size_t axis = array.shape.size(); axis-- > 0; step *= array.shape[axis])
    if (array.shape[axis] > 1 && array.strides[axis] != step) return false;
  return true;
}

std::size_t advance(const Subject& subject, const py::buffer& states, const py::buffer& positions, const py::buffer& forces,
                    const std::optional<py::buffer>& statuses, std::size_t threads) {
  expect_arithmetic();
  const Batches batches(positions, forces, statuses, threads);
  const py::buffer_info its = states.request(true);
  if (static_cast<std::size_t>(its.size) != batches.size() || its.itemsize != sizeof(PathState) || !has_no_gaps(its))
    throw py::value_error("states: expected one for each position, without gaps");
  auto* next = static_cast<PathState*>(its.ptr);
  std::size_t invalid = 0;
  batches.for_each_part(kPart / 64 * threads, [&](const forceshade_batch& batch) {
    invalid += c::advance(subject, batch, [next](std::size_t i) -> PathState& { return next[i]; });
    next += batch.count;
  });
  return invalid;
}

}  // namespace

void add_paths(py::class_<Subject, std::shared_ptr<Subject>>& subject) {
  subject.def("_advance", &advance, py::arg(), py::arg(), py::arg(), py::arg() = py::none(), py::arg() = 1);
}

}  // namespace forceshade::python
