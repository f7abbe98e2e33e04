// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/driven.h"

#include <cstdio>
#include <utility>

#include "forceshade/apps/command.h"
#include "forceshade/csv/csv.h"
#include "forceshade/csv/printable.h"
#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/law.h"
#include "forceshade/identity/digest.h"

namespace forceshade::apps {

Driven driven(LawId law, const Parameters& p) {
  nlohmann::ordered_json parameters{{"stiffness_N_per_mm", static_cast<double>(p.stiffness)}};
  recorder::Metadata metadata{{"law", std::string(name_of(law))}, {"stiffness_N_per_mm", csv::shortest(p.stiffness)}};
  if (has_bump_geometry(law)) {
    parameters["radius_mm"] = static_cast<double>(p.radius);
    parameters["width_mm"] = static_cast<double>(p.width);
    metadata["radius_mm"] = csv::shortest(p.radius);
    metadata["width_mm"] = csv::shortest(p.width);
  }
  return {built(fast::Law::build(law, p)),
          [law, p](const auto& certificate, const auto& build) { return properties::refusal(certificate, build, law, p); },
          {{"law", name_of(law)}, {"parameters", parameters}},
          std::move(metadata)};
}

Driven driven(const std::string& name, const heights::Spec& spec, float stiffness) {
  const properties::HeightIdentity identity = properties::identity_of(spec.map, spec.rendering, stiffness);
  const std::string rendering(name_of(spec.rendering));
  return {built(fast::HeightMapField::build(spec.map, spec.rendering, stiffness)),
          [identity](const auto& certificate, const auto& build) { return properties::refusal(certificate, build, identity); },
          {{"height_map", name},
           {"map_digest", identity.map_digest},
           {"rendering", rendering},
           {"parameters", {{"stiffness_N_per_mm", static_cast<double>(stiffness)}}}},
          {{"height_map", name},
           {"map_digest", identity.map_digest},
           {"rendering", rendering},
           {"stiffness_N_per_mm", csv::shortest(stiffness)}}};
}

Certified certified(const std::string& file, const Driven& what) {
  if (file.empty())
    return {std::nullopt, "no certificate was given; expected --certificate FILE, as written by 'forceshade certify'"};
  const std::string text = properties::read_certificate(file);
  const properties::Certificate certificate = properties::from_json(text, file);
  if (const auto refused = what.refusal(certificate, properties::current_build()))
    return {std::nullopt, file + ": " + *refused};
  properties::Digest digest;
  digest.text(text);
  return {digest.hex(), ""};
}

bool may_be_driven(const Certified& certified, bool uncertified) {
  if (certified.digest) return true;
  const std::string why = csv::printable(certified.why_not);
  if (uncertified)
    std::fprintf(stderr, "*** DRIVING UNCERTIFIED, as told by --uncertified: %s ***\n", why.c_str());
  else
    std::fprintf(stderr, "forceshade: refused to drive: %s\n", why.c_str());
  return uncertified;
}

}  // namespace forceshade::apps
