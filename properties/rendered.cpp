// SPDX-License-Identifier: BSD-3-Clause
#include "properties/rendered.h"

#include "forceshade/fast.h"
#include "forceshade/session.h"
#include "properties/binary32.h"

namespace forceshade::properties {
namespace {

// From what both sides are built from.
template <class Fast, class Reference, class... From>
std::variant<RenderedField<Reference>, ParameterError> built(const From&... from) {
  auto reference = Reference::build(from...);
  if (const auto* error = std::get_if<ParameterError>(&reference)) return *error;
  auto fast = Fast::build(from...);
  if (const auto* error = std::get_if<ParameterError>(&fast)) return *error;
  return RenderedField<Reference>{std::get<Reference>(std::move(reference)), force_at_of(renderer_of(std::get<Fast>(fast)))};
}

}  // namespace

RendererThrew::RendererThrew(const Eigen::Vector3f& position, const std::string& what)
    : Error("at " + show(position) + " mm the renderer throws: " + what) {}

Rendered answer_of(fast::Session& session, const Eigen::Vector3f& position) {
  const fast::Evaluation answer = session.step(position);
  if (const auto what = exception_of(session)) throw RendererThrew(position, *what);
  return {answer.force, answer.status};
}

ForceAt force_at_of(const Renderer& renderer) {
  return [session = std::shared_ptr<fast::Session>(renderer.open())](const Eigen::Vector3f& position) {
    return answer_of(*session, position);
  };
}

Renderer renderer_answering(const ForceAt& force_at) {
  return {[force_at] {
    return answering([force_at](const Eigen::Vector3f& position) {
      const Rendered answer = force_at(position);
      return fast::Evaluation{answer.force, answer.status};
    });
  }};
}

std::variant<RenderedLaw, ParameterError> fast_rendering(LawId id, const Parameters& parameters) {
  return built<fast::Law, reference::Law>(id, parameters);
}

std::variant<RenderedHeightMap, ParameterError> fast_rendering(const HeightMap& map, height::Mode mode, float stiffness) {
  return built<fast::HeightMapField, reference::HeightMapField>(map, mode, stiffness);
}

}  // namespace forceshade::properties
