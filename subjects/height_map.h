// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map from its TOML file, with every number in its domain.

#include <string>

#include "forceshade/heights.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// Throws Error with the file, the line of the number that is out of its domain, and the domain.
void expect_valid(const std::string& file, const heights::Spec& spec);

// Reads a map for both sides. Throws Error with file, line, value and what was expected.
heights::Spec read_height_map(const Options& options, float stiffness);

}  // namespace forceshade::subjects
