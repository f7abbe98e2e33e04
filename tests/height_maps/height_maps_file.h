// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Height maps that a program of tests/golden/ has written into a CSV file. tests/golden/README.md describes the columns.

#include <map>
#include <string>

#include "forceshade/height_map.h"

namespace forceshade::tests {

// By the name in the column `map`. Throws Error, std::invalid_argument or std::out_of_range for a file that no such
// program has written.
std::map<std::string, HeightMap> height_maps_in(const std::string& path);

}  // namespace forceshade::tests
