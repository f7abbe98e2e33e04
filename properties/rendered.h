// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A field, which is a law or a height map, beside a renderer that should render it: what the properties of fields check.

#include <Eigen/Core>
#include <string>
#include <variant>

#include "forceshade/error.h"
#include "forceshade/properties.h"
#include "forceshade/reference.h"

namespace forceshade::properties {

template <class Reference>
struct RenderedField {
  Reference law;
  ForceAt force_at;
};
using RenderedLaw = RenderedField<reference::Law>;
using RenderedHeightMap = RenderedField<reference::HeightMapField>;

// A renderer that threw where it had to answer: "at x = ... mm the renderer throws: ...".
struct RendererThrew : Error {
  RendererThrew(const Eigen::Vector3f& position, const std::string& what);
};

// The session's answer there. Throws RendererThrew.
Rendered answer_of(fast::Session& session, const Eigen::Vector3f& position);

// The renderer's call for one position. One thread at a time. Throws RendererThrew.
ForceAt force_at_of(const Renderer& renderer);

// The fast path as a renderer, beside its reference.
std::variant<RenderedLaw, ParameterError> fast_rendering(LawId id, const Parameters& parameters);
std::variant<RenderedHeightMap, ParameterError> fast_rendering(const HeightMap& map, height::Mode mode, float stiffness);

}  // namespace forceshade::properties
