// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Opens files to read.

#include <fstream>
#include <string>

#include "forceshade/error.h"

namespace forceshade::files {

// Throws Error with the system's reason when the file cannot be opened. A directory opens and fails at the first read.
std::ifstream open_input(const std::string& path);

// The same of a file, or of what a shell makes a pipe for: neither a folder, nor a pipe that has a name, at which this would
// wait for a writer.
std::ifstream open_file(const std::string& path);

}  // namespace forceshade::files
