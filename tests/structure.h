// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The places of the source files, and their contents.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace forceshade::tests {

inline const std::filesystem::path kRoot = FORCESHADE_SOURCE_DIR;

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The modules of cmake/modules.txt.
inline std::vector<std::string> modules() {
  std::vector<std::string> found;
  std::ifstream file(kRoot / "cmake/modules.txt");
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with('#')) found.push_back(line.substr(0, line.find(':')));
  EXPECT_GT(found.size(), 10U);
  return found;
}

// The folders at the top in which modules, their public headers and clients lie.
inline std::set<std::string> top_folders() {
  std::set<std::string> folders{"include", "clients"};
  for (const std::string& module : modules()) folders.insert(module.substr(0, module.find('/')));
  return folders;
}

}  // namespace forceshade::tests
