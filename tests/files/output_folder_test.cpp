// SPDX-License-Identifier: BSD-3-Clause
// Folders of files that appear whole or not at all, and that one process has at a time.

#include "files/output_folder.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <utility>

#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::files {
namespace {

using tests::TemporaryDirectory;

TEST(output_folder, appears_whole_at_commit) {
  const TemporaryDirectory directory;
  OutputFolder folder(directory.file("made/plots/"));
  folder.write("a.svg", "a");
  std::filesystem::create_directory(folder.so_far() / "inner");
  OutputFile inner(folder.so_far() / "inner/b.svg");
  inner.stream() << "b";
  inner.commit();
  EXPECT_FALSE(std::filesystem::exists(directory.file("made/plots")));
  folder.commit();
  EXPECT_EQ(directory.read("made/plots/a.svg"), "a");
  EXPECT_EQ(directory.read("made/plots/inner/b.svg"), "b");
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(directory.file("made"))), 1);
}

TEST(output_folder, keeps_the_other_files_of_a_folder_that_is_there) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("there"));
  directory.write("there/mine.txt", "mine");
  directory.write("there/a.svg", "old");
  OutputFolder folder(directory.file("there"));
  folder.write("a.svg", "new");
  folder.write("b.svg", "b");
  EXPECT_EQ(directory.read("there/a.svg"), "old");
  folder.commit();
  EXPECT_EQ(directory.read("there/a.svg"), "new");
  EXPECT_EQ(directory.read("there/b.svg"), "b");
  EXPECT_EQ(directory.read("there/mine.txt"), "mine");
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(directory.file("there"))), 3);
}

TEST(output_folder, replaces_no_folder_and_no_link_of_that_name) {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory.file("there/b.svg"));
  directory.write("there/b.svg/mine.txt", "mine");
  OutputFolder folder(directory.file("there"));
  folder.write("a.svg", "a");
  folder.write("b.svg", "b");
  EXPECT_THROW(folder.commit(), OutputError);
  EXPECT_EQ(directory.read("there/b.svg/mine.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(directory.file("there/a.svg")));
}

// A file on which another one is mounted cannot be renamed: the second of three fails after the first was put in place.
TEST(output_folder, undoes_what_it_put_in_place_when_a_later_file_fails) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("there"));
  for (const char* name : {"there/a.svg", "there/c.svg", "other"}) directory.write(name, "old");
  if (::mount(directory.file("other").c_str(), directory.file("there/c.svg").c_str(), nullptr, MS_BIND, nullptr) != 0)
    GTEST_SKIP() << "this process may not mount";
  {
    OutputFolder folder(directory.file("there"));
    for (const char* name : {"a.svg", "b.svg", "c.svg"}) folder.write(name, "new");
    EXPECT_EQ(tests::thrown_by<OutputError>([&] { folder.commit(); }),
              directory.file("there/c.svg") + ": cannot put in place: Device or resource busy");
  }
  EXPECT_EQ(::umount(directory.file("there/c.svg").c_str()), 0);
  EXPECT_EQ(directory.read("there/a.svg"), "old");
  EXPECT_EQ(directory.read("there/c.svg"), "old");
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(directory.file("there"))), 2);
}

// A file system of 64 kB, which is full after the second file.
TEST(output_folder, leaves_nothing_on_a_disk_that_fills_up_and_names_the_file) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("disk"));
  if (::mount("none", directory.file("disk").c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "this process may not mount";
  for (const char* there : {"", "there"}) {
    const std::string path = directory.file("disk/plots");
    if (*there != '\0') std::filesystem::create_directory(path);
    EXPECT_EQ(tests::thrown_by<OutputError>([&] {
                OutputFolder folder(path);
                for (const char* name : {"a.svg", "b.svg", "c.svg"}) folder.write(name, std::string(30000, 'x'));
                folder.commit();
              }),
              path + "/c.svg: cannot write: No space left on device");
    EXPECT_EQ(std::filesystem::exists(path), *there != '\0');
    EXPECT_TRUE(*there == '\0' || std::filesystem::is_empty(path));
    EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(directory.file("disk"))), *there == '\0' ? 0 : 1);
  }
  // The folder may be the mount point itself: a file cannot be renamed from one file system into another.
  OutputFolder whole_disk(directory.file("disk"));
  whole_disk.write("a.svg", "a");
  EXPECT_NO_THROW(whole_disk.commit());
  EXPECT_EQ(directory.read("disk/a.svg"), "a");
  EXPECT_EQ(::umount(directory.file("disk").c_str()), 0);
}

// Refuses a second folder at a path, new or there before, whatever it was made for, until the first has ended.
TEST(output_folder, has_a_path_alone_until_it_ends) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("there"));
  std::filesystem::create_directory_symlink("there", directory.file("link"));
  for (const auto& [first, second] :
       {std::pair<const char*, const char*>{"new", "new/"}, {"there", "there"}, {"there", "link"}}) {
    for (const bool is_committed : {false, true}) {
      {
        OutputFolder folder(directory.file(first));
        folder.write("a.svg", "a");
        const std::string named = std::filesystem::path(second).has_filename() ? second : first;
        EXPECT_EQ(tests::thrown_by<OutputError>([&, second = second] { const OutputFolder other(directory.file(second)); }),
                  directory.file(named) + ": another run is writing this folder; give each run a folder of its own");
        EXPECT_TRUE(std::filesystem::exists(folder.so_far() / "a.svg")) << "the second one took it away";
        if (is_committed) folder.commit();
      }
      EXPECT_NO_THROW(OutputFolder(directory.file(second)));
      EXPECT_EQ(std::filesystem::exists(directory.file(first) + "/a.svg"), is_committed);
    }
    std::filesystem::remove(directory.file(first) + "/a.svg");
  }
  // Nothing is left but the folders.
  EXPECT_EQ(directory.entries(), 3);
  for (const char* name : {"new", "there"}) EXPECT_TRUE(std::filesystem::is_empty(directory.file(name))) << name;
}

// The partial name has room for 238 bytes.
TEST(output_folder, has_a_longest_name_alone_however_it_is_written) {
  const TemporaryDirectory directory;
  const std::string stem = directory.file(std::string(238, 'a'));
  const OutputFolder folder(stem + "b");
  EXPECT_NO_THROW(OutputFolder{stem});
  EXPECT_NO_THROW(OutputFolder(stem + "c"));
  EXPECT_NO_THROW(OutputFolder(stem + std::string(17, 'b')));
  EXPECT_THROW(OutputFolder(std::filesystem::relative(stem + "b")), OutputError);
}

// A folder that somebody else put there meanwhile stays, and is not mixed with what was written.
TEST(output_folder, does_not_mix_with_a_path_that_came_meanwhile) {
  const TemporaryDirectory directory;
  OutputFolder folder(directory.file("new"));
  folder.write("a.svg", "a");
  std::filesystem::create_directory(directory.file("new"));
  directory.write("new/b.svg", "b");
  EXPECT_THROW(folder.commit(), OutputError);
  EXPECT_EQ(directory.read("new/b.svg"), "b");
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(directory.file("new"))), 1);
}

// A process that was killed leaves its partial folder, with files and folders, and no lock.
TEST(output_folder, removes_what_a_killed_process_left) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("there"));
  for (const char* name : {"new", "there"}) {
    const pid_t process = ::fork();
    if (process == 0) {
      const OutputFolder folder(directory.file(name));
      folder.write("old.svg", "old");
      std::filesystem::create_directory(folder.so_far() / "inner");
      ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(process, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    OutputFolder folder(directory.file(name));
    EXPECT_TRUE(folder.is_for_an_empty_path()) << name;
    folder.write("a.svg", "a");
    folder.commit();
    EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(directory.file(name))), 1) << name;
  }
  EXPECT_EQ(directory.entries(), 2);
}

TEST(output_folder, says_whether_its_path_is_empty) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("empty"));
  directory.write("file", "");
  EXPECT_TRUE(OutputFolder(directory.file("new")).is_for_an_empty_path());
  EXPECT_TRUE(OutputFolder(directory.file("empty")).is_for_an_empty_path());
  EXPECT_FALSE(OutputFolder(directory.path()).is_for_an_empty_path());
  EXPECT_FALSE(OutputFolder(directory.file("file")).is_for_an_empty_path());
}

TEST(output_folder, has_a_name_in_messages_under_which_it_will_appear) {
  EXPECT_EQ(final_name("out/plots.partial-0123abcd/a.svg"), "out/plots/a.svg");
  EXPECT_EQ(final_name("plots/.partial-0123abcd/inner/a.svg"), "plots/inner/a.svg");
  EXPECT_EQ(final_name("a.svg.partial-0123abcd"), "a.svg");
  for (const char* plain : {"a.partial-012.svg", "x.partial-0123abcde/a", "partial-0123abcd/a"})
    EXPECT_EQ(final_name(plain), plain);
}

}  // namespace
}  // namespace forceshade::files
