// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command.h"

#include <unistd.h>

#include <filesystem>

#include "apps/options.h"
#include "files/output_file.h"
#include "files/quantity.h"
#include "files/suggestion.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::apps {
namespace {

std::vector<std::filesystem::path> made_directories;  // each after the one that it is in

}  // namespace

void make_directory(const std::string& option, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path directory = fs::absolute(path, error).lexically_normal();
  fs::path so_far;
  for (const fs::path& part : directory) {
    so_far /= part;
    if (!error && fs::create_directory(so_far, error)) made_directories.push_back(so_far);
  }
  if (fs::is_symlink(path) && !fs::exists(path, error))
    throw Error(option + ": expected a directory, got \"" + path + "\", a symbolic link to \"" +
                fs::read_symlink(path).string() + "\", which is not there");
  if (error || access(path.c_str(), W_OK) != 0)
    throw Error(option + ": expected a directory that can be written to, got \"" + path + '"' +
                (error ? ": " + error.message() : ""));
}

void remove_unused_directories() {
  // From the innermost outwards; a directory that is not empty stays.
  for (; !made_directories.empty(); made_directories.pop_back()) {
    std::error_code not_empty;
    std::filesystem::remove(made_directories.back(), not_empty);
  }
}

}  // namespace forceshade::apps
