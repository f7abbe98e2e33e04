// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/window/settings.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>

#include "forceshade/csv/printable.h"
#include "forceshade/heights/nesting.h"

namespace forceshade::window {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestSettings = 1 << 16;  // bytes; every key with a long text takes a twentieth

[[noreturn]] void refuse(const fs::path& file, std::uint32_t line, const std::string& reason) {
  throw Error(file.string() + ":" + std::to_string(line) + ": " + reason);
}

bool is_a_character(const std::string& key) {
  return !key.empty() && csv::character_size(key) == key.size() && csv::is_printable(key);
}
bool is_a_named_key(const std::string& key) {
  return std::ranges::find(kNamedKeys, key) != kNamedKeys.end();
}

std::string named_keys() {
  std::string all;
  for (const std::string_view key : kNamedKeys) all += (all.empty() ? "" : ", ") + std::string(key);
  return all;
}

// One table of the file. Each reader leaves the value as it is where the key is not given.
class SettingsTable {
 public:
  SettingsTable(const fs::path& file, const toml::table& table, std::string prefix)
      : file_(file), table_(table), prefix_(std::move(prefix)) {}

  void flag(const char* key, bool& value) {
    if (const toml::node* node = find(key)) {
      const auto got = node->value_exact<bool>();
      if (!got) fail(*node, key, "true or false");
      value = *got;
    }
  }

  void whole(const char* key, int least, int most, int& value) {
    if (const toml::node* node = find(key)) {
      const auto got = node->value_exact<std::int64_t>();
      if (!got || *got < least || *got > most)
        fail(*node, key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
      value = static_cast<int>(*got);
    }
  }

  void number(const char* key, double least, double most, double& value) {
    if (const toml::node* node = find(key)) {
      const auto got = node->value<double>();  // a whole number, too
      std::ostringstream range;
      range << "a number from " << least << " to " << most;
      if (!got || !(*got >= least && *got <= most)) fail(*node, key, range.str());
      value = *got;
    }
  }

  void text(const char* key, std::string& value) {
    if (const toml::node* node = find(key)) {
      const auto got = node->value_exact<std::string>();
      if (!got || got->empty() || !csv::is_printable(*got))
        fail(*node, key, "a text in quotes, of one line at least one character long");
      value = *got;
    }
  }

  // One key of the keyboard, or a list of them.
  void keys(const char* key, bool may_be_character, std::vector<std::string>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    value.clear();
    if (const toml::array* list = node->as_array())
      for (const toml::node& one : *list) value.push_back(keyboard_key(one, key, may_be_character));
    else
      value.push_back(keyboard_key(*node, key, may_be_character));
    if (value.empty()) fail(*node, key, "at least one key");
  }

  void digits(const char* key, std::array<std::string, 10>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != value.size()) fail(*node, key, "a list of ten keys, for 0 to 9");
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = keyboard_key((*list)[i], key, true);
  }

  const toml::table* table(const char* key) {
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_table()) fail(*node, key, "a table");
    return node == nullptr ? nullptr : node->as_table();
  }

  // No key of the keyboard may stand twice among the keys of one screen.
  void expect_distinct(const char* where, const std::vector<std::string>& all) const {
    std::set<std::string> seen;
    for (const std::string& key : all)
      if (!seen.insert(key).second)
        refuse(file_, table_.source().begin.line, prefix_ + where + ": expected keys that differ, got " + key + " twice");
  }

  void expect_no_other() const {
    for (const auto& [key, node] : table_)
      if (!known_.contains(std::string(key.str())))
        refuse(file_, node.source().begin.line, "unknown key " + prefix_ + csv::printable(key.str()));
  }

 private:
  std::string keyboard_key(const toml::node& node, const char* key, bool may_be_character) {
    const auto got = node.value_exact<std::string>();
    if (!got || !(is_a_named_key(*got) || (may_be_character && is_a_character(*got))))
      fail(node, key, (may_be_character ? "a character in quotes, or one of " : "one of ") + named_keys());
    return got->size() == 1 && 'A' <= (*got)[0] && (*got)[0] <= 'Z' ? std::string(1, static_cast<char>((*got)[0] + ('a' - 'A')))
                                                                    : *got;
  }

  [[noreturn]] void fail(const toml::node& node, const char* key, const std::string& expected) const {
    std::ostringstream got;
    node.visit([&](const auto& value) {
      if constexpr (toml::is_string<decltype(value)>)
        got << *value;
      else if constexpr (toml::is_value<decltype(value)>)
        got << value;
      else
        got << "a list or table";
    });
    refuse(file_, node.source().begin.line, prefix_ + key + ": expected " + expected + ", got " + csv::printable(got.str()));
  }

  const toml::node* find(const char* key) {
    known_.emplace(key);
    return table_.get(key);
  }

  const fs::path& file_;
  const toml::table& table_;
  const std::string prefix_;
  std::set<std::string> known_;
};

std::string text_of_settings(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file.string() + ": cannot be opened: " + std::generic_category().message(errno));
  std::string text(kLargestSettings + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (in.fail() && !in.eof())) throw Error(file.string() + ": cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kLargestSettings)
    throw Error(file.string() + ": expected at most " + std::to_string(kLargestSettings) + " bytes, got more");
  return text;
}

toml::table parsed_settings(const fs::path& file) {
  const std::string text = text_of_settings(file);
  if (const auto line = heights::line_nested_too_deep(text))
    refuse(file, *line, "expected fewer brackets or dots, got too many");
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    refuse(file, error.source().begin.line, std::string(error.description()));
  }
}

void read_keys(SettingsTable& table, Keys& keys) {
  table.keys("smaller", true, keys.smaller);
  table.keys("bigger", true, keys.bigger);
  table.keys("done", true, keys.done);
  table.keys("enter", false, keys.enter);
  table.keys("erase", false, keys.erase);
  table.digits("digits", keys.digits);
  const auto joined = [](std::vector<std::string> all, const auto&... others) {
    (all.insert(all.end(), others.begin(), others.end()), ...);
    return all;
  };
  table.expect_distinct("smaller, bigger, done", joined(keys.smaller, keys.bigger, keys.done));
  table.expect_distinct("enter, erase, digits", joined(keys.enter, keys.erase, keys.digits));
}

void read_words(SettingsTable& table, Words& words) {
  table.text("trial", words.trial);
  table.text("practice", words.practice);
  table.text("reference", words.reference);
  table.text("matching", words.matching);
  table.text("smaller", words.smaller);
  table.text("bigger", words.bigger);
  table.text("done", words.done);
  table.text("enter", words.enter);
  table.text("return_key", words.return_key);
  table.text("different", words.different);
  table.text("same", words.same);
}

// A path has a slash or the ending of a font's file; anything else is a family.
bool is_path(const std::string& font) {
  return font.find('/') != std::string::npos || font.ends_with(".ttf") || font.ends_with(".otf") || font.ends_with(".ttc");
}

}  // namespace

Settings read_settings(const fs::path& file) {
  const toml::table root = parsed_settings(file);
  Settings settings;
  SettingsTable table(file, root, "");
  table.flag("fullscreen", settings.is_fullscreen);
  table.whole("monitor", 1, 16, settings.monitor);
  table.whole("width", 640, 16384, settings.width);
  table.whole("height", 480, 16384, settings.height);
  table.number("text_scale", 0.5, 3, settings.text_scale);
  table.text("font", settings.font);
  if (is_path(settings.font)) {
    settings.font = (file.parent_path() / settings.font).string();
    std::error_code error;
    if (!fs::is_regular_file(settings.font, error))
      refuse(file, root.get("font")->source().begin.line,
             "font: expected a family or a file, got " + settings.font + ", which is none");
  }
  if (const toml::table* keys = table.table("keys")) {
    SettingsTable inner(file, *keys, "keys.");
    read_keys(inner, settings.keys);
    inner.expect_no_other();
  }
  if (const toml::table* words = table.table("words")) {
    SettingsTable inner(file, *words, "words.");
    read_words(inner, settings.words);
    inner.expect_no_other();
  }
  table.expect_no_other();
  return settings;
}

}  // namespace forceshade::window
