// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A plan: what is to be certified, by which build, and how it is cut into units of work. Its file is written once and names no
// time, host or processor; the digest of a plan is that of the file's text.

#include <cstdint>
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

// The result of a unit of work, as text: identical for identical work. It has no time, no host and no processor.

// plan: the digest of the plan that the unit is of. One line of JSON, without its end. Throws Error where an energy
// is not finite.
std::string text_of_unit(const std::string& plan, std::uint64_t number, const Units& units, const Found& found);

// Throws Error, naming the file, where the text is of another plan or unit, or is no such text.
Found unit_from_text(const std::string& text, const std::string& plan, std::uint64_t number, const Units& units,
                     const std::string& file);

}  // namespace forceshade::properties
