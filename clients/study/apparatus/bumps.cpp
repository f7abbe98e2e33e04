// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/bumps.h"

#include <algorithm>
#include <cmath>

#include "files/csv.h"
#include "forceshade/checks.h"
#include "forceshade/error.h"
#include "subjects/read.h"
#include "window/contact_border.h"

namespace forceshade::apparatus {
namespace {

using experiments::Bump;
using experiments::kMillimetresPerMil;
using experiments::StimulusKind;

// The protocol's stiffness is that of all that a session renders.
Description of_file(const std::string& file, float stiffness, const Bumps::Read& read) {
  Description described = read(subjects::options_of_file(file));
  if (std::holds_alternative<DescribedScene>(described.what))
    throw Error(file + ": expected no object with a motion, since a session compares surfaces at rest");
  if (const float its = described.stiffness(); its != stiffness)
    throw Error(file + ": stiffness: expected that of the protocol, " + shortest(stiffness) + " N/mm, got " + shortest(its) +
                " N/mm");
  return described;
}

}  // namespace

std::string words_of(const Bump& bump) {
  return bump.radius == 0 ? bump.stimulus : bump.stimulus + ", " + std::to_string(bump.radius) + " mil";
}

Description Bumps::description(const Bump& bump) const {
  const experiments::Stimulus& stimulus = protocol_.stimulus(bump.stimulus);
  if (stimulus.kind == StimulusKind::law)
    return {std::string(name_of(stimulus.law)), DescribedLaw{stimulus.law, protocol_.parameters(bump.radius)}};
  const auto variant = std::ranges::find(stimulus.variants, bump.radius, &experiments::Variant::radius);
  if (variant == stimulus.variants.end()) throw Error(words_of(bump) + ": the protocol has no such shape");
  const std::string file = variant->file;
  if (stimulus.kind == StimulusKind::subject) return of_file(file, protocol_.stiffness, read_);
  subjects::Options options{{"stiffness", shortest(protocol_.stiffness)}};
  if (stimulus.kind == StimulusKind::mesh) {
    options.add({"mesh", file});
    options.add({"unit", variant->unit});
  } else {
    options.add({"height-map", file});
  }
  return read_(options);
}

Bumps::Kept& Bumps::kept(const Bump& bump) {
  Kept& kept = kept_[{bump.stimulus, bump.radius}];
  if (!kept.rendering) {
    auto built = rendering_of(description(bump));
    if (const auto* error = std::get_if<ParameterError>(&built)) throw Error(words_of(bump) + ": " + error->message());
    kept.rendering = std::get<Rendering>(std::move(built));
  }
  return kept;
}

const Rendering& Bumps::of(const Bump& bump) {
  return *kept(bump).rendering;
}

damping::Parameters Bumps::damping(double rate) {
  std::optional<damping::Described> common;
  for (const Bump& bump : protocol_.bumps()) {
    // Nothing but a subject's file says one.
    const bool may_have = protocol_.stimulus(bump.stimulus).kind == StimulusKind::subject;
    const damping::Described its = may_have ? of(bump).damping : damping::Described{};
    if (!common) common = its;
    if (!(its.parameters == common->parameters && its.time == common->time))
      throw Error(words_of(bump) + ": expected the damping of " + words_of(protocol_.bumps().front()) +
                  ", since a session has one for all that it renders");
  }
  return common.value_or(damping::Described{}).at(rate);
}

Eigen::Vector3f Bumps::place_of(const Bump& bump, const Eigen::Vector3f& origin) {
  return origin + Eigen::Vector3f(static_cast<float>(bump.position * kMillimetresPerMil), 0, 0);
}

double Bumps::height(const Bump& bump, double x) {
  Kept& its = kept(bump);
  if (its.rendering->identity.kind == kMeshKind) return 0;
  if (!its.looked_at) its.looked_at = its.rendering->renderer.open();
  // The highest place with a force, to a hundredth of a millimetre; a height map is at most as high as its domain.
  const auto is_inside = [&](double z) {
    return finished(its.looked_at->step({static_cast<float>(x), 0, static_cast<float>(z)}).status) == Status::contact;
  };
  constexpr double kInside = -100, kOutside = 100;
  return std::isfinite(x) && is_inside(kInside) ? window::contact_border(kInside, kOutside, is_inside) : 0;
}

Bumps::Read read_until(const std::atomic<bool>& stop) {
  return [monitor = Monitor([](double) {}, stop)](const subjects::Options& options) {
    return subjects::read_one(options, monitor);
  };
}

}  // namespace forceshade::apparatus
