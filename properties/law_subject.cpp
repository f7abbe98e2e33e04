// SPDX-License-Identifier: BSD-3-Clause
#include "properties/law_subject.h"

#include <algorithm>
#include <utility>

#include "properties/binary32.h"
#include "properties/built_or_throw.h"
#include "properties/field_properties.h"
#include "properties/generators.h"
#include "properties/spread.h"
#include "reference/energy.h"
#include "rendering/control_words.h"

namespace forceshade::properties {

Renderer fast_law(LawId law, const Parameters& parameters) {
  return renderer_of(built_or_throw(fast::Law::build(law, parameters)));
}

LawSubject::LawSubject(LawId law, const Parameters& parameters, RenderLaw render, bool is_rendered_by_library)
    : FieldSubject({identity_of(law, parameters), render(law, parameters)},
                   built_or_throw(reference::Law::build(law, parameters)), is_rendered_by_library),
      render_(std::move(render)) {}

LawSubject::LawSubject(const RenderedLaw& rendered)
    : FieldSubject({identity_of(rendered.law.id(), rendered.law.parameters()), renderer_answering(rendered.force_at)},
                   rendered.law, false),
      render_(&fast_law) {}

std::unique_ptr<Positions> LawSubject::positions(std::uint64_t seed) const {
  return std::make_unique<PositionSource>(rendered_.law, seed);
}

Violation LawSubject::check_continuity(Chooser& choose) const {
  const NearbyPair pair = choose(pair_of(rendered_.law));
  const Eigen::Vector3f b = pair.b(claims_);
  return is_valid(b) ? continuity(rendered_, claims_, pair.a, b) : std::nullopt;
}

std::vector<std::function<Violation()>> LawSubject::fixed_loops() const {
  std::vector<std::function<Violation()>> loops;
  for (const float depth : witness_depths(rendered_.law))
    loops.emplace_back([this, depth] { return witness_is_reached(rendered_, claims_, depth); });
  return loops;
}

Expected LawSubject::expected() const {
  return {claims_.jumps(), true, claims_.is_conservative};
}

std::vector<LoopEnergy> LawSubject::energies(const Monitor& monitor) const {
  const std::vector<float> depths = witness_depths(rendered_.law);
  std::vector<LoopEnergy> energies;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    monitor.at(static_cast<double>(i) / static_cast<double>(depths.size()));
    const WitnessLoop loop = witness_loop(rendered_.law, depths[i]);
    energies.push_back({static_cast<double>(depths[i]), loop.bound_mJ, loop.given_mJ,
                        work_around(rendered_, claims_, loop.vertices).rendered});
  }
  return energies;
}

DrawnSubject LawSubject::with_drawn_parameters(std::uint64_t seed) const {
  const LawId id = rendered_.law.id();
  const Parameters p = ParameterSource(seed).next();
  const std::string bump =
      has_bump_geometry(id) ? "R = " + show(p.radius) + " mm, w = " + show(p.width) + " mm, " : std::string();
  return {std::make_unique<LawSubject>(id, p, render_, is_rendered_by_library()),
          bump + "K = " + show(p.stiffness) + " N/mm: "};
}

std::vector<float> witness_depths(const reference::Law& law) {
  const float R = law.parameters().radius;
  const float deepest = has_bump_geometry(law.id()) ? std::clamp(2.0F, R / 1000, R / 8) : 2;
  return {deepest / 8, deepest / 4, deepest / 2, deepest * 3 / 4, deepest};
}

std::unique_ptr<Subject> law_subject(LawId law, const Parameters& parameters) {
  const ExactArithmetic with_all_bits;
  return std::make_unique<LawSubject>(law, parameters);
}

std::unique_ptr<Subject> law_subject(LawId law, const Parameters& parameters, ForceAt force_at) {
  const ExactArithmetic with_all_bits;
  return std::make_unique<LawSubject>(RenderedLaw{built_or_throw(reference::Law::build(law, parameters)), std::move(force_at)});
}

std::unique_ptr<Subject> law_subject(LawId law, const Parameters& parameters, RenderLaw render) {
  const ExactArithmetic with_all_bits;
  return std::make_unique<LawSubject>(law, parameters, std::move(render));
}

}  // namespace forceshade::properties
