// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A field, which is a law or a height map, beside a renderer that is said to render it: what the properties of fields check.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "reference/height_map_field.h"
#include "reference/law.h"
#include "rendering/law.h"
#include "rendering/renderer/renderer.h"

namespace forceshade::properties {

struct Rendered {
  Eigen::Vector3f force{0, 0, 0};  // N
  Status status = Status::free;
};

// position (mm) -> force, the same for the same position. What it throws fails the property that called it.
using ForceAt = std::function<Rendered(const Eigen::Vector3f& position)>;

template <class Reference>
struct RenderedField {
  Reference law;
  ForceAt force_at;
};
using RenderedLaw = RenderedField<reference::Law>;
using RenderedHeightMap = RenderedField<reference::HeightMapField>;

// What went wrong, in words with numbers in hexfloat and decimal; empty where the property holds.
using Violation = std::optional<std::string>;

// A renderer that threw where it had to answer: "at x = ... mm the renderer throws: ...".
struct RendererThrew : std::runtime_error {
  RendererThrew(const Eigen::Vector3f& position, const std::string& what);
};

// The session's answer there. Throws RendererThrew.
Rendered answer_of(fast::Session& session, const Eigen::Vector3f& position);

// The renderer's call for one position. One thread at a time. Throws RendererThrew.
ForceAt force_at_of(const Renderer& renderer);

// A renderer without a batch call. What it gives is counted as decided by binary64.
Renderer renderer_answering(const ForceAt& force_at);

// The fast path as a renderer, beside its reference.
std::variant<RenderedLaw, ParameterError> fast_rendering(LawId id, const Parameters& parameters);
std::variant<RenderedHeightMap, ParameterError> fast_rendering(const HeightMap& map, height::Rendering rendering,
                                                               float stiffness);

}  // namespace forceshade::properties
