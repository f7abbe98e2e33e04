// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a property is checked on: a renderer, ours or anyone's, and the law or height map it claims to render.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "forceshade/properties/calls.h"
#include "forceshade/reference/height_map_field.h"
#include "forceshade/reference/law.h"
#include "forceshade/vocabulary/law.h"

namespace forceshade::properties {

struct Rendered {
  Eigen::Vector3f force{0, 0, 0};  // N
  Status status = Status::free;
};

// position (mm) -> force; called from several threads at once by certify().
using Renderer = std::function<Rendered(const Eigen::Vector3f& position)>;

template <class Reference>
struct SubjectOf {
  Reference law;
  Renderer renderer;
};
using Subject = SubjectOf<reference::Law>;
using HeightSubject = SubjectOf<reference::HeightMapField>;

// What went wrong, in words with numbers in hexfloat and decimal; empty where the property holds.
using Violation = std::optional<std::string>;

// Its call for one position.
Renderer renderer_of(const Calls& calls);

// The fast path as a renderer, beside its reference.
std::variant<Subject, ParameterError> fast_subject(LawId id, const Parameters& parameters);
std::variant<HeightSubject, ParameterError> fast_subject(const HeightMap& map, height::Rendering rendering, float stiffness);

}  // namespace forceshade::properties
