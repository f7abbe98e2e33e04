// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/subject.h"

#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/law.h"

namespace forceshade::properties {
namespace {

// From what both sides are built from.
template <class Fast, class Reference, class... From>
std::variant<SubjectOf<Reference>, ParameterError> built(const From&... from) {
  auto reference = Reference::build(from...);
  if (const auto* error = std::get_if<ParameterError>(&reference)) return *error;
  auto fast = Fast::build(from...);
  if (const auto* error = std::get_if<ParameterError>(&fast)) return *error;
  return SubjectOf<Reference>{std::get<Reference>(std::move(reference)), renderer_of(calls_of(std::get<Fast>(fast)))};
}

}  // namespace

Renderer renderer_of(const Calls& calls) {
  return [evaluate = calls.evaluate](const Eigen::Vector3f& position) {
    const fast::Evaluation answer = evaluate(position);
    return Rendered{answer.force, answer.status};
  };
}

std::variant<Subject, ParameterError> fast_subject(LawId id, const Parameters& parameters) {
  return built<fast::Law, reference::Law>(id, parameters);
}

std::variant<HeightSubject, ParameterError> fast_subject(const HeightMap& map, height::Rendering rendering, float stiffness) {
  return built<fast::HeightMapField, reference::HeightMapField>(map, rendering, stiffness);
}

}  // namespace forceshade::properties
