// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// conform compare.

#include <CLI/CLI.hpp>

namespace forceshade::apps {

// A subcommand of conform.
void add_conform_compare(CLI::App& conform, int& result);

}  // namespace forceshade::apps
