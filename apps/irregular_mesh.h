// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words of `mesh check` about a mesh that is not regular, and about the borders of any.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "forceshade/meshes.h"

namespace forceshade::apps {

// A name and what is said of it, for people.
using Row = std::pair<std::string, std::string>;

std::vector<Row> rows_of(const mesh::Irregularities& found);
// nearer_than: mm, of the cracks; 0 where none were looked for.
std::vector<Row> rows_of(const mesh::Borders& borders, float nearer_than);

nlohmann::ordered_json json_of(const mesh::Irregularities& found);
nlohmann::ordered_json json_of(const mesh::Borders& borders, float nearer_than);

}  // namespace forceshade::apps
