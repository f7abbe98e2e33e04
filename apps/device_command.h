// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of forceshade device, each in a file of its own.

#include <CLI/CLI.hpp>

namespace forceshade::apps {

void add_device_check(CLI::App& device, int& result);
void add_device_try(CLI::App& device, int& result);

}  // namespace forceshade::apps
