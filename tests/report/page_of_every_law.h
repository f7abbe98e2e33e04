// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A certificate of every law, made for these tests, and its page.

#include <string>

#include "forceshade/identity.h"
#include "report/report.h"

namespace forceshade::tests {

inline properties::Certificate certificate_of_every_law() {
  properties::Certificate certificate;
  certificate.build = {"0.1.0", "c0ffee", "GNU 12.2.0", "-O3 -ffp-contract=off", "avx2", std::string(64, 'a')};
  certificate.seconds = 1.5;
  for (const LawName& name : kLaws) {
    properties::SubjectResult law;
    law.identity = identity_of(name.id, {15.24F, 25.4F, 0.5F});
    law.unit_directions = true;
    law.rendered_by = properties::RenderedBy::library;
    law.points = 2000;
    law.points_by_stage = {{"binary64", 1990}, {"double-double", 9}, {"wide", 1}};
    law.closest_call = {1.5F, 0, -0.25F, 3e-7};
    law.conservative = name.id <= LawId::bump_1p;
    if (!law.conservative) law.jumps = {"|x| = w/2"};
    for (const char* property : {"equivalence", "continuity", "unit normals", "passivity"})
      law.properties.push_back({property, 100, true, ""});
    for (const double depth : {0.5, 1.0, 2.0})
      law.energy.push_back(law.conservative
                               ? properties::LoopEnergy{depth, {0, 0}, 0, 1e-18}
                               : properties::LoopEnergy{depth, {1.001 * depth, 1.002 * depth}, depth, depth * (1 + 1e-6)});
    certificate.subjects.push_back(law);
  }
  return certificate;
}

inline properties::SubjectResult& result_of(properties::Certificate& certificate, LawId id) {
  return certificate.subjects.at(static_cast<std::size_t>(id));
}

inline const std::string& page() {
  static const std::string html = properties::to_html(certificate_of_every_law());
  return html;
}

}  // namespace forceshade::tests
