// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// certify plan, certify work, certify status, and certify merge with the folder of a plan.

#include <CLI/CLI.hpp>
#include <string>

#include "apps/output_options.h"
#include "forceshade/certify.h"

namespace forceshade::apps {

void add_plan(CLI::App& certify, int& result);
void add_work(CLI::App& certify, int& result);
void add_status(CLI::App& certify, int& result);

// Joins what the units of a plan found so far. Returns the exit code.
int merge_plan(const std::string& folder, const OutFolder& out);

}  // namespace forceshade::apps
