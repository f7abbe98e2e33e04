// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --tolerance: the largest distance of a force from the exact one.

#include <CLI/CLI.hpp>
#include <string>

#include "properties/conformance/tolerance.h"

namespace forceshade::apps {

CLI::Option* add_tolerance(CLI::App& command, std::string& value);

// Throws BadInput.
conformance::Tolerance parse_tolerance(const std::string& text);

}  // namespace forceshade::apps
