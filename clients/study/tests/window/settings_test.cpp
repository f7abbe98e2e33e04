// SPDX-License-Identifier: BSD-3-Clause
// The settings of the participant's window: what is read, what is refused and how; and what each key does on each screen.

#include "study/window/settings.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>

#include "files/input_file.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::window {
namespace {

class window_settings : public testing::Test {
 protected:
  WindowSettings read(const std::string& text) const { return read_settings(folder_.write("window.toml", text)); }

  // The text after "FILE:" in the message; empty if the text is read.
  std::string refusal(const std::string& text) const {
    return tests::without(folder_.file("window.toml") + ":", tests::thrown_by<Error>([&] { read(text); }));
  }

  const tests::TemporaryDirectory folder_;
};

TEST_F(window_settings, an_empty_file_gives_the_defaults) {
  const WindowSettings settings = read("");
  EXPECT_FALSE(settings.is_fullscreen);
  EXPECT_EQ(settings.monitor, 1);
  EXPECT_EQ(settings.width, 1280);
  EXPECT_EQ(settings.text_scale, 1);
  EXPECT_EQ(settings.font, "DejaVu Sans");
  EXPECT_EQ(settings.keys.smaller, std::vector<std::string>{"j"});
  EXPECT_EQ(settings.keys.enter, std::vector<std::string>{"return"});
  EXPECT_EQ(key_names(settings.keys).enter, "Enter");
}

TEST_F(window_settings, every_key_is_read) {
  const std::string font = folder_.write("letters.ttf", "a font");
  const WindowSettings settings = read(R"(
fullscreen = true
monitor = 2
width = 1920
height = 1080
text_scale = 1.5
font = "letters.ttf"
[keys]
smaller = ["J", "left"]
bigger = ["ö"]
done = ["f5"]
enter = ["tab"]
erase = ["backspace", "delete"]
digits = ["à", "&", "é", "\"", "'", "(", "-", "è", "_", "ç"]
)");
  EXPECT_TRUE(settings.is_fullscreen);
  EXPECT_EQ(settings.monitor, 2);
  EXPECT_EQ(settings.width, 1920);
  EXPECT_EQ(settings.height, 1080);
  EXPECT_EQ(settings.text_scale, 1.5);
  EXPECT_EQ(settings.font, font);
  EXPECT_EQ(settings.keys.smaller, (std::vector<std::string>{"j", "left"}));
  EXPECT_EQ(settings.keys.bigger, std::vector<std::string>{"ö"});
  EXPECT_EQ(settings.keys.done, std::vector<std::string>{"f5"});
  EXPECT_EQ(settings.keys.enter, std::vector<std::string>{"tab"});
  EXPECT_EQ(settings.keys.erase, (std::vector<std::string>{"backspace", "delete"}));
  EXPECT_EQ(settings.keys.digits[2], "é");
  const KeyNames names = key_names(settings.keys);
  EXPECT_EQ(names.smaller + '|' + names.bigger + '|' + names.done + '|' + names.enter + '|' + names.erase,
            "J|ö|F5|Tab|Backspace");
}

TEST_F(window_settings, what_is_wrong_is_named_with_line_key_expectation_and_value) {
  const std::string named =
      "return, backspace, delete, tab, escape, insert, left, right, up, down, page-up, page-down, home, end, f1, f2, f3, f4, "
      "f5, f6, f7, f8, f9, f10, f11, f12";
  const std::string absent = folder_.file("none.ttf");
  const std::map<std::string, std::string> refusals{
      {"fullscreen = 1", "1: fullscreen: expected true or false, got 1"},
      {"\nmonitor = 0", "2: monitor: expected a whole number, 1 to 16, got 0"},
      {"width = 639", "1: width: expected a whole number, 640 to 16384, got 639"},
      {"height = true", "1: height: expected a whole number, 480 to 16384, got true"},
      {"text_scale = 4", "1: text_scale: expected a number, 0.5 to 3, got 4"},
      {"text_scale = nan", "1: text_scale: expected a number, 0.5 to 3, got nan"},
      {"font = 12", "1: font: expected a text of one line in quotes, got 12"},
      {"font = \"none.ttf\"", "1: font: expected a family or a file, got " + absent + ", which is no file"},
      {"text_size = 12", "1: unknown key text_size"},
      {"keys = 1", "1: keys: expected a table, got 1"},
      {"[keys]\nleft = \"a\"", "2: unknown key left"},
      {"[keys]\nsmaller = [\"jj\"]", "2: smaller: expected single characters, or names of keys: " + named + "; got jj"},
      {"[keys]\nsmaller = \"j\"", "2: smaller: expected a list of 1 or more texts in quotes, got 'j'"},
      {"[keys]\nenter = [\"x\"]", "2: enter: expected names of keys: " + named + "; got x"},
      {"[keys]\ndigits = [\"1\", \"2\", \"3\", \"4\", \"5\", \"6\", \"7\", \"8\", \"9\", \"0\", \"a\"]",
       "2: digits: expected ten keys, for 0 to 9, got 11"},
      {"\n[keys]\nsmaller = [\"K\"]", "3: smaller: expected keys that differ from all others of their screen, got k twice"},
      {"[keys]\nerase = [\"return\"]", "1: enter: expected keys that differ from all others of their screen, got return twice"},
  };
  for (const auto& [text, expected] : refusals) EXPECT_EQ(refusal(text), expected) << text;
  EXPECT_TRUE(refusal("width = ").starts_with("1: ")) << refusal("width = ");
  EXPECT_THROW(read_settings(folder_.file("absent.toml")), Error);
  EXPECT_THROW(read_settings(folder_.path()), Error);
}

std::string described(const std::optional<Press>& press) {
  if (!press) return "nothing";
  switch (press->action) {
    case Action::smaller: return "smaller";
    case Action::bigger: return "bigger";
    case Action::done: return "done";
    case Action::enter: return "enter";
    case Action::erase: return "erase";
    case Action::type: return "type " + press->typed;
  }
  return "unknown";
}

TEST(window_keys, each_key_means_on_each_screen_what_the_screen_can_take) {
  const std::vector<ScreenKind> kinds{ScreenKind::text,           ScreenKind::matching, ScreenKind::satisfaction,
                                      ScreenKind::classification, ScreenKind::question, ScreenKind::end};
  const std::map<std::string, std::vector<std::string>> expected{
      {"j", {"nothing", "smaller", "nothing", "nothing", "type j", "nothing"}},
      {"K", {"nothing", "bigger", "nothing", "nothing", "type K", "nothing"}},
      {"l", {"nothing", "done", "nothing", "nothing", "type l", "nothing"}},
      {"return", {"enter", "nothing", "enter", "enter", "enter", "enter"}},
      {"backspace", {"nothing", "nothing", "erase", "erase", "erase", "nothing"}},
      {"7", {"nothing", "nothing", "type 7", "type 7", "type 7", "nothing"}},
      {"ü", {"nothing", "nothing", "nothing", "nothing", "type ü", "nothing"}},
      {" ", {"nothing", "nothing", "nothing", "nothing", "type  ", "nothing"}},
      {"f1", {"nothing", "nothing", "nothing", "nothing", "nothing", "nothing"}},
      {"\x7F", {"nothing", "nothing", "nothing", "nothing", "nothing", "nothing"}},
      {"", {"nothing", "nothing", "nothing", "nothing", "nothing", "nothing"}}};
  for (const auto& [key, presses] : expected)
    for (std::size_t i = 0; i < kinds.size(); ++i)
      EXPECT_EQ(described(press_of({}, kinds[i], {key, false})), presses[i]) << key << " on screen " << i;
}

TEST(window_keys, a_key_that_is_held_down_repeats_in_answers_alone) {
  for (const auto& [kind, key, press] : {std::tuple{ScreenKind::matching, "j", "nothing"},
                                         {ScreenKind::text, "return", "nothing"},
                                         {ScreenKind::question, "return", "nothing"},
                                         {ScreenKind::satisfaction, "1", "nothing"},
                                         {ScreenKind::question, "a", "type a"},
                                         {ScreenKind::question, "backspace", "erase"}})
    EXPECT_EQ(described(press_of({}, kind, {key, true})), press) << key;
}

TEST(window_keys, keys_after_one_that_leaves_the_screen_are_left_out) {
  const auto presses = [](ScreenKind kind, const std::vector<std::string>& names) {
    std::vector<Key> typed;
    for (const std::string& name : names) typed.push_back({name, false});
    std::string all;
    for (const Press& press : presses_of({}, kind, typed)) all += described(press) + '|';
    return all;
  };
  EXPECT_EQ(presses(ScreenKind::matching, {"j", "x", "k", "l", "j"}), "smaller|bigger|done|");
  EXPECT_EQ(presses(ScreenKind::classification, {"3", "return", "4", "return"}), "type 3|enter|");
  EXPECT_EQ(presses(ScreenKind::text, {"return", "return"}), "enter|");
  EXPECT_EQ(presses(ScreenKind::question, {"a", "backspace", "b"}), "type a|erase|type b|");
}

TEST(window_keys, other_keys_can_be_given) {
  Keys keys;
  keys.smaller = {"a", "left"};
  keys.digits[1] = "&";
  keys.digits[4] = "'";
  keys.enter = {"f1"};
  EXPECT_EQ(described(press_of(keys, ScreenKind::matching, {"left", false})), "smaller");
  EXPECT_EQ(described(press_of(keys, ScreenKind::matching, {"A", false})), "smaller");
  EXPECT_EQ(described(press_of(keys, ScreenKind::matching, {"j", false})), "nothing");
  EXPECT_EQ(described(press_of(keys, ScreenKind::classification, {"'", false})), "type 4");
  EXPECT_EQ(described(press_of(keys, ScreenKind::classification, {"4", false})), "nothing");
  EXPECT_EQ(described(press_of(keys, ScreenKind::text, {"f1", false})), "enter");
  EXPECT_EQ(described(press_of(keys, ScreenKind::text, {"return", false})), "nothing");
}

TEST(window_keys, caps_read_as_on_a_keyboard) {
  for (const auto& [key, expected] : {std::pair{"page-up", "Page up"}, {"f12", "F12"}, {"é", "é"}, {"-", "-"}, {" ", "Space"}})
    EXPECT_EQ(cap(key), expected);
}

}  // namespace
}  // namespace forceshade::window
