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
  std::uint8_t place, side, slipping;
  float position[3];
  std::uint32_t index[2], parameter[2];
};

std::size_t advance(const Subject& subject, py::array states, const Floats& positions, Floats& forces,
                    std::optional<Bytes> statuses, std::size_t threads) {
  expect_arithmetic();
  const Batches batches(positions, forces, statuses ? &*statuses : nullptr, threads);
  if (3 * states.size() != positions.size() || states.itemsize() != sizeof(PathState) || !states.writeable() ||
      (states.flags() & py::array::c_style) == 0)
    throw py::value_error("states: expected one for each position, without gaps");
  auto* next = static_cast<PathState*>(states.mutable_data());
  std::size_t invalid = 0;
  batches.for_each_part(kPart, [&](const forceshade_batch& batch) {
    invalid += c::advance(subject, batch, [next](std::size_t i) -> PathState& { return next[i]; });
    next += batch.count;
  });
  return invalid;
}

}  // namespace

void add_paths(py::class_<Subject, std::shared_ptr<Subject>>& subject) {
  subject.def("_advance", &advance, py::arg().noconvert(), py::arg().noconvert(), py::arg().noconvert(),
              py::arg().noconvert() = py::none(), py::arg() = 1);
}

}  // namespace forceshade::python
