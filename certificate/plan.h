// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A plan: what is to be certified, by which build, and how it is cut into units of work. Its file is written once and names no
// time, host or processor; the digest of a plan is that of the file's text.

#include <string>
#include <utility>
#include <vector>

#include "certificate/work.h"

namespace forceshade::properties {

struct Plan {
  Build build = current_build();
  std::uint64_t parts_of_a_unit = 1;
  std::uint64_t lease = 300;  // s: after which a unit is taken from a worker that gives no sign of life
  // For a plan of points; a plan of sweeps has none of them.
  std::vector<std::pair<std::string, std::string>> subject = {};  // option words, files with their folders
  std::vector<std::string> identities = {};                       // the subjects that the words meant, one line each
  std::uint64_t points = 0, cases = 0, seed = 0;
  SweepPlan sweeps{{}, {}, {}};

  bool has_sweeps() const { return subject.empty(); }
};

std::string to_json(const Plan& plan);

// Throws Error, naming the file, the key, its value and what was expected.
Plan plan_from_json(const std::string& text, const std::string& file);

// One line that is the same for the same subject.
std::string identity_line(const Identity& identity);

// The reason why this build may not work on the plan; empty if it may.
std::string refusal_of_build(const Plan& plan, const Build& build);

// The number of parts of a unit that makes about so many units.
std::uint64_t parts_for_units(const std::vector<Item>& items, std::uint64_t units);

}  // namespace forceshade::properties
