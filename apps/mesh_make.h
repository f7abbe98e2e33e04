// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// forceshade mesh make: meshes of simple shapes.

#include <CLI/CLI.hpp>

namespace forceshade::apps {

void add_mesh_make(CLI::App& mesh, int& result);

}  // namespace forceshade::apps
