// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_folder.h"

#include <fcntl.h>
#include <stdio.h>  // NOLINT(modernize-deprecated-headers): renameat2
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace forceshade::files {
namespace {

namespace fs = std::filesystem;

// The path without a slash at its end.
fs::path plain(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() || !normal.has_relative_path() ? normal : normal.parent_path();
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

void sync_folders(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_directory()) sync_folders(entry.path());
  sync_folder(folder);
}

bool renamed(const fs::path& from, const fs::path& to, unsigned how) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), how) == 0;
}

// A rename that was made, so that it can be undone.
struct Renamed {
  fs::path from, to;
  unsigned how;
};

}  // namespace

OutputFolder::OutputFolder(const fs::path& path) : path_(plain(path)) {
  std::error_code ignored;
  is_there_ = fs::is_directory(path_, ignored);
  fs::create_directories(folder_of(path_), ignored);
  // In it, because it may be a mount point, or in a folder that cannot be written to.
  int failed = 0;
  do {
    partial_ = partial_name(is_there_ ? path_.string() + '/' : path_.string());
    failed = ::mkdir(partial_.c_str(), 0777);
  } while (failed != 0 && errno == EEXIST);
  if (failed != 0) throw output_failure(path_, "make a folder for its files", errno);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void OutputFolder::write(const std::string& name, const std::string& text) const {
  OutputFile file(partial_ / name);
  file.stream() << text;
  file.commit();
}

void OutputFolder::commit() {
  sync_folders(partial_);
  if (is_there_)
    put_in_place();
  else if (::rename(partial_.c_str(), path_.c_str()) != 0)
    throw output_failure(path_, "put the finished folder in place", errno);
  std::error_code ignored;
  fs::remove_all(std::exchange(partial_, {}), ignored);  // the files that were replaced
  sync_folder(is_there_ ? path_ : folder_of(path_));
}

// A file that is there changes places with the new one, so that this can be undone. A file system that cannot do that replaces
// it.
void OutputFolder::put_in_place() const {
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(partial_)) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  for (const fs::path& name : names)
    if (const fs::file_status at = fs::symlink_status(path_ / name); fs::exists(at) && !fs::is_regular_file(at))
      throw output_failure(path_ / name, "replace what is no regular file", EEXIST);
  std::vector<Renamed> done;
  for (const fs::path& name : names) {
    const fs::path from = partial_ / name, to = path_ / name;
    const auto by = [&](unsigned how) {
      const bool is_done = renamed(from, to, how);
      if (is_done) done.push_back({from, to, how});
      return is_done;
    };
    if (by(RENAME_NOREPLACE) || (errno == EEXIST && by(RENAME_EXCHANGE))) continue;
    if (errno == EINVAL && ::rename(from.c_str(), to.c_str()) == 0) continue;
    const int reason = errno;
    for (; !done.empty(); done.pop_back()) renamed(done.back().to, done.back().from, done.back().how);
    throw output_failure(to, "put in place", reason);
  }
}

}  // namespace forceshade::files
