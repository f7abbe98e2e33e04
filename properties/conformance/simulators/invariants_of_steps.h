// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Invariants of a simulator that hold in each step of a run.

#include <cstddef>
#include <vector>

#include "properties/conformance/simulators/finding.h"
#include "properties/conformance/simulators/run.h"

namespace forceshade::conformance::simulators {

struct StepInvariant {
  const char* name;
  Courses courses;
  enum class From { beginning, settled } from;
  bool is_of_reports;  // not applicable to a simulator that reports nothing
  Felt (*felt)(const Run& run, std::size_t k);
};

std::vector<StepInvariant> step_invariants();

// Invariants of a simulator that compare two runs, and those of hostile input.

struct RunInvariant {
  const char* name;
  Courses courses;
  void (*look)(Bench& bench, const Course& course, Finding& finding);  // throws files::ProcessFailed
};

std::vector<RunInvariant> comparisons();

// Here a simulator may also refuse in words, and one that fails violates the invariant and does not end the check.
std::vector<RunInvariant> hostile_inputs();

}  // namespace forceshade::conformance::simulators
