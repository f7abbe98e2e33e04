// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file that is written once, by whichever of many processes comes first, and never again.

#include <filesystem>
#include <string>

namespace forceshade::files {

enum class Written {
  now,      // by this call
  before,   // by another, with the same bytes
  differs,  // by another, with other bytes; what is there stays as it is
};

// The text under this name, whole or not at all, and on disk when this returns. The folder is there. It takes link(), which
// replaces nothing and is atomic on NFS too, and needs no lock. Throws OutputError.
Written write_once(const std::filesystem::path& path, const std::string& text);

// True if both are names of one file.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace forceshade::files
