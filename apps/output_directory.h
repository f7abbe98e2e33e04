// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The directory that a command writes into, and of which nothing is left where it wrote nothing.

#include <filesystem>
#include <string>
#include <vector>

namespace forceshade::apps {

// Makes the directory, and those above it that are missing; of the ones that it made, those that are still empty go with it.
class OutputDirectory {
 public:
  // Throws BadInput, naming the option, unless the directory is there or can be made, and can be written to.
  OutputDirectory(const std::string& option, const std::string& path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  // the innermost first
};

}  // namespace forceshade::apps
