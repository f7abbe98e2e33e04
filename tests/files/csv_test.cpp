// SPDX-License-Identifier: BSD-3-Clause
// CSV files and the numbers in them: what is read, what is refused and in which words.

#include "files/csv.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <sstream>

#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

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
  return tests::thrown_by<Error>([&] { rows_of(text); });
}

float number(const std::string& text) {
  return rows_of("a,b\n" + text + ",0\n").at(0).first;
}

using Rows = std::vector<std::pair<float, float>>;

// In any order of the columns, with others between them, CRLF, a byte-order mark, blank lines, no last newline, spaces, quotes
// and Excel's line in front.
TEST(csv, reads_named_columns_however_they_are_written) {
  for (const char* text :
       {"b,note,a\n2,x,1\n4,y,3\n",
        "\xEF\xBB\xBF"
        "a,b\r\n\r\n1,2\r\n \t\r\n\r\n3,4",
        "a,b\r\n1,2\r\n3,4\r", "\"a\" , b\n \"1\",\t2 \n3,4", "sep=,\r\na,b\n1,2\n3,4", "\"sep=,\"\na,b\n1,2\n3,4"})
    EXPECT_EQ(rows_of(text), (Rows{{1, 2}, {3, 4}})) << text;
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

TEST(csv, reads_decimals_and_hexfloats_and_rounds_to_nearest_with_ties_to_even) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  for (const auto& [text, expected] : {std::pair{"+1.5", 1.5F},
                                       {"-2e-3", -2e-3F},
                                       {".5", 0.5F},
                                       {"0x1.8p+3", 12.0F},
                                       {"-0x1p-3", -0.125F},
                                       {"+0XAp0", 10.0F},
                                       {"1.000000059604644775390625", 1.0F},
                                       {"1.000000059604644775390626", 0x1.000002p0F},
                                       {"0x1.000003p0", 0x1.000004p0F},
                                       {"0x5.fbdaa4p-131", 0x1.7ef6ap-129F},
                                       {"1e-45", std::numeric_limits<float>::denorm_min()},
                                       {"1e-60", 0.0F},
                                       {"0x1p-150", 0.0F},
                                       {"-1e39", -kInfinite},
                                       {"0x1p128", kInfinite},
                                       {"-inf", -kInfinite},
                                       {"+Infinity", kInfinite}})
    EXPECT_EQ(number(text), expected) << text;
  EXPECT_TRUE(std::signbit(number("-0")));
  for (const char* nan : {"nan", "NaN"}) EXPECT_TRUE(std::isnan(number(nan)));
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

// The lines are counted as an editor does; C1 control characters are text to UTF-8, and commands to a terminal.
TEST(csv, names_the_place_of_what_is_wrong) {
  const std::string header = "expected a header row with columns a, b, got an empty file",
                    quote = "expected quotes around a whole field and doubled inside it, got a stray one",
                    semicolons = "expected commas between the columns, and points in decimals, got semicolons in ";
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "1: " + header},
           {"\n \n", "1: " + header},
           {"\na,c\n", "2: no column b: expected columns a, b, got \"a, c\""},
           {"GIF8x,a\n", " expected a CSV file, got a GIF picture"},
           {"\x1f\x8b\x08\x01", " expected a CSV file, got a gzip archive"},
           {"PK\x03\x04\x14", " expected a CSV file, got a ZIP archive"},
           {"\x7f"
            "ELF\x02",
            " expected a CSV file, got a program"},
           {"\xd0\xcf\x11\xe0", " expected a CSV file, got an Excel or another Office file"},
           {"\x89HDF\r\n", " expected a CSV file, got an HDF5 file"},
           {"sep=;\na;b\n", "1: " + semicolons + "\"sep=;\""},
           {"\"sep=;\"\na;b\n", "1: " + semicolons + "\"sep=;\""},
           {"sep=,\n", "1: " + header},
           {"sep=;,\n", "1: no column a: expected columns a, b, got \"sep=;, \""},
           {"sep = 1\n", " expected a CSV file, got a TOML file"},
           {"a \t\n", "1: no column b: expected columns a, b, got \"a\""},
           {"a,b,c,a\n", "1: columns 1 and 4 are both called a"},
           {"a,x,b\n1,2,3\n\n4,5\n", "4: expected 3 fields, got 2: column 3 (b) is missing"},
           {"a,b\n1,2,3\n", "2: expected 2 fields, got 3: column 3 has no name in the header"},
           {"a,b,note\r\n1,2,\"two\r\nlines\"\r\n\r\nx,2,\r\n", "5: column 1 (a): expected a number, got \"x\""},
           {"a,b\n1,2\n3,\"4\n5,6\n", "3: expected a closing quote in the row that begins here, got the end of the file"},
           {"a,b\n1,2\"3\n", "2: column 2: " + quote},
           {"a,b\n\"1\"2,3\n", "2: column 1: " + quote},
           {"a,b\n1,\xFF\n", "2: byte 3: expected UTF-8 text, got 0xff"},
           {std::string("a,b\n1\0,2\n", 9), "2: byte 2: expected text, got the control character 0x00"},
           {"a,b\n1,2\x7F\n", "2: byte 4: expected text, got the control character 0x7f"},
           {"a,b\r1,2\r", "1: byte 4: expected text, got the control character 0x0d"},
           {"a,b\n1,\xC2\x9B"
            "31mred\n",
            "2: column 2 (b): expected a number, got \"\\xc2\\x9b31mred\""}})
    EXPECT_EQ(error_of(text), "f.csv:" + words);
  EXPECT_EQ(error_of("a,b,c,c\n"), "");
  // A byte order mark behind the first line, as where two files were joined, is an ordinary character.
  const std::string joined = error_of(
      "\xEF\xBB\xBF"
      "a,b\n1,2\n\xEF\xBB\xBF"
      "3,4\n");
  EXPECT_TRUE(joined.starts_with("f.csv:3: column 1 (a): expected a number, got ")) << joined;
  for (const char* text : {"\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\x80", "\xF0\x8F\xBF\xBF"})
    EXPECT_NE(error_of("a,b,c\n1,2," + std::string(text) + "\n").find("expected UTF-8 text"), std::string::npos);
  EXPECT_EQ(error_of("a,b,c\n1,2,\xC2\xB5 \xE2\x82\xAC \xF0\x9F\x98\x80\n"), "");
}

TEST(csv, has_an_optional_column_once_however_it_is_spelled) {
  const auto refusal_of = [](const std::string& text) {
    std::istringstream in(text);
    return tests::thrown_by<Error>([&] { const Reader reader(in, "f.csv", {"a"}, {"reset"}); });
  };
  for (const char* text : {"a,Reset,b,RESET\n", "a,Reset,b,reset\n", "a,reset,b, Reset \n"})
    EXPECT_EQ(refusal_of(text), "f.csv:1: columns 2 and 4 are both called reset") << text;
  std::istringstream other("a,Re Set\n1,foo\n");
  EXPECT_FALSE(Reader(other, "f.csv", {"a"}, {"reset"}).has(1)) << "another column";
}

TEST(csv, refuses_an_endless_row) {
  EXPECT_EQ(error_of("a,b\n" + std::string(Reader::kLongestRow + 1, '1')),
            "f.csv:2: expected at most 1048576 bytes in a row, got more");
  for (const std::size_t more : {0, 1})
    EXPECT_EQ(error_of("a,b,note\n1,2," + std::string(Reader::kLongestRow - 4 + more, 'x') + '\n').empty(), more == 0);
  std::string text = "a,b\n1,\"";
  for (std::size_t line = 0; line < Reader::kLongestRow / 8; ++line) text += "1234567\n";
  EXPECT_EQ(error_of(text), "f.csv:2: expected at most 1048576 bytes in a row, got more: is a quote left open?");
}

TEST(csv, tells_why_a_file_cannot_be_read) {
  const TemporaryDirectory directory;
  const std::string absent = directory.file("absent.csv");
  EXPECT_EQ(tests::thrown_by<Error>([&] { open_input(absent); }), absent + ": cannot open: No such file or directory");
  auto in = open_input(directory.path());
  EXPECT_EQ(tests::thrown_by<Error>([&] { const Reader reader(in, "d", {"a"}); }), "d:1: cannot read: Is a directory");
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

}  // namespace
}  // namespace forceshade::files
