// SPDX-License-Identifier: BSD-3-Clause
#include "apps/experiment_bumps.h"

#include <algorithm>
#include <cmath>

#include "apps/command.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "forceshade/properties.h"

namespace forceshade::apps {
namespace {

using experiments::Bump;
using experiments::kMillimetresPerMil;
using experiments::StimulusKind;

// The protocol's stiffness is that of all that a session renders.
std::shared_ptr<const properties::Subject> subject_of_file(const std::string& file, float stiffness) {
  const Description described = read_with_progress(subjects::options_of_file(file));
  if (const float its = described.stiffness(); its != stiffness)
    throw BadInput(file + ": stiffness: expected that of the protocol, " + files::shortest(stiffness) + " N/mm, got " +
                   files::shortest(its) + " N/mm");
  return properties::subject_of(described);
}

std::shared_ptr<const properties::Subject> subject_of(const experiments::Protocol& protocol, const Bump& bump) {
  const experiments::Stimulus& stimulus = protocol.stimulus(bump.stimulus);
  if (stimulus.kind == StimulusKind::law) return properties::law_subject(stimulus.law, protocol.parameters(bump.radius));
  const auto variant = std::ranges::find(stimulus.variants, bump.radius, &experiments::Variant::radius);
  if (variant == stimulus.variants.end()) throw BadInput(words_of(bump) + ": the protocol has no such shape");
  const std::string file = variant->file;
  if (stimulus.kind == StimulusKind::subject) return subject_of_file(file, protocol.stiffness);
  subjects::Options options{{"stiffness", files::shortest(protocol.stiffness)}};
  if (stimulus.kind == StimulusKind::mesh) {
    options.add({"mesh", file});
    options.add({"unit", variant->unit});
  } else {
    options.add({"height-map", file});
  }
  return properties::subject_of(read_with_progress(options));
}

}  // namespace

std::string words_of(const Bump& bump) {
  return bump.radius == 0 ? bump.stimulus : bump.stimulus + ", " + std::to_string(bump.radius) + " mil";
}

Bumps::Kept& Bumps::kept(const Bump& bump) {
  Kept& kept = kept_[{bump.stimulus, bump.radius}];
  if (!kept.subject) kept.subject = subject_of(protocol_, bump);
  return kept;
}

const properties::Subject& Bumps::of(const Bump& bump) {
  return *kept(bump).subject;
}

Eigen::Vector3f Bumps::place_of(const Bump& bump, const Eigen::Vector3f& origin) {
  return origin + Eigen::Vector3f(static_cast<float>(bump.position * kMillimetresPerMil), 0, 0);
}

double Bumps::height(const Bump& bump, double x) {
  Kept& its = kept(bump);
  if (its.subject->identity().kind == kMeshKind) return 0;
  if (!its.looked_at) its.looked_at = its.subject->renderer().open();
  // The highest place with a force, to a hundredth of a millimetre; a height map is at most as high as its domain.
  const auto is_inside = [&](double z) {
    return its.looked_at->step({static_cast<float>(x), 0, static_cast<float>(z)}).status == Status::contact;
  };
  double inside = -100, outside = 100;
  if (!std::isfinite(x) || !is_inside(inside)) return 0;
  while (outside - inside > 0.01) {
    const double middle = 0.5 * (inside + outside);
    (is_inside(middle) ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

}  // namespace forceshade::apps
