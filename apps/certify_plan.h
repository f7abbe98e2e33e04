// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The verbs of certify.

#include <CLI/CLI.hpp>

namespace forceshade::apps {

void add_plan(CLI::App& certify, int& result);
void add_work(CLI::App& certify, int& result);
void add_merge(CLI::App& certify, int& result);

}  // namespace forceshade::apps
