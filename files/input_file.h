// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Opens files to read.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "forceshade/bad_input.h"

namespace forceshade::files {

// what() reads like `input.csv:12: column 2 (x_mm): expected a number, got "abc"`; the line is the one an editor shows.
struct Error : BadInput {
  explicit Error(const std::string& words) : BadInput(words) {}
  Error(const std::filesystem::path& file, const std::string& reason) : Error(file, 0, reason) {}
  // "FILE: reason", or "FILE:LINE: reason" where a line, from 1, is known.
  Error(const std::filesystem::path& file, std::size_t line, const std::string& reason)
      : BadInput(file.string() + (line == 0 ? "" : ":" + std::to_string(line)) + ": " + reason) {}
};

// Throws Error with the system's reason when the file cannot be opened. A directory opens and fails at the first read.
std::ifstream open_input(const std::string& path);

// The same of a file, or of what a shell makes a pipe for: neither a folder, nor a pipe that has a name, at which this would
// wait for a writer.
std::ifstream open_file(const std::string& path);

}  // namespace forceshade::files
