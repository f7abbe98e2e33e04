// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/python/arrays.h"

#include <bit>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace forceshade::python {
namespace {

void expect(bool holds, const char* what) {
  if (!holds) throw py::value_error(std::string("expected ") + what);
}

// The letters of PEP 3118 for numbers of this type, of which the size decides.
template <class Number>
constexpr std::string_view kLetters = std::is_same_v<Number, float>          ? "f"
                                      : std::is_same_v<Number, std::uint8_t> ? "B"
                                                                             : "IL";

static_assert(std::endian::native == std::endian::little,
              "the formats of buffers in another byte order begin with another sign");

bool is_aligned(const py::buffer_info& array) {
  if (reinterpret_cast<std::uintptr_t>(array.ptr) % alignof(float) != 0) return false;
  for (std::size_t axis = 0; axis < array.shape.size(); ++axis)
    if (array.shape[axis] > 1 && array.strides[axis] % static_cast<py::ssize_t>(alignof(float)) != 0) return false;
  return true;
}

struct View {
  py::object owner;
  const void* numbers;
  std::size_t size;  // of a number
  std::string format;
  py::ssize_t rows, columns;
};

}  // namespace

template <class Number>
py::buffer_info buffer_of(const py::buffer& array, Access access) {
  py::buffer_info its = array.request(access == Access::write);
  std::string_view format = its.format;
  if (format.size() == 2 && std::string_view("@=<").find(format[0]) != std::string_view::npos) format.remove_prefix(1);
  const bool fits = format.size() == 1 && kLetters<Number>.find(format[0]) != std::string_view::npos &&
                    its.itemsize == static_cast<py::ssize_t>(sizeof(Number));
  if (!fits)
    throw py::value_error("expected numbers of the format " + std::string(kLetters<Number>.substr(0, 1)) + ", got " +
                          its.format);
  return its;
}

template py::buffer_info buffer_of<float>(const py::buffer&, Access);
template py::buffer_info buffer_of<std::uint8_t>(const py::buffer&, Access);
template py::buffer_info buffer_of<std::uint32_t>(const py::buffer&, Access);

template <class Number>
py::memoryview view_of(const Number* numbers, std::size_t rows, std::size_t columns, py::object owner) {
  return py::memoryview(py::cast(View{std::move(owner), numbers, sizeof(Number), py::format_descriptor<Number>::format(),
                                      static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)}));
}

template py::memoryview view_of(const float*, std::size_t, std::size_t, py::object);
template py::memoryview view_of(const std::uint32_t*, std::size_t, std::size_t, py::object);

Batches::Batches(const py::buffer& positions, const py::buffer& forces, const std::optional<py::buffer>& statuses,
                 std::size_t threads)
    : positions_(buffer_of<float>(positions)), forces_(buffer_of<float>(forces, Access::write)) {
  if (statuses) statuses_ = buffer_of<std::uint8_t>(*statuses, Access::write);
  expect(!positions_.shape.empty() && positions_.shape.back() == 3, "positions (..., 3)");
  expect(forces_.shape == positions_.shape, "forces of the shape of the positions");
  const bool is_empty = positions_.size == 0;
  expect(is_empty || (is_aligned(positions_) && is_aligned(forces_)), "arrays whose numbers lie at multiples of 4 bytes");
  const std::size_t axes = positions_.shape.size() - 1;  // before that of the components
  if (statuses)
    expect(std::equal(statuses_.shape.begin(), statuses_.shape.end(), positions_.shape.begin(), positions_.shape.end() - 1),
           "statuses of the shape of the positions without its last axis");
  if (is_empty) return;
  count_ = static_cast<std::size_t>(positions_.size) / 3;
  std::vector<Axis> all;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const Axis next{static_cast<std::size_t>(positions_.shape[axis]), positions_.strides[axis], forces_.strides[axis],
                    statuses ? statuses_.strides[axis] : 0};
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
            static_cast<const float*>(positions_.ptr),
            inner.position,
            positions_.strides[axes],
            static_cast<float*>(forces_.ptr),
            inner.force,
            forces_.strides[axes],
            static_cast<std::uint8_t*>(statuses_.ptr),
            inner.status,
            threads};
}

void add_arrays(py::module_& module) {
  py::class_<View>(module, "View", py::buffer_protocol()).def_buffer([](View& its) {
    const auto size = static_cast<py::ssize_t>(its.size);
    return py::buffer_info(const_cast<void*>(its.numbers), size, its.format, 2, {its.rows, its.columns},
                           {its.columns * size, size}, /*readonly=*/true);
  });
}

}  // namespace forceshade::python
