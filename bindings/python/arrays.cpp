// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/python/arrays.h"

#include <string>

namespace forceshade::python {
namespace {

void expect(bool holds, const char* what) {
  if (!holds) throw py::value_error(std::string("expected ") + what);
}

bool is_aligned(const py::array& array) {
  if (reinterpret_cast<std::uintptr_t>(array.data()) % alignof(float) != 0) return false;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    if (array.shape(axis) > 1 && array.strides(axis) % static_cast<py::ssize_t>(alignof(float)) != 0) return false;
  return true;
}

}  // namespace

Batches::Batches(const Floats& positions, Floats& forces, Bytes* statuses, std::size_t threads) {
  const py::ssize_t axes = positions.ndim();
  expect(axes >= 1 && positions.shape(axes - 1) == 3, "positions (..., 3)");
  expect(forces.ndim() == axes, "forces of the shape of the positions");
  for (py::ssize_t axis = 0; axis < axes; ++axis) {
    expect(forces.shape(axis) == positions.shape(axis), "forces of the shape of the positions");
    if (positions.shape(axis) == 0) is_empty_ = true;
  }
  expect(is_empty_ || (is_aligned(positions) && is_aligned(forces)), "arrays whose numbers lie at multiples of 4 bytes");
  if (statuses != nullptr) {
    expect(statuses->ndim() == axes - 1, "statuses of the shape of the positions without its last axis");
    for (py::ssize_t axis = 0; axis + 1 < axes; ++axis)
      expect(statuses->shape(axis) == positions.shape(axis), "statuses of the shape of the positions without its last axis");
  }
  if (is_empty_) return;
  count_ = static_cast<std::size_t>(positions.size()) / 3;
  std::vector<Axis> all;
  for (py::ssize_t axis = 0; axis + 1 < axes; ++axis) {
    const Axis next{static_cast<std::size_t>(positions.shape(axis)), positions.strides(axis), forces.strides(axis),
                    statuses != nullptr ? statuses->strides(axis) : 0};
    const auto count = static_cast<std::ptrdiff_t>(next.count);
    // Two axes that lie as one do, the usual case, are one.
    if (!all.empty() && all.back().position == next.position * count && all.back().force == next.force * count &&
        all.back().status == next.status * count)
      all.back() = {all.back().count * next.count, next.position, next.force, next.status};
    else
      all.push_back(next);
  }
  const Axis inner = all.empty() ? Axis{1, 12, 12, 1} : all.back();
  if (!all.empty()) all.pop_back();
  outer_ = std::move(all);
  first_ = {sizeof first_,
            inner.count,
            positions.data(),
            inner.position,
            positions.strides(axes - 1),
            forces.mutable_data(),
            inner.force,
            forces.strides(axes - 1),
            statuses != nullptr ? statuses->mutable_data() : nullptr,
            inner.status,
            threads};
}

}  // namespace forceshade::python
