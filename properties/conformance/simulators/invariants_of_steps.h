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

}  // namespace forceshade::conformance::simulators
