// SPDX-License-Identifier: BSD-3-Clause
// Texts that nest too deep for a parser are refused before it sees them.

#include "files/nesting.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "forceshade/heights.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::heights {
namespace {

using files::line_nested_too_deep;

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

std::string dotted(std::size_t dots) {
  return "a" + repeated(".a", dots);
}

// The error of reading the text as a height map, without the file's name.
std::string words_of(const std::string& text) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.write("map.toml", text);
  return tests::without(file + ": ", tests::thrown_by<Error>([&] { read_spec(file); }));
}

TEST(nesting, is_counted_up_to_its_limits) {
  EXPECT_EQ(line_nested_too_deep(""), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("\n" + dotted(16) + " = 1"), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("\n" + dotted(17) + " = 1"), 2U);
  EXPECT_EQ(line_nested_too_deep("[" + dotted(16) + "]\n" + dotted(16) + "=1"), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("[" + dotted(17) + "]"), 1U);
  EXPECT_EQ(line_nested_too_deep("a = " + repeated("[", 16) + repeated("]", 16)), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("a =\n" + repeated("[\n", 17)), 18U);
  EXPECT_EQ(line_nested_too_deep("a = " + repeated("{a=", 17)), 1U);
  EXPECT_EQ(line_nested_too_deep("a = " + repeated("{a = [", 9)), 1U);
  EXPECT_EQ(line_nested_too_deep("a = {" + dotted(17) + " = 1}"), 1U);
  EXPECT_EQ(line_nested_too_deep("a . 'b' . \"c\"" + repeated(" . d", 15)), 1U);
  // Neighbours do not add up, and a stray closing bracket takes nothing back.
  EXPECT_EQ(line_nested_too_deep(repeated("[a]\n", 100) + "b = [" + repeated("[0.5, 0.5], ", 100) + "]"), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("a = [" + repeated("0.5, ", 100) + "]"), std::nullopt);
  EXPECT_EQ(line_nested_too_deep(repeated("]", 100)), std::nullopt);
  EXPECT_EQ(line_nested_too_deep(repeated("]", 100) + repeated("[", 17)), 1U);
}

TEST(nesting, in_quotes_and_comments_does_not_count) {
  const std::string deep = repeated("[", 40) + repeated(".", 40);
  for (const std::string& quiet : {"a = \"" + deep + "\"", "a = '" + deep + "'", "a = \"\"\"" + deep + "\n" + deep + "\"\"\"",
                                   "a = '''" + deep + "\n" + deep + "'''", "# " + deep, "a = \"\\\"" + deep + "\"",
                                   "a = \"\"\"\\\"\"\"" + deep + "\"\"\"", "a = '''" + deep + "'''''", "a = \"\" # " + deep}) {
    EXPECT_EQ(line_nested_too_deep(quiet), std::nullopt) << quiet;
    EXPECT_NE(line_nested_too_deep(quiet + "\n" + deep), std::nullopt) << quiet;
  }
  // An escaped quote ends nothing; behind a literal's backslash the quote does.
  EXPECT_NE(line_nested_too_deep("a = '\\'" + deep), std::nullopt);
  EXPECT_NE(line_nested_too_deep("a = \"\"" + deep), std::nullopt);
  EXPECT_NE(line_nested_too_deep("a = \"\"\"x\"\"\"\"\"" + deep), std::nullopt);
}

TEST(nesting, that_overflowed_the_stack_is_refused_with_its_line) {
  const std::string words = "line 2: expected at most 16 brackets within each other and 16 dots in a key, got more";
  EXPECT_EQ(words_of("\n" + dotted(100'000) + " = 1"), words);
  EXPECT_EQ(words_of("\n[" + dotted(100'000) + "]"), words);
  EXPECT_EQ(words_of("\n[[" + dotted(100'000) + "]]"), words);
  EXPECT_EQ(words_of("\na = {" + dotted(100'000) + " = 1}"), words);
  EXPECT_EQ(words_of("\na = " + repeated("[", 100'000)), words);
  EXPECT_EQ(words_of("\na = " + repeated("{a=", 100'000)), words);
}

TEST(nesting, at_its_limits_is_parsed) {
  const std::string inner = "{" + dotted(16) + " = ";
  EXPECT_TRUE(words_of("[" + dotted(16) + "]\n" + dotted(16) + " = " + repeated(inner, 16) + "1" + repeated("}", 16))
                  .starts_with("line 1: key render is missing"));
}

// Random texts of what matters to the count: whatever passes is parsed, or refused with words, on the usual stack.
TEST(nesting, of_random_texts_never_harms_the_parser) {
  std::mt19937 random(3);
  const std::vector<std::string> pieces{"a",  ".",  "[", "]", "{",  "}",     "=",   "\"",   "'",       "\"\"\"", "'''", "#",
                                        "\n", "\\", ",", "1", "a.", "a = [", "a={", "\r\n", "[[a]]\n", "a = \"", "a.b."};
  for (int i = 0; i < 1500; ++i) {
    std::string text;
    for (std::size_t k = random() % 60; k > 0; --k) text += repeated(pieces[random() % pieces.size()], 1 + random() % 3);
    EXPECT_NE(words_of(text), "") << text;
  }
}

TEST(height_spec_file, larger_than_its_limit_is_refused) {
  const std::string size = std::to_string(4 << 20);
  EXPECT_EQ(words_of(std::string((4 << 20) + 1, '\n')), "expected at most " + size + " bytes, got more");
  EXPECT_TRUE(words_of(std::string(4 << 20, '\n')).ends_with("key render is missing"));
}

TEST(height_spec_file, with_a_scale_of_nothing_is_refused_with_its_line) {
  const std::string head = "render = \"height-map\"\n[[part]]\nshape = \"grid\"\nfile = \"a.png\"\npitch_mm = 1\nscale_mm = ";
  for (const char* scale : {"0", "0.0", "-0.0", "1e-10", "nan", "inf", "1e-400"})
    EXPECT_TRUE(words_of(head + scale + "\n").starts_with("line 6: scale_mm: expected a finite number of at least 2^-30 mm"))
        << words_of(head + scale + "\n");
  const tests::TemporaryDirectory directory;
  const auto read = [&] { read_spec(directory.write("map.toml", head + "-1e-3\n")); };
  EXPECT_TRUE(tests::thrown_by<Error>(read).ends_with("not be opened")) << "the picture";
}

}  // namespace
}  // namespace forceshade::heights
