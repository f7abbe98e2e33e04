// SPDX-License-Identifier: BSD-3-Clause
// Files that appear whole or not at all, on disks, pipes and devices.

#include "files/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include "files/output_folder.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::files {
namespace {

using tests::TemporaryDirectory;

std::string words_of(const std::string& word, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += word;
  return all;
}

TEST(output_file, appears_whole_at_commit) {
  const TemporaryDirectory directory;
  directory.write("out.csv", "before");
  OutputFile file(directory.file("out.csv"));
  file.stream() << "after";
  file.stream().flush();
  EXPECT_EQ(directory.read("out.csv"), "before");
  EXPECT_EQ(directory.entries(), 2);
  file.commit();
  EXPECT_EQ(directory.read("out.csv"), "after");
  EXPECT_EQ(directory.entries(), 1);
}

// The partial name is longer than the name by 17 bytes, and no name has more than 255.
TEST(output_file, may_have_the_longest_name_that_there_is) {
  const TemporaryDirectory directory;
  for (const std::string& name : {std::string(255, 'a'), std::string(239, 'b'), "c" + words_of("\u00e4", 127)}) {
    write_file(directory.file(name), name);
    EXPECT_EQ(directory.read(name), name);
    OutputFolder folder(directory.file("in/" + name));
    folder.write("in", name);
    folder.commit();
    EXPECT_EQ(directory.read("in/" + name + "/in"), name);
  }
  EXPECT_EQ(with_ending("a/b", ".end"), "a/b.end");
  EXPECT_EQ(with_ending("a/" + words_of("\u00e4", 127), "0123"), "a/" + words_of("\u00e4", 125) + "0123");
  EXPECT_EQ(with_ending("a/" + std::string(300, 'b'), "0123").size(), 257);
}

// Two runs with one name: the one that ends last was to replace nothing, or what it had seen.
TEST(output_file, replaces_no_file_that_another_program_put_there_meanwhile) {
  for (const char* before : {"", "before"}) {
    const TemporaryDirectory directory;
    if (*before != '\0') directory.write("out.csv", before);
    OutputFile slow(directory.file("out.csv"));
    slow.stream() << "slow";
    write_file(directory.file("out.csv"), "quick");
    const std::string words = tests::thrown_by<OutputError>([&] { slow.commit(); });
    tests::expect_words(words,
                        {"out.csv: another program has written it meanwhile; what this one wrote is in ", "out.csv.partial-"});
    EXPECT_EQ(directory.read("out.csv"), "quick");
    const std::string kept = words.substr(words.rfind("out.csv.partial-"));
    EXPECT_EQ(directory.read(kept), "slow");
  }
}

TEST(output_file, replaces_no_file_to_which_another_program_wrote_meanwhile) {
  const TemporaryDirectory directory;
  directory.write("out.csv", "before");
  OutputFile slow(directory.file("out.csv"));
  directory.write("out.csv", "before and after");  // in place
  EXPECT_NE(tests::thrown_by<OutputError>([&] { slow.commit(); }).find("another program has written it meanwhile"),
            std::string::npos);
  EXPECT_EQ(directory.read("out.csv"), "before and after");
}

TEST(output_file, makes_and_replaces_what_a_symbolic_link_points_to) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("other"));
  std::filesystem::create_symlink("other/target.csv", directory.file("second.csv"));
  std::filesystem::create_symlink("second.csv", directory.file("first.csv"));
  for (const std::string text : {"new", "after"}) {
    write_file(directory.file("first.csv"), text);
    EXPECT_EQ(directory.read("other/target.csv"), text);
    for (const char* link : {"first.csv", "second.csv"}) EXPECT_TRUE(std::filesystem::is_symlink(directory.file(link))) << link;
  }
}

TEST(output_file, tells_why_it_cannot_be_opened) {
  const TemporaryDirectory directory;
  std::filesystem::create_symlink("absent/out.csv", directory.file("loose.csv"));
  std::filesystem::create_symlink("round.csv", directory.file("round.csv"));
  std::filesystem::create_directory(directory.file("folder"));
  for (const auto& [name, words] :
       {std::pair{"loose.csv", "absent/out.csv: cannot open for writing: No such file or directory"},
        {"round.csv", "round.csv: cannot open for writing: Too many levels of symbolic links"},
        {"absent/out.csv", "absent/out.csv: cannot open for writing: No such file or directory"},
        {"folder", "folder: cannot open for writing: Is a directory"}})
    EXPECT_EQ(tests::thrown_by<OutputError>([&, name = name] { const OutputFile file(directory.file(name)); }),
              directory.file(words));
  for (const char* link : {"loose.csv", "round.csv"}) EXPECT_TRUE(std::filesystem::is_symlink(directory.file(link))) << link;
}

TEST(output_file, writes_to_a_device_and_leaves_it_in_place) {
  OutputFile file("/dev/null");
  file.stream() << "nothing";
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(output_file, tells_that_the_disk_is_full) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  OutputFile at_commit("/dev/full");
  at_commit.stream() << "little";
  OutputFile while_writing("/dev/full");
  const auto fill = [&] {
    for (;;) while_writing.stream() << "much more than a buffer holds";
  };
  for (const std::function<void()>& write : {std::function<void()>([&] { at_commit.commit(); }), std::function<void()>(fill)}) {
    EXPECT_EQ(tests::thrown_by<OutputError>(write), "/dev/full: cannot write: No space left on device");
  }
}

// A file-size limit stands for a disk that fills up: the partial file is there, and must go.
TEST(output_file, leaves_nothing_when_the_disk_fills_up) {
  const TemporaryDirectory directory;
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 100000, .rlim_max = old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto fill = [&] {
    OutputFile file(directory.file("out.csv"));
    for (int i = 0; i < 100000; ++i) file.stream() << i << '\n';
    file.commit();
  };
  EXPECT_THROW(fill(), OutputError);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(directory.entries(), 0);
}

// The text that a program reads from the other end of a pipe while `write` runs.
std::string read_from_pipe(const std::function<void(int)>& write) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return "no pipe";
  write(ends[1]);
  ::close(ends[1]);
  std::string text(64, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(ends[0], text.data(), text.size()), 0)));
  ::close(ends[0]);
  return text;
}

TEST(output_file, writes_to_an_open_descriptor) {
  for (const std::string& folder :
       {std::string("/dev/fd/"), std::string("/proc/self/fd/"), "/proc/" + std::to_string(::getpid()) + "/fd/"})
    EXPECT_EQ(read_from_pipe([&](int end) {
                const std::string path = folder + std::to_string(end);
                EXPECT_TRUE(is_written_directly(path)) << path;
                EXPECT_FALSE(is_standard_output(path)) << path;
                OutputFile file(path);
                file.stream() << "a row";
                file.commit();
              }),
              "a row")
        << folder;
}

// As `>> log` of a shell: what is there stays, and no other file takes its place.
TEST(output_file, goes_on_where_an_open_regular_file_is) {
  const TemporaryDirectory directory;
  directory.write("log", "before ");
  const int log = ::open(directory.file("log").c_str(), O_WRONLY | O_APPEND);
  OutputFile file("/dev/fd/" + std::to_string(log));
  file.stream() << "after";
  file.commit();
  ::close(log);
  EXPECT_EQ(directory.read("log"), "before after");
  EXPECT_EQ(directory.entries(), 1);
}

TEST(output_file, does_not_write_to_a_descriptor_that_is_only_read) {
  const TemporaryDirectory directory;
  directory.write("in", "");
  const int in = ::open(directory.file("in").c_str(), O_RDONLY);
  const std::string path = "/dev/fd/" + std::to_string(in);
  EXPECT_EQ(tests::thrown_by<OutputError>([&] { const OutputFile file(path); }),
            path + ": cannot open for writing: Bad file descriptor");
  ::close(in);
}

TEST(output_file, waits_for_room_in_a_pipe_that_does_not_block) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_NONBLOCK), 0);
  const std::string sent(1 << 20, 'x');
  std::string got;
  std::thread reader([&] {
    std::array<char, 4096> bytes{};
    for (ssize_t n = 1; n != 0;) {
      n = ::read(ends[0], bytes.data(), bytes.size());
      if (n > 0) got.append(bytes.data(), static_cast<std::size_t>(n));
      if (n < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  {
    OutputFile file("/dev/fd/" + std::to_string(ends[1]));
    file.stream() << sent;
    file.commit();
  }
  ::close(ends[1]);
  reader.join();
  ::close(ends[0]);
  EXPECT_EQ(got, sent);
}

TEST(output_file, tells_standard_output_from_other_names) {
  EXPECT_TRUE(is_standard_output("-"));
  EXPECT_TRUE(is_standard_output("/dev/stdout"));
  EXPECT_TRUE(is_standard_output("/dev/fd/1"));
  EXPECT_FALSE(is_standard_output("/dev/stderr"));
  EXPECT_TRUE(is_written_directly("/dev/stderr"));
  EXPECT_TRUE(is_written_directly("/dev/null"));
  const TemporaryDirectory directory;
  directory.write("file", "");
  ASSERT_EQ(::mkfifo(directory.file("pipe").c_str(), 0600), 0);
  EXPECT_TRUE(is_written_directly(directory.file("pipe")));
  for (const char* name : {"file", "absent", "."}) EXPECT_FALSE(is_written_directly(directory.file(name))) << name;
}

}  // namespace
}  // namespace forceshade::files
