// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Folders for temporary files.

#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "files/output_file.h"

namespace forceshade::files {

// Makes a new one where temporary files go. Throws OutputError, in words that name TMPDIR.
inline std::filesystem::path new_temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  std::string name = (folder / "forceshade-XXXXXX").string();
  if (!error && !::mkdtemp(name.data())) error = {errno, std::generic_category()};
  if (!error) return name;
  throw OutputError((folder.empty() ? "TMPDIR" : folder.string() + " (TMPDIR)") +
                    ": expected a folder that can be written to, for temporary files: " + error.message());
}

}  // namespace forceshade::files
