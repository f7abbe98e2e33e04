// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/subject.h"

#include "forceshade/fast/law.h"

namespace forceshade::properties {

std::variant<Subject, ParameterError> fast_subject(LawId id, const Parameters& parameters) {
  const auto reference = reference::Law::build(id, parameters);
  if (const auto* error = std::get_if<ParameterError>(&reference)) return *error;
  const auto fast = fast::Law::build(id, parameters);
  if (const auto* error = std::get_if<ParameterError>(&fast)) return *error;
  return Subject{std::get<reference::Law>(reference), [law = std::get<fast::Law>(fast)](const Eigen::Vector3f& position) {
                   const fast::Evaluation answer = law.evaluate(position);
                   return Rendered{answer.force, answer.status};
                 }};
}

}  // namespace forceshade::properties
