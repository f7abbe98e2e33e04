// SPDX-License-Identifier: BSD-3-Clause
// The order in which bytes and names reach the disk: a name never before its bytes, and no fault of the disk without a word.

#include <gtest/gtest.h>
#include <stdio.h>  // NOLINT(modernize-deprecated-headers): renameat2
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "files/output_folder.h"
#include "files/written_once.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace {

namespace fs = std::filesystem;

// The calls that concern what lies in one folder, and the one of them that fails, with this reason.
struct Disk {
  std::string folder = {}, failing = {};
  int reason = EIO;
  std::vector<std::string> calls = {};

  // Nonzero where the call fails.
  int called(const char* what, const std::string& path) {
    if (folder.empty() || !path.starts_with(folder) || path.ends_with(" (deleted)")) return 0;
    const fs::path within = fs::path(forceshade::files::final_name(path)).lexically_relative(folder);
    const std::string call = std::string(what) + ' ' + (within.has_filename() ? within : within.parent_path()).string();
    calls.push_back(call);
    if (call != failing) return 0;
    errno = reason;
    return -1;
  }
  int called(const char* what, int descriptor) {
    std::error_code ignored;
    return called(what, fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), ignored).string());
  }
};
Disk disk;

}  // namespace

// Stand before those of the C library in this program.
extern "C" int fsync(int descriptor) {
  return disk.called("sync", descriptor) != 0 ? -1 : static_cast<int>(::syscall(SYS_fsync, descriptor));
}
extern "C" int close(int descriptor) {
  const int failed = disk.called("close", descriptor), reason = errno;
  const int result = static_cast<int>(::syscall(SYS_close, descriptor));
  if (failed != 0) errno = reason;
  return failed != 0 ? -1 : result;
}
extern "C" int rename(const char* from, const char* to) noexcept {
  return disk.called("name", std::string(to)) != 0 ? -1 : static_cast<int>(::syscall(SYS_rename, from, to));
}
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned how) noexcept {
  if (disk.called("name", std::string(to)) != 0) return -1;
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, how));
}
extern "C" int link(const char* from, const char* to) noexcept {
  return disk.called("name", std::string(to)) != 0 ? -1 : static_cast<int>(::syscall(SYS_link, from, to));
}

namespace forceshade::files {
namespace {

using Calls = std::vector<std::string>;

struct Case {
  const char *what, *name;  // name: of the file that appears
  std::function<void(const std::string& folder)> write;
  Calls calls;
};

const std::vector<Case>& all() {
  static const std::vector<Case> kAll{
      {"a file",
       "out.csv",
       [](const std::string& folder) { write_file(folder + "/out.csv", "text"); },
       {"sync out.csv", "close out.csv", "name out.csv", "sync .", "close ."}},
      {"a file that is written once",
       "plan.json",
       [](const std::string& folder) { write_once(folder + "/plan.json", "text"); },
       {"sync .plan.json", "close .plan.json", "name plan.json", "sync .", "close ."}},
      {"a folder",
       "set/out.csv",
       [](const std::string& folder) {
         OutputFolder made(folder + "/set");
         made.write("out.csv", "text");
         made.commit();
       },
       {"sync set/out.csv", "close set/out.csv", "name set/out.csv", "sync set", "close set", "sync set", "close set",
        "name set", "close set", "sync .", "close ."}},
      {"a folder in a folder",
       "set/inner/out.csv",
       [](const std::string& folder) {
         OutputFolder made(folder + "/set");
         fs::create_directory(made.so_far() / "inner");
         write_file(made.so_far() / "inner/out.csv", "text");
         made.commit();
       },
       {"sync set/inner/out.csv", "close set/inner/out.csv", "name set/inner/out.csv", "sync set/inner", "close set/inner",
        "sync set/inner", "close set/inner", "sync set", "close set", "name set", "close set", "sync .", "close ."}},
      {"files of a folder that is there",
       "set/out.csv",
       [](const std::string& folder) {
         fs::create_directory(folder + "/set");
         OutputFolder made(folder + "/set");
         made.write("out.csv", "text");
         made.commit();
       },
       {"sync set/out.csv", "close set/out.csv", "name set/out.csv", "sync set", "close set", "sync set", "close set",
        "name set/out.csv", "sync set", "close set"}},
  };
  return kAll;
}

// The words of the failure; empty where nothing failed.
std::string words_of(const Case& it, const std::string& folder, const std::string& failing, int reason) {
  disk = {.folder = folder, .failing = failing, .reason = reason};
  const std::string words = tests::thrown_by<OutputError>([&] { it.write(folder); });
  disk.folder.clear();
  return words;
}

TEST(disk_order, has_the_bytes_before_the_name_and_the_name_before_the_end) {
  for (const Case& it : all()) {
    SCOPED_TRACE(it.what);
    const tests::TemporaryDirectory directory;
    EXPECT_EQ(words_of(it, directory.path(), "", 0), "");
    EXPECT_EQ(disk.calls, it.calls);
    EXPECT_EQ(directory.read(it.name), "text");
  }
}

TEST(disk_order, says_every_fault_of_the_disk_and_leaves_no_name_without_its_bytes) {
  int failed = 0;
  for (const Case& it : all()) {
    const auto named = std::ranges::find(it.calls, "name " + std::string(it.name));
    for (auto call = it.calls.begin(); call != it.calls.end(); ++call) {
      const bool is_of_folder = call->starts_with("close ") && !call->ends_with(".csv") && !call->ends_with(".json");
      // Nothing was written through a folder.
      if (is_of_folder || std::find(it.calls.begin(), call, *call) != call) continue;
      SCOPED_TRACE(std::string(it.what) + ": " + *call);
      const tests::TemporaryDirectory directory;
      EXPECT_NE(words_of(it, directory.path(), *call, EIO).find("Input/output error"), std::string::npos);
      EXPECT_TRUE(call > named || !fs::exists(directory.file(it.name)));
      ++failed;
    }
  }
  EXPECT_EQ(failed, 4 + 4 + 6 + 7 + 4);
}

// A file system may have nothing to sync of a folder.
TEST(disk_order, takes_a_folder_that_cannot_be_synced_and_no_file) {
  for (const auto& [failing, is_fault] : {std::pair{"sync .", false}, {"sync out.csv", true}}) {
    const tests::TemporaryDirectory directory;
    EXPECT_EQ(words_of(all().front(), directory.path(), failing, EINVAL).empty(), !is_fault) << failing;
  }
}

TEST(written_once, says_who_came_first_and_leaves_what_is_there) {
  const tests::TemporaryDirectory directory;
  for (const auto& [text, result] : {std::pair{"first", Written::now},
                                     {"first", Written::before},
                                     {"other", Written::differs},
                                     {"first", Written::before}}) {
    EXPECT_EQ(write_once(directory.file("plan.json"), text), result) << text;
    EXPECT_EQ(directory.read("plan.json"), "first");
    EXPECT_EQ(directory.entries(), 1);
  }
}

}  // namespace
}  // namespace forceshade::files
