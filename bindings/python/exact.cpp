// SPDX-License-Identifier: BSD-3-Clause
// The exact side: forces by their definition, in decimal digits or rounded, and comparisons with rational numbers.

#include <array>
#include <string>
#include <utility>
#include <variant>

#include "bindings/c/strided.h"
#include "bindings/python/arrays.h"
#include "bindings/python/errors.h"
#include "bindings/python/subject.h"
#include "forceshade/reference.h"

namespace forceshade::python {
namespace {

template <class Built>
Built expect(std::variant<Built, ParameterError> made) {
  if (const auto* error = std::get_if<ParameterError>(&made)) throw py::value_error(error->message());
  return std::get<Built>(std::move(made));
}

using Definition = std::variant<reference::Law, reference::HeightMapField, reference::GodObject>;

Definition definition_of(const Description& description) {
  if (const auto* law = std::get_if<DescribedLaw>(&description.what))
    return expect(reference::Law::build(law->law, law->parameters));
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return expect(reference::HeightMapField::build(map->map, map->mode, map->stiffness));
  return expect(reference::GodObject::build(std::get<MeshRendering>(description.what)));
}

using Position = std::array<float, 3>;

Eigen::Vector3f vector_of(const Position& position) {
  return {position[0], position[1], position[2]};
}

class Reference {
 public:
  explicit Reference(const Subject& subject) : definition_(definition_of(subject.description)) {}

  // The status and the three components.
  std::pair<int, std::array<std::string, 3>> decimals(const Position& position, unsigned digits) const {
    if (const auto* law = std::get_if<reference::Law>(&definition_)) {
      const reference::DecimalForce force = law->decimal(vector_of(position), digits);
      return {static_cast<int>(force.status), {force.x, "0", force.z}};
    }
    if (const auto* map = std::get_if<reference::HeightMapField>(&definition_)) {
      const reference::DecimalMapForce force = map->decimal(vector_of(position), digits);
      return {static_cast<int>(force.status), {force.x, force.y, force.z}};
    }
    throw Error("the force of a mesh depends on the path; expected reference_forces() of the positions of a path");
  }

  int compare(const Position& position, std::size_t axis, const std::string& rational) const {
    if (const auto* law = std::get_if<reference::Law>(&definition_)) return law->compare(vector_of(position), axis, rational);
    return std::get<reference::HeightMapField>(definition_).compare(vector_of(position), axis, rational);
  }

  // The exact forces rounded once; those of a mesh along a path from its beginning.
  void rounded(const Floats& positions, Floats& forces, Bytes& statuses) const {
    const Batches batches(positions, forces, &statuses);
    const py::gil_scoped_release released;
    if (const auto* god_object = std::get_if<reference::GodObject>(&definition_)) {
      reference::GodObjectSession session(*god_object);
      fill(batches, [&](const Eigen::Vector3f& at) { return of_tick(session.step({at.x(), at.y(), at.z()})); });
    } else {
      fill(batches, [&](const Eigen::Vector3f& at) {
        const auto* law = std::get_if<reference::Law>(&definition_);
        return law != nullptr ? law->round_to_binary32(at)
                              : std::get<reference::HeightMapField>(definition_).round_to_binary32(at);
      });
    }
  }

 private:
  static reference::Rounded of_tick(const mesh::Tick& tick) {
    reference::Rounded answer;
    answer.force = {tick.force[0], tick.force[1], tick.force[2]};
    answer.is_unfinished = tick.status == mesh::TickStatus::unfinished;
    if (tick.status == mesh::TickStatus::invalid)
      answer.status = Status::invalid;
    else if (tick.status != mesh::TickStatus::free)
      answer.status = Status::contact;
    return answer;
  }

  template <class Answer>
  static void fill(const Batches& batches, const Answer& answer) {
    batches.for_each([&](const forceshade_batch& batch) {
      for (std::size_t i = 0; i < batch.count; ++i) {
        Eigen::Vector3f position;
        for (std::size_t axis = 0; axis < 3; ++axis)
          position[static_cast<Eigen::Index>(axis)] =
              *c::at(batch.positions, i, batch.position_stride, axis, batch.position_component);
        const reference::Rounded rounded = answer(position);
        for (std::size_t axis = 0; axis < 3; ++axis)
          *c::at(batch.forces, i, batch.force_stride, axis, batch.force_component) =
              rounded.force[static_cast<Eigen::Index>(axis)];
        *c::at(batch.statuses, i, batch.status_stride) =
            static_cast<forceshade_status>(rounded.is_unfinished ? FORCESHADE_UNFINISHED : static_cast<int>(rounded.status));
      }
    });
  }

  Definition definition_;
};

std::array<std::string, 5> geometry(float radius, float width, unsigned digits) {
  const Parameters parameters{radius, width, 1};
  expect(reference::Law::build(LawId::cylinder, parameters));  // looks whether they are in their domain
  const reference::DecimalGeometry its = reference::geometry(parameters, digits);
  return {its.d, its.h, its.w_prime, its.h_prime, its.theta};
}

}  // namespace

void add_exact(py::module_& module) {
  py::class_<Reference>(module, "Reference")
      .def(py::init<const Subject&>(), py::call_guard<py::gil_scoped_release>())
      .def("decimals", &Reference::decimals, py::call_guard<py::gil_scoped_release>())
      .def("compare", &Reference::compare, py::call_guard<py::gil_scoped_release>())
      .def("rounded", &Reference::rounded);
  module.def("geometry", &geometry, py::call_guard<py::gil_scoped_release>());
}

}  // namespace forceshade::python
