// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Records of one matching trial beside a session's results (thesis 5.5.3), for the figures 6-1, 6-6, 6-7, 6-12 and 6-17.

#include <string>
#include <vector>

#include "forceshade/law.h"

namespace forceshade::analysis {

struct RadiusChange {
  double seconds;  // since the trial began
  double radius;   // mil, from then on
};

// Every radius of the matching bump, the initial one first.
struct RadiusProfile {
  std::string title;  // "P1, bump-cylinder, no vision, trial 12"
  double reference;   // mil
  std::vector<RadiusChange> changes;
};

struct Position {
  double x, z;  // mm
};

struct PositionProfile {
  std::string title;
  std::vector<Position> positions;  // of the stylus, in the order of time
  std::vector<Position> nominal;    // the nominal geometry from left to right: nominal_line() of each bump, one after the other
};

// The nominal surface of a bump whose middle lies at x = centre, from x = from to x = to, at 400 places and at both sides of
// the bump. None where the parameters are outside the law's domain.
std::vector<Position> nominal_line(LawId law, const Parameters& parameters, double centre, double from, double to);

}  // namespace forceshade::analysis
