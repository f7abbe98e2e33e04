// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arrays of Python as the batches of the C interface, which lie wherever the arrays lie. They come and go as buffers (PEP
// 3118), by which NumPy's arrays and others are alike: nothing here depends on NumPy's binary interface, which changes from
// version to version.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "bindings/c/parts.h"
#include "bindings/python/interruptible.h"
#include "forceshade.h"

namespace forceshade::python {

namespace py = pybind11;

enum class Access { read, write };

// The buffer of an array of such numbers, which stays where it is as long as this lives; needs the GIL at its end, too. Throws
// py::value_error for numbers of another type or byte order, and what the array raises where it cannot be written.
template <class Number>  // float, std::uint8_t or std::uint32_t
py::buffer_info buffer_of(const py::buffer& array, Access access = Access::read);

// An element of an array of two axes, which need not be aligned.
template <class Number>
Number at(const py::buffer_info& array, std::size_t row, std::size_t column) {
  Number number;
  std::memcpy(&number,
              static_cast<const char*>(array.ptr) + static_cast<py::ssize_t>(row) * array.strides[0] +
                  static_cast<py::ssize_t>(column) * array.strides[1],
              sizeof number);
  return number;
}

// Numbers in rows, where they lie, which `owner` keeps alive, as a memoryview that cannot be written.
template <class Number>
py::memoryview view_of(const Number* numbers, std::size_t rows, std::size_t columns, py::object owner);

// Positions (..., 3), forces of the same shape and statuses (...), as one batch after the other.
class Batches {
 public:
  // threads: of each batch. Throws py::value_error where the types or shapes do not fit together: the package has looked
  // before.
  Batches(const py::buffer& positions, const py::buffer& forces, const std::optional<py::buffer>& statuses,
          std::size_t threads = 1);

  // The number of all positions.
  std::size_t size() const { return count_; }

  // call(batch) for each; needs no GIL.
  template <class Call>
  void for_each(const Call& call) const {
    if (count_ == 0) return;
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

  py::buffer_info positions_, forces_, statuses_;
  std::size_t count_ = 0;
  forceshade_batch first_{};
  std::vector<Axis> outer_;  // the axes before that of a batch
};

// Adds what view_of() needs to the module.
void add_arrays(py::module_& module);

}  // namespace forceshade::python
