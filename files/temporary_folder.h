// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A folder for files that nobody asked for.

#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "forceshade/error.h"

namespace forceshade::files {

// Makes a new one where temporary files go. Throws Error, in words that name TMPDIR.
inline std::filesystem::path new_temporary_folder() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "forceshade-XXXXXX").string();
  if (!error && !::mkdtemp(name.data())) error = {errno, std::generic_category()};
  if (error) throw Error("TMPDIR: expected a folder that can be written to, for temporary files: " + error.message());
  return name;
}

}  // namespace forceshade::files
