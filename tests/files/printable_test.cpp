// SPDX-License-Identifier: BSD-3-Clause
// Text from outside as a terminal may show it.

#include "files/printable.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "text/beginning.h"

namespace forceshade::files {
namespace {

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
  EXPECT_EQ(printable("\xC2\x9B 31m"), "\\xc2\\x9b 31m");
  EXPECT_EQ(printable("\xE2\x80\xAE gpj.exe"), "\\xe2\\x80\\xae gpj.exe");
  EXPECT_EQ(printable("\xFF\xC2"), "\\xff\\xc2");
}

// Printable text has no control character, none that only UTF-8 spells, and is UTF-8 throughout.
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

// Characters of four bytes: 20 go into the 80 that are shown, and the next is left out as a whole.
TEST(printable, of_a_long_text_is_cut_behind_a_character) {
  for (const std::string before : {"", "a", "ab", "abc"}) {
    std::string text = before;
    for (int i = 0; i < 30; ++i) text += "\xF0\x9F\x99\x82";
    const std::size_t whole = before.empty() ? 20 : 19;
    EXPECT_EQ(shown(text), '"' + text.substr(0, before.size() + 4 * whole) + "...\"");
    EXPECT_EQ(beginning_of(text, before.size() + 3), before);
    EXPECT_EQ(beginning_of(text, 1000), text);
  }
  EXPECT_EQ(beginning_of(std::string(100, '\x85'), 80), std::string(80, '\x85')) << "no UTF-8";
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

}  // namespace
}  // namespace forceshade::files
