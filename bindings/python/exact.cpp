// SPDX-License-Identifier: BSD-3-Clause
// The exact side: forces by their definition, in decimal digits or rounded, and comparisons with rational numbers.

#include <array>
#include <string>
#include <utility>
#include <variant>

#include "bindings/python/arrays.h"
#include "bindings/python/subject.h"
#include "bindings/reference/definition.h"
#include "bindings/reference/rational.h"
#include "forceshade/error.h"
#include "reference/surface_height.h"
#include "text/beginning.h"

namespace forceshade::python {
namespace {

using Position = std::array<float, 3>;

Eigen::Vector3f vector_of(const Position& position) {
  return {position[0], position[1], position[2]};
}

class Reference {
 public:
  explicit Reference(const Subject& subject) : definition_(built(exact::Definition::build(subject.description))) {}

  // The status and the three components.
  std::pair<int, std::array<std::string, 3>> decimals(const Position& position, unsigned digits) const {
    if (definition_.depends_on_the_path())
      throw Error("the force of a mesh depends on the path; expected reference_forces() of the positions of a path");
    exact::Decimals its = definition_.decimals(vector_of(position), digits);
    return {its.status, std::move(its.force)};
  }

  int compare(const Position& position, std::size_t axis, const std::string& rational) const {
    const auto number = exact::rational_of(rational);
    if (!number) throw py::value_error("expected a rational number, got \"" + std::string(beginning_of(rational, 64)) + '"');
    return definition_.compare(vector_of(position), axis, *number);
  }

  // The exact forces rounded once; those of a mesh along a path from its beginning.
  void rounded(const py::buffer& positions, const py::buffer& forces, const py::buffer& statuses) const {
    const Batches batches(positions, forces, statuses);
    const auto answer = definition_.along_a_path();
    batches.for_each_part(32, [&](const forceshade_batch& batch) { exact::fill(batch, answer); });
  }

 private:
  exact::Definition definition_;
};

// The exact height of the surface rounded once to binary32.
float height_at(const Subject& subject, float x, float y) {
  return reference::surface_height(std::get<DescribedHeightMap>(subject.description.what).map, x, y);
}

std::array<std::string, 5> geometry(float radius, float width, unsigned digits) {
  const reference::DecimalGeometry its = built(exact::geometry(radius, width, digits));
  return {its.d, its.h, its.w_prime, its.h_prime, its.theta};
}

}  // namespace

void add_exact(py::module_& module) {
  py::class_<Reference>(module, "Reference")
      .def(py::init<const Subject&>(), py::call_guard<py::gil_scoped_release>())
      .def("decimals", &Reference::decimals, py::call_guard<py::gil_scoped_release>())
      .def("compare", &Reference::compare, py::call_guard<py::gil_scoped_release>())
      .def("rounded", &Reference::rounded);
  module.def("height_at", &height_at, py::call_guard<py::gil_scoped_release>());
  module.def("geometry", &geometry, py::call_guard<py::gil_scoped_release>());
}

}  // namespace forceshade::python
