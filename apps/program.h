// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A program of several commands: its words in, its exit code out, with help, manual pages and completion of all of them.

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/documentation.h"

namespace forceshade::apps {

struct Command {
  std::string_view name;
  void (*add)(CLI::App&, int& result);  // runs through `result` when the user calls it
};

// A command, or a command and its option or verb, that has other words now, or none where it is not needed, and what else to
// say of them; or options ("--at --from") of every command that has none of the name.
struct FormerWords {
  std::string_view words, now, remark = {};
};

struct Program {
  std::string name, description;
  std::span<const Command> commands;
  std::span<const Example> examples;
  std::span<const FormerWords> former = {};
};

// arguments: the words after the program's name. Once in a process: it uses the standard streams and the signals of the
// process. Returns the exit code: 0 held, 1 a check failed, 2 bad usage or input, 3 device fault, 130 interrupted.
int run_program(const Program& program, const std::vector<std::string>& arguments);

}  // namespace forceshade::apps
