// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arrays of NumPy as the batches of the C interface, which lie wherever the arrays lie.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bindings/c/parts.h"
#include "bindings/python/interruptible.h"
#include "forceshade.h"

namespace forceshade::python {

namespace py = pybind11;

using Floats = py::array_t<float>;
using Bytes = py::array_t<std::uint8_t>;

// Positions (..., 3), forces of the same shape and statuses (...), as one batch after the other.
class Batches {
 public:
  // The arrays outlive this. threads: of each batch. Throws py::value_error where the shapes do not fit together: the package
  // has looked before.
  Batches(const Floats& positions, Floats& forces, Bytes* statuses, std::size_t threads = 1);

  // call(batch) for each; needs no GIL.
  template <class Call>
  void for_each(const Call& call) const {
    if (is_empty_) return;
    std::vector<std::size_t> index(outer_.size(), 0);
    for (;;) {
      forceshade_batch batch = first_;
      std::ptrdiff_t position = 0, force = 0, status = 0;
      for (std::size_t axis = 0; axis < outer_.size(); ++axis) {
        const auto i = static_cast<std::ptrdiff_t>(index[axis]);
        position += i * outer_[axis].position;
        force += i * outer_[axis].force;
        status += i * outer_[axis].status;
      }
      batch.positions += position / kFloat;
      batch.forces += force / kFloat;
      if (batch.statuses != nullptr) batch.statuses += status;
      call(batch);
      std::size_t axis = outer_.size();
      while (axis > 0 && ++index[axis - 1] == outer_[axis - 1].count) index[--axis] = 0;
      if (axis == 0) return;
    }
  }

  // The same without the GIL, with which it is called, in parts of so many positions at most; Ctrl-C ends it behind the part
  // that is being answered, as a py::error_already_set.
  template <class Call>
  void for_each_part(std::size_t most, const Call& call) const {
    if (count_ <= most) {
      const py::gil_scoped_release released;
      return for_each(call);
    }
    interruptible([&](const std::atomic<bool>& stop) {
      for_each([&](const forceshade_batch& batch) {
        for (std::size_t begin = 0; begin < batch.count && !stop; begin += most) {
          forceshade_batch part = c::part_of(batch, begin, std::min(most, batch.count - begin));
          part.size = batch.size;
          part.threads = batch.threads;
          call(part);
        }
      });
    });
  }

 private:
  static constexpr std::ptrdiff_t kFloat = sizeof(float);

  // Strides in bytes.
  struct Axis {
    std::size_t count;
    std::ptrdiff_t position, force, status;
  };

  bool is_empty_ = false;
  std::size_t count_ = 0;  // of all positions
  forceshade_batch first_{};
  std::vector<Axis> outer_;  // the axes before that of a batch
};

}  // namespace forceshade::python
