// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common parts of the subcommands: exit codes, whole output files.

#include <CLI/CLI.hpp>
#include <string>
#include <variant>
#include <vector>

#include "files/output_file.h"
#include "forceshade/error.h"
#include "forceshade/law.h"

namespace forceshade::apps {

using files::write_file;

enum ExitCode { kHeld = 0, kFailed = 1, kBadInput = 2, kDeviceFault = 3, kInterrupted = 130 };

// The result of a build(); throws Error, which begins with `what`.
template <class L>
L built(std::variant<L, ParameterError> law, const std::string& what = "--") {
  if (const auto* error = std::get_if<ParameterError>(&law)) throw Error(what + error->message());
  return std::get<L>(std::move(law));
}

// Throws Error, naming the option, unless the directory is there or can be made, and can be written to.
void make_directory(const std::string& option, const std::string& path);

// Removes those directories that make_directory() made and in which nothing was written: a command that fails leaves none
// behind.
void remove_unused_directories();

// One function per subcommand and, each in a file of its own, verb, of the program or command that it is added to; each runs
// through `result` when the user calls it.
using Add = void(CLI::App& parent, int& result);
Add add_laws, add_force, add_energy, add_plot, add_properties, add_certify, add_conform, add_drive, add_recording, add_device,
    add_mesh;
Add add_certify_plan, add_certify_work, add_certify_merge, add_device_check, add_device_try, add_mesh_make;
Add add_conform_positions, add_conform_judge, add_conform_recording, add_conform_simulator;

}  // namespace forceshade::apps
