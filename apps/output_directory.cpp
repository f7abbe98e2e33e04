// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/output_directory.h"

#include "forceshade/apps/command.h"

namespace forceshade::apps {
namespace fs = std::filesystem;

OutputDirectory::OutputDirectory(const std::string& option, const std::string& path) {
  std::error_code error;
  for (fs::path missing = fs::path(path).lexically_normal(); !missing.empty() && !fs::exists(missing, error);) {
    if (missing.has_filename()) made_.push_back(missing);
    if (missing == missing.parent_path()) break;
    missing = missing.parent_path();
  }
  make_directory(option, path);
}

OutputDirectory::~OutputDirectory() {
  std::error_code error;  // one that is not empty stays
  for (const fs::path& directory : made_) fs::remove(directory, error);
}

}  // namespace forceshade::apps
