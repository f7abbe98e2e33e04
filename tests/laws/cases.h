// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The hard cases of each law, tests/laws/<law>.cases: the inputs nearest to a rounding tie, or that need the most of a bound,
// that tests/hard_cases/ has found.

#include <Eigen/Core>
#include <istream>
#include <string>
#include <vector>

#include "forceshade/law.h"
#include "forceshade/reference.h"

namespace forceshade::tests {

struct HardCase {
  Parameters parameters;
  Eigen::Vector3f position;  // mm
  Eigen::Vector3f force;     // N, as the reference gives it
  std::string from_tie;      // distance_from_tie() of the component nearest to one
  std::string why;
  std::string place;  // file and line
};

// Throws Error, which names file and line, where the file is malformed or has no cases.
std::vector<HardCase> hard_cases(LawId law);
std::vector<HardCase> read_hard_cases(std::istream& in, const std::string& file);

// The distance from its tie of the component nearest to one, relative to its size, from an enclosure of 80 digits: "x 2^-71.3"
// or "z 0" for a tie.
std::string distance_from_tie(const reference::Law& law, const Eigen::Vector3f& position);

}  // namespace forceshade::tests
