// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The commands of forceshade-study: each runs through `result` when the user calls it.

#include <CLI/CLI.hpp>

namespace forceshade::apps {

void add_experiment(CLI::App& app, int& result);
void add_analyze(CLI::App& app, int& result);

}  // namespace forceshade::apps
