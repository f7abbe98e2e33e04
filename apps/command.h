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

// One function per subcommand and, each in a file of its own, verb; each runs through `result` when the user calls it.
void add_laws(CLI::App& app, int& result);
void add_force(CLI::App& app, int& result);
void add_energy(CLI::App& app, int& result);
void add_plot(CLI::App& app, int& result);
void add_properties(CLI::App& app, int& result);
void add_certify(CLI::App& app, int& result);
void add_certify_plan(CLI::App& certify, int& result);
void add_certify_work(CLI::App& certify, int& result);
void add_certify_merge(CLI::App& certify, int& result);
void add_conform(CLI::App& app, int& result);
void add_conform_positions(CLI::App& conform, int& result);
void add_conform_judge(CLI::App& conform, int& result);
void add_conform_recording(CLI::App& conform, int& result);
void add_conform_simulator(CLI::App& conform, int& result);
void add_conform_compare(CLI::App& conform, int& result);
void add_drive(CLI::App& app, int& result);
void add_recording(CLI::App& app, int& result);
void add_device(CLI::App& app, int& result);
void add_device_check(CLI::App& device, int& result);
void add_device_try(CLI::App& device, int& result);
void add_mesh(CLI::App& app, int& result);
void add_mesh_make(CLI::App& mesh, int& result);

}  // namespace forceshade::apps
