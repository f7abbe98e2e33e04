// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/settings.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "files/printable.h"
#include "files/toml_table.h"

namespace forceshade::window {
namespace {

namespace fs = std::filesystem;
using files::TomlTable;

std::string named_keys() {
  std::string all;
  for (const std::string_view key : kNamedKeys) all += (all.empty() ? "" : ", ") + std::string(key);
  return all;
}

enum class Kind : std::uint8_t { any, named };

void expect_keys(TomlTable& table, const char* key, Kind kind, std::vector<std::string>& keys) {
  for (std::string& one : keys) {
    const bool is_named = std::ranges::find(kNamedKeys, one) != kNamedKeys.end();
    const bool is_character = kind == Kind::any && files::character_size(one) == one.size();
    if (!is_named && !is_character)
      table.fail(key, "expected " +
                          std::string(kind == Kind::any ? "single characters, or names of keys: " : "names of keys: ") +
                          named_keys() + "; got " + one);
    if (one.size() == 1 && 'A' <= one[0] && one[0] <= 'Z') one[0] = static_cast<char>(one[0] + ('a' - 'A'));
  }
}

void read(TomlTable& table, const char* key, Kind kind, std::vector<std::string>& keys) {
  if (!table.has(key)) return;
  keys = table.texts(key, 1);
  expect_keys(table, key, kind, keys);
}

// A key of the keyboard may stand once among those of one screen. The message is at the line of `key`.
void expect_different(const TomlTable& table, const char* key, const std::vector<std::string>& all) {
  std::set<std::string> seen;
  for (const std::string& one : all)
    if (!seen.insert(one).second)
      table.fail(key, "expected keys that differ from all others of their screen, got " + one + " twice");
}

std::vector<std::string> joined(std::vector<std::string> all, const auto&... others) {
  (all.insert(all.end(), others.begin(), others.end()), ...);
  return all;
}

Keys read_keys(TomlTable table) {
  Keys keys;
  read(table, "smaller", Kind::any, keys.smaller);
  read(table, "bigger", Kind::any, keys.bigger);
  read(table, "done", Kind::any, keys.done);
  read(table, "enter", Kind::named, keys.enter);
  read(table, "erase", Kind::named, keys.erase);
  if (table.has("digits")) {
    std::vector<std::string> digits = table.texts("digits", keys.digits.size());
    if (digits.size() != keys.digits.size())
      table.fail("digits", "expected ten keys, for 0 to 9, got " + std::to_string(digits.size()));
    expect_keys(table, "digits", Kind::any, digits);
    std::ranges::copy(digits, keys.digits.begin());
  }
  expect_different(table, "smaller", joined(keys.smaller, keys.bigger, keys.done));
  expect_different(table, "enter", joined(keys.enter, keys.erase, keys.digits));
  table.expect_no_other();
  return keys;
}

// A path has a slash or the ending of a font's file; anything else is a family.
bool is_path(const std::string& font) {
  return font.find('/') != std::string::npos || font.ends_with(".ttf") || font.ends_with(".otf") || font.ends_with(".ttc");
}

std::string font_of(TomlTable& table, const fs::path& folder) {
  const std::string font = table.text("font");
  if (!is_path(font)) return font;
  const fs::path path = fs::absolute(folder / font);
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    table.fail("font", "expected a family or a file, got " + files::printable(path.string()) + ", which is no file");
  return path.string();
}

}  // namespace

WindowSettings read_settings(const fs::path& file) {
  const files::TomlFile parsed(file);
  TomlTable table(parsed);
  WindowSettings settings;
  settings.is_fullscreen = table.flag("fullscreen", settings.is_fullscreen);
  settings.monitor = table.whole("monitor", 1, 16, settings.monitor);
  settings.width = table.whole("width", 640, 16384, settings.width);
  settings.height = table.whole("height", 480, 16384, settings.height);
  if (table.has("text_scale")) settings.text_scale = table.number("text_scale", 0.5, 3);
  if (table.has("font")) settings.font = font_of(table, file.parent_path());
  if (table.has("keys")) settings.keys = read_keys(table.table("keys"));
  table.expect_no_other();
  return settings;
}

KeyNames key_names(const Keys& keys) {
  return {cap(keys.smaller.front()), cap(keys.bigger.front()), cap(keys.done.front()), cap(keys.enter.front()),
          cap(keys.erase.front())};
}

}  // namespace forceshade::window
