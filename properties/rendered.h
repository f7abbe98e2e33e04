// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A field, which is a law or a height map, beside a renderer that is said to render it: what the properties of fields check.

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

// position (mm) -> force. It must not throw.
using Renderer = std::function<Rendered(const Eigen::Vector3f& position)>;

template <class Reference>
struct RenderedField {
  Reference law;
  Renderer renderer;
};
using RenderedLaw = RenderedField<reference::Law>;
using RenderedHeightMap = RenderedField<reference::HeightMapField>;

// What went wrong, in words with numbers in hexfloat and decimal; empty where the property holds.
using Violation = std::optional<std::string>;

// Its call for one position. One thread at a time.
Renderer renderer_of(const Calls& calls);

// The other way round, without a batch call. What it gives is counted as decided by binary64.
Calls calls_of(const Renderer& renderer);

// The fast path as a renderer, beside its reference.
std::variant<RenderedLaw, ParameterError> fast_rendering(LawId id, const Parameters& parameters);
std::variant<RenderedHeightMap, ParameterError> fast_rendering(const HeightMap& map, height::Rendering rendering,
                                                               float stiffness);

}  // namespace forceshade::properties
