// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_folder.h"

#include <fcntl.h>
#include <stdio.h>  // NOLINT(modernize-deprecated-headers): renameat2
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
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

// The name of the partial folder. Where the whole stem does not fit, a number made of its last name (FNV-1a) tells it apart.
std::string locked_name(const std::string& stem) {
  const std::string name = with_ending(stem, ".partial-00000000");
  if (name.starts_with(stem)) return name;
  std::uint32_t number = 0x811c9dc5;
  for (const char c : fs::path(stem).filename().string()) number = (number ^ static_cast<unsigned char>(c)) * 0x1000193U;
  std::array<char, 32> ending{};
  std::snprintf(ending.data(), ending.size(), ".partial-%08x", static_cast<unsigned>(number));
  return with_ending(stem, ending.data());
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
  fs::create_directories(folder_of(path_), ignored);
  // In it, because it may be a mount point, or in a folder that cannot be written to. Until the lock is held, another process
  // may put PATH in place, and the partial folder belongs in it then.
  do {
    is_there_ = fs::is_directory(path_, ignored);
    const std::string stem = is_there_ ? path_.string() + '/' : path_.string();
    while (!has_claimed(locked_name(stem))) {
    }
    for (int failed = EEXIST; partial_.empty() && failed == EEXIST;) {  // no locks here
      partial_ = partial_name(stem);
      failed = ::mkdir(partial_.c_str(), 0777) == 0 ? 0 : errno;
      if (failed != 0) partial_.clear();
      if (failed != 0 && failed != EEXIST) throw output_failure(path_, "make a folder for its files", failed);
    }
    if (fs::is_directory(path_, ignored) == is_there_) return;
    give_up();
  } while (true);
}

// Tries to have the partial folder of this name, locked. False where it went while this was tried. True without partial_ where
// the file system has no locks.
bool OutputFolder::has_claimed(const fs::path& partial) {
  const bool is_made = ::mkdir(partial.c_str(), 0777) == 0;
  if (!is_made && errno != EEXIST) throw output_failure(path_, "make a folder for its files", errno);
  lock_ = ::open(partial.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 && errno == ENOENT) return false;
  if (lock_ < 0) throw output_failure(path_, "open the folder for its files", errno);
  const bool is_locked = ::flock(lock_, LOCK_EX | LOCK_NB) == 0;
  const int reason = is_locked ? 0 : errno;
  struct stat ours {
  }, there{};
  const bool is_that = ::fstat(lock_, &ours) == 0 && ::stat(partial.c_str(), &there) == 0 && ours.st_ino == there.st_ino;
  if (!is_locked || !is_that) {
    ::close(std::exchange(lock_, -1));
    if (reason == EWOULDBLOCK)
      throw OutputError(path_.string() + ": another run is writing this folder; give each run a folder of its own");
    if (!is_locked && is_made) ::rmdir(partial.c_str());
    return !is_locked;
  }
  partial_ = partial;
  std::error_code ignored;
  std::vector<fs::path> left;  // by a process that was killed
  for (const fs::directory_entry& entry : fs::directory_iterator(partial_, ignored)) left.push_back(entry.path());
  for (const fs::path& one : left) fs::remove_all(one, ignored);
  return true;
}

// Removed before it is unlocked: no other process can have a folder of this name in between and lose it.
void OutputFolder::give_up() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(std::exchange(partial_, {}), ignored);
  if (lock_ >= 0) ::close(std::exchange(lock_, -1));
}

OutputFolder::~OutputFolder() {
  give_up();
}

bool OutputFolder::is_for_an_empty_path() const {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path_, ignored))) return true;
  if (!fs::is_directory(path_, ignored)) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, ignored))
    if (entry.path().filename() != partial_.filename()) return false;
  return true;
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
  if (!is_there_) partial_.clear();
  give_up();  // with the files that were replaced
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
