// SPDX-License-Identifier: BSD-3-Clause
#include "properties/height_map_subject.h"

#include <algorithm>
#include <utility>

#include "properties/binary32.h"
#include "properties/built_or_throw.h"
#include "properties/field_properties.h"
#include "properties/generators.h"
#include "properties/height_properties.h"
#include "properties/spread.h"
#include "reference/estimates.h"

namespace forceshade::properties {

Renderer fast_height_map(const HeightMap& map, height::Mode mode, float stiffness) {
  return renderer_of(built_or_throw(fast::HeightMapField::build(map, mode, stiffness)));
}

HeightMapSubject::HeightMapSubject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness,
                                   RenderHeightMap render, bool is_rendered_by_library)
    : FieldSubject({identity_of(name, map, mode, stiffness), render(map, mode, stiffness)},
                   built_or_throw(reference::HeightMapField::build(map, mode, stiffness)), is_rendered_by_library),
      render_(std::move(render)) {}

HeightMapSubject::HeightMapSubject(const RenderedHeightMap& rendered, const std::string& name)
    : FieldSubject({identity_of(name, rendered.law.map(), rendered.law.mode(), rendered.law.stiffness()),
                    renderer_answering(rendered.force_at)},
                   rendered.law, false),
      render_(&fast_height_map) {}

// The normal of a conservative map is no unit vector, and is not meant to be one.
Expected HeightMapSubject::expected() const {
  return {claims_.jumps(), rendered_.law.mode() != height::Mode::conservative, claims_.is_conservative};
}

std::unique_ptr<Positions> HeightMapSubject::positions(std::uint64_t seed) const {
  return std::make_unique<HeightPositionSource>(rendered_.law, claims_, seed);
}

Violation HeightMapSubject::check_continuity(Chooser& choose) const {
  const Neighbours pair = choose(neighbours_on({rendered_.law, claims_}));
  const Eigen::Vector3f b = pair.b();
  return is_valid(b) ? continuity(rendered_, claims_, pair.a, b) : std::nullopt;
}

std::vector<FurtherProperty> HeightMapSubject::further_properties() const {
  const auto has_cells = [](const PartShape& part) { return part.columns.has_value(); };
  if (std::none_of(claims_.parts.begin(), claims_.parts.begin() + static_cast<std::ptrdiff_t>(claims_.map_parts), has_cells))
    return {};
  return {{"cell lines", [this](Chooser& choose) -> Violation {
             Neighbours pair = choose(neighbours_on({rendered_.law, claims_}));
             const double surface = static_cast<double>(rendered_.law.estimate({pair.a.x(), pair.a.y(), 0}).gap.mid());
             pair.a.z() = static_cast<float>(surface - 1);  // deep enough that both are in contact
             const Eigen::Vector3f b = pair.b();
             return is_valid(pair.a) && is_valid(b) ? gradient_across_cells(rendered_, claims_, pair.a, b) : std::nullopt;
           }}};
}

std::vector<LoopEnergy> HeightMapSubject::energies(const Monitor& monitor) const {
  return loop_energies(rendered_, monitor);
}

DrawnSubject HeightMapSubject::with_drawn_parameters(std::uint64_t seed) const {
  const float stiffness = ParameterSource(seed).next().stiffness;
  return {std::make_unique<HeightMapSubject>(identity().name, rendered_.law.map(), rendered_.law.mode(), stiffness, render_,
                                             is_rendered_by_library()),
          "K = " + show(stiffness) + " N/mm: "};
}

std::unique_ptr<Subject> height_map_subject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness) {
  return std::make_unique<HeightMapSubject>(name, map, mode, stiffness);
}

std::unique_ptr<Subject> height_map_subject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness,
                                            ForceAt force_at) {
  return std::make_unique<HeightMapSubject>(
      RenderedHeightMap{built_or_throw(reference::HeightMapField::build(map, mode, stiffness)), std::move(force_at)}, name);
}

std::unique_ptr<Subject> height_map_subject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness,
                                            RenderHeightMap render) {
  return std::make_unique<HeightMapSubject>(name, map, mode, stiffness, std::move(render));
}

}  // namespace forceshade::properties
