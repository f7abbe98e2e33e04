// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Findings of a check in words, of which meshes.h has the usual ones.

#include <functional>
#include <span>
#include <string>

#include "forceshade/meshes.h"

namespace forceshade::mesh {

// One sentence, behind the lines of the finding's triangles where `lines` has any: "lines 12 and 15: ...".
std::string words_of(const Finding& finding, std::span<const std::uint64_t> lines);

// The listed findings in these words, one in a line, and how many more of each fault there are.
std::string words_of(const Findings& findings, const std::function<std::string(const Finding&)>& words);

}  // namespace forceshade::mesh
