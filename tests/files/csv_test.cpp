// SPDX-License-Identifier: BSD-3-Clause
#include "files/csv.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <thread>

#include "files/output_file.h"
#include "files/output_folder.h"
#include "files/printable.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::files {
namespace {

using tests::TemporaryDirectory;

// Reads the columns "a" and "b" as binary32.
std::vector<std::pair<float, float>> rows_of(const std::string& text) {
  std::istringstream in(text);
  Reader reader(in, "f.csv", {"a", "b"});
  std::vector<std::pair<float, float>> rows;
  while (reader.next()) rows.emplace_back(reader.binary32(0), reader.binary32(1));
  return rows;
}

std::string error_of(const std::string& text) {
  try {
    rows_of(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

float number(const std::string& text) {
  return rows_of("a,b\n" + text + ",0\n").at(0).first;
}

using Rows = std::vector<std::pair<float, float>>;

TEST(csv, reads_named_columns_in_any_order_and_ignores_others) {
  EXPECT_EQ(rows_of("b,note,a\n2,x,1\n4,y,3\n"), (Rows{{1, 2}, {3, 4}}));
}

TEST(csv, accepts_crlf_a_byte_order_mark_blank_lines_and_a_missing_last_newline) {
  EXPECT_EQ(rows_of(std::string("\xEF\xBB\xBF") + "a,b\r\n\r\n1,2\r\n \t\r\n\r\n3,4"), (Rows{{1, 2}, {3, 4}}));
  EXPECT_EQ(rows_of("a,b\r\n1,2\r"), (Rows{{1, 2}}));
}

TEST(csv, accepts_spaces_and_quotes_around_a_field) {
  EXPECT_EQ(rows_of("\"a\" , b\n \"1\",\t2 \n"), (Rows{{1, 2}}));
}

TEST(csv, keeps_quoted_commas_quotes_and_newlines) {
  std::istringstream in("a,b\n\"x, \"\"y\"\"\n\nz\",2\n3,4\n");
  Reader reader(in, "f.csv", {"a"});
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.text(0), "x, \"y\"\n\nz");
  EXPECT_EQ(reader.line(), 2U);
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.line(), 5U);
  EXPECT_FALSE(reader.next());
}

TEST(csv, reads_decimals_and_hexfloats) {
  EXPECT_EQ(number("+1.5"), 1.5F);
  EXPECT_EQ(number("-2e-3"), -2e-3F);
  EXPECT_EQ(number(".5"), 0.5F);
  EXPECT_EQ(number("0x1.8p+3"), 12.0F);
  EXPECT_EQ(number("-0x1p-3"), -0.125F);
  EXPECT_EQ(number("+0XAp0"), 10.0F);
  EXPECT_TRUE(std::signbit(number("-0")));
}

TEST(csv, rounds_to_nearest_with_ties_to_even) {
  EXPECT_EQ(number("1.000000059604644775390625"), 1.0F);
  EXPECT_EQ(number("1.000000059604644775390626"), 0x1.000002p0F);
  EXPECT_EQ(number("0x1.000003p0"), 0x1.000004p0F);
  EXPECT_EQ(number("0x5.fbdaa4p-131"), 0x1.7ef6ap-129F);
  EXPECT_EQ(number("1e-45"), std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(number("1e-60"), 0.0F);
  EXPECT_EQ(number("0x1p-150"), 0.0F);
  EXPECT_EQ(number("-1e39"), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(number("0x1p128"), std::numeric_limits<float>::infinity());
}

TEST(csv, reads_nan_and_infinity) {
  EXPECT_TRUE(std::isnan(number("nan")));
  EXPECT_TRUE(std::isnan(number("NaN")));
  EXPECT_EQ(number("-inf"), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(number("+Infinity"), std::numeric_limits<float>::infinity());
}

TEST(csv, reads_binary64) {
  std::istringstream in("t_s\n0.1\n0x1.23456789abcdep0\n");
  Reader reader(in, "f.csv", {"t_s"});
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.binary64(0), 0.1);
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.binary64(0), 0x1.23456789abcdep0);
}

TEST(csv, refuses_what_is_not_wholly_a_number) {
  for (const char* text :
       {"abc", "", "1.5mm", "1 2", "+-1", "++1", "0x", "0x-1", "0xnan", "-+1", "1e", ".", "--1", "1f", "0x1p"})
    EXPECT_EQ(error_of("b,a\n1,2\n1," + std::string(text) + "\n"),
              "f.csv:3: column 2 (a): expected a number, got \"" + std::string(text) + '"');
}

TEST(csv, shows_a_long_value_in_short) {
  const std::string shown = error_of("a,b\n1,\"" + std::string(50, '\n') + std::string(500, 'x') + "\"\n");
  EXPECT_LT(shown.size(), 200U);
  EXPECT_EQ(shown.find('\n'), std::string::npos);
  EXPECT_TRUE(shown.ends_with("xxx...\"")) << shown;
}

TEST(csv, names_what_is_wrong_with_the_header) {
  EXPECT_EQ(error_of(""), "f.csv:1: expected a header row with columns a, b, got an empty file");
  EXPECT_EQ(error_of("\n \n"), "f.csv:1: expected a header row with columns a, b, got an empty file");
  EXPECT_EQ(error_of("\na,c\n"), "f.csv:2: no column b: expected columns a, b, got \"a, c\"");
  EXPECT_EQ(error_of("a,b,c,a\n"), "f.csv:1: columns 1 and 4 are both called a");
  EXPECT_EQ(error_of("a,b,c,c\n"), "no error");
}

TEST(csv, names_the_line_of_a_row_with_too_few_or_too_many_fields) {
  EXPECT_EQ(error_of("a,x,b\n1,2,3\n\n4,5\n"), "f.csv:4: expected 3 fields, got 2: column 3 (b) is missing");
  EXPECT_EQ(error_of("a,b\n1,2,3\n"), "f.csv:2: expected 2 fields, got 3: column 3 has no name in the header");
}

TEST(csv, counts_lines_as_an_editor_does) {
  EXPECT_EQ(error_of("a,b,note\r\n1,2,\"two\r\nlines\"\r\n\r\nx,2,\r\n"),
            "f.csv:5: column 1 (a): expected a number, got \"x\"");
}

TEST(csv, names_the_place_of_a_misused_quote) {
  EXPECT_EQ(error_of("a,b\n1,2\n3,\"4\n5,6\n"),
            "f.csv:3: expected a closing quote in the row that begins here, got the end of the file");
  EXPECT_EQ(error_of("a,b\n1,2\"3\n"),
            "f.csv:2: column 2: expected quotes around a whole field and doubled inside it, got a stray one");
  EXPECT_EQ(error_of("a,b\n\"1\"2,3\n"),
            "f.csv:2: column 1: expected quotes around a whole field and doubled inside it, got a stray one");
}

TEST(csv, refuses_bytes_that_are_no_text) {
  EXPECT_EQ(error_of("a,b\n1,\xFF\n"), "f.csv:2: byte 3: expected UTF-8 text, got 0xff");
  for (const char* text : {"\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\x80", "\xF0\x8F\xBF\xBF"})
    EXPECT_NE(error_of("a,b,c\n1,2," + std::string(text) + "\n").find("expected UTF-8 text"), std::string::npos);
  EXPECT_EQ(error_of("a,b,c\n1,2,\xC2\xB5 \xE2\x82\xAC \xF0\x9F\x98\x80\n"), "no error");
  EXPECT_EQ(error_of(std::string("a,b\n1\0,2\n", 9)), "f.csv:2: byte 2: expected text, got the control character 0x00");
  EXPECT_EQ(error_of("a,b\r1,2\r"), "f.csv:1: byte 4: expected text, got the control character 0x0d");
}

TEST(csv, refuses_an_endless_row) {
  EXPECT_EQ(error_of("a,b\n" + std::string(Reader::kLongestRow + 1, '1')),
            "f.csv:2: expected at most 1048576 bytes in a row, got more");
  std::string text = "a,b\n1,\"";
  for (std::size_t line = 0; line < Reader::kLongestRow / 8; ++line) text += "1234567\n";
  EXPECT_EQ(error_of(text), "f.csv:2: expected at most 1048576 bytes in a row, got more: is a quote left open?");
}

TEST(csv, tells_why_a_file_cannot_be_read) {
  const TemporaryDirectory directory;
  const std::string absent = directory.file("absent.csv");
  try {
    open_input(absent);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), absent + ": cannot open: No such file or directory");
  }
  auto in = open_input(directory.path());
  try {
    const Reader reader(in, "d", {"a"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "d:1: cannot read: Is a directory");
  }
}

TEST(csv, shortest_reads_back_the_same) {
  EXPECT_EQ(shortest(0.1F), "0.1");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(0.0F), "0");
  EXPECT_EQ(shortest(16777216.0F), "16777216");
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random());
    const auto value = std::bit_cast<float>(bits);
    if (std::isnan(value)) continue;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(std::strtof(shortest(value).c_str(), nullptr)), bits) << shortest(value);
  }
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

TEST(output_file, leaves_nothing_without_commit) {
  const TemporaryDirectory directory;
  { OutputFile(directory.file("out.csv")).stream() << "half a row"; }
  EXPECT_EQ(directory.entries(), 0);
}

TEST(output_file, keeps_every_byte_of_a_large_file) {
  const TemporaryDirectory directory;
  std::string expected;
  OutputFile file(directory.file("out.csv"));
  for (int i = 0; i < 100000; ++i) {
    file.stream() << i << '\n';
    expected += std::to_string(i) + '\n';
  }
  file.commit();
  EXPECT_EQ(directory.read("out.csv"), expected);
}

TEST(output_file, follows_a_symbolic_link) {
  const TemporaryDirectory directory;
  directory.write("target.csv", "before");
  std::filesystem::create_symlink("target.csv", directory.file("link.csv"));
  OutputFile file(directory.file("link.csv"));
  file.stream() << "after";
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file("link.csv")));
  EXPECT_EQ(directory.read("target.csv"), "after");
}

TEST(output_file, tells_why_it_cannot_be_opened) {
  const TemporaryDirectory directory;
  try {
    const OutputFile file(directory.file("absent/out.csv"));
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), directory.file("absent/out.csv") + ": cannot open for writing: No such file or directory");
  }
  try {
    const OutputFile file(directory.path());
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), directory.path() + ": cannot open for writing: Is a directory");
  }
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
    try {
      write();
      FAIL();
    } catch (const OutputError& error) {
      EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
    }
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

// What a program reads from the other end of a pipe while `write` runs.
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
  try {
    const OutputFile file(path);
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), path + ": cannot open for writing: Bad file descriptor");
  }
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

TEST(output_folder, leaves_nothing_without_commit) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("there"));
  for (const char* name : {"new", "there"}) {
    const OutputFolder folder(directory.file(name));
    folder.write("a.svg", "a");
  }
  EXPECT_EQ(directory.entries(), 1);
  EXPECT_TRUE(std::filesystem::is_empty(directory.file("there")));
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
    try {
      folder.commit();
      ADD_FAILURE() << "a mount point was replaced";
    } catch (const OutputError& error) {
      EXPECT_EQ(error.what(), directory.file("there/c.svg") + ": cannot put in place: Device or resource busy");
    }
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
    try {
      OutputFolder folder(path);
      for (const char* name : {"a.svg", "b.svg", "c.svg"}) folder.write(name, std::string(30000, 'x'));
      folder.commit();
      ADD_FAILURE() << "it held more than it is large";
    } catch (const OutputError& error) {
      EXPECT_EQ(error.what(), path + "/c.svg: cannot write: No space left on device");
    }
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

TEST(output_folder, has_a_name_in_messages_under_which_it_will_appear) {
  EXPECT_EQ(final_name("out/plots.partial-0123abcd/a.svg"), "out/plots/a.svg");
  EXPECT_EQ(final_name("plots/.partial-0123abcd/inner/a.svg"), "plots/inner/a.svg");
  EXPECT_EQ(final_name("a.svg.partial-0123abcd"), "a.svg");
  for (const char* plain : {"a.partial-012.svg", "x.partial-0123abcde/a", "partial-0123abcd/a"})
    EXPECT_EQ(final_name(plain), plain);
}

TEST(printable, leaves_text_alone) {
  for (const std::string text : {"", "plain \\x41 text",
                                 "R = 15 mm, \xC2\xB5m, \xE2\x88\x92"
                                 "3, \xF0\x9F\x99\x82",
                                 "\xC2\xA0\xE2\x80\xAF\xE2\x81\xA0"})
    EXPECT_EQ(printable(text), text);
}

TEST(printable, shows_what_would_command_a_terminal) {
  EXPECT_EQ(printable("\x1b[2J\r\n\t\x7f"), "\\x1b[2J\\x0d\\n\\x09\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b31m");
  EXPECT_EQ(printable("\xE2\x80\xAE"
                      "gpj.exe"),
            "\\xe2\\x80\\xaegpj.exe");
  EXPECT_EQ(printable("\xFF\xC2"), "\\xff\\xc2");
}

// Whatever the bytes: no control character, none that only UTF-8 spells, and UTF-8 throughout.
TEST(printable, is_what_a_terminal_may_show_as_it_is) {
  for (const char* plain : {"", "hill.toml", "höhe", "\u00a0", "K = 3 N/mm"}) EXPECT_TRUE(is_printable(plain)) << plain;
  for (const char* control : {"\n", "a\x1b[2J", "\x7f", "\x1f", "\u0080", "\u009b", "\xc2\x9f", "\u2028", "\xFF"}) {
    EXPECT_FALSE(is_printable(control)) << printable(control);
    EXPECT_TRUE(is_printable(printable(control)));
  }
  EXPECT_TRUE(is_printable("two\nlines\n", true));
  EXPECT_TRUE(is_printable("", true));
  EXPECT_FALSE(is_printable("two\nli\tnes", true));
  EXPECT_FALSE(is_printable("two\nlines\x1b", true));
}

TEST(printable, of_any_bytes_is_safe) {
  std::mt19937 random(21);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (std::size_t k = 0; k < 12; ++k)
      text +=
          static_cast<char>(random() % 3 == 0 ? random() : std::array{0x1B, 0xC2, 0x9B, 0xE2, 0x80, 0xAE, 0x85}[random() % 7]);
    const std::string shown = printable(text);
    for (std::size_t at = 0; at < shown.size();) {
      const std::size_t size = character_size(std::string_view(shown).substr(at));
      ASSERT_GT(size, 0U);
      const std::string character = shown.substr(at, size);
      const auto first = static_cast<unsigned char>(character[0]);
      ASSERT_TRUE(first >= 0x20 && first != 0x7F);
      ASSERT_FALSE(first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
      ASSERT_NE(character, "\xE2\x80\xAE");
      at += size;
    }
    EXPECT_EQ(printable(shown), shown);
  }
}

// C1 control characters are text to UTF-8, and commands to a terminal.
TEST(csv, errors_quote_fields_without_control_characters) {
  EXPECT_EQ(error_of("a,b\n1,\xC2\x9B"
                     "31mred\n"),
            "f.csv:2: column 2 (b): expected a number, got \"\\xc2\\x9b31mred\"");
}

}  // namespace
}  // namespace forceshade::files
