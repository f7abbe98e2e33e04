// SPDX-License-Identifier: BSD-3-Clause
#include "files/toml_table.h"

#include <algorithm>
#include <locale>
#include <sstream>

#include "files/printable.h"
#include "forceshade/error.h"

namespace forceshade::files {
namespace {

std::string range_of(auto least, auto largest) {
  std::ostringstream words;
  words.imbue(std::locale::classic());
  words << least << " to " << largest;
  return words.str();
}

}  // namespace

TomlFile::TomlFile(std::filesystem::path path, std::size_t most_bytes, LineForm form) : path_(std::move(path)), form_(form) {
  auto parsed = parse_toml_file(path_, most_bytes);
  if (const auto* fault = std::get_if<TomlFault>(&parsed)) fail(fault->line, printable(fault->reason));
  document_ = std::get<TomlDocument>(std::move(parsed));
}

void TomlFile::fail(std::size_t line, const std::string& reason) const {
  if (form_ == LineForm::words) throw Error(path_, line_words(line) + reason);
  throw Error(path_, line, reason);
}

const toml::node* TomlTable::find(std::string_view key, bool is_optional) {
  read_.emplace(key);
  const toml::node* node = table_.get(key);
  if (!node && !is_optional)
    file_.fail(table_, "key " + std::string(key) + " is missing" + suggestion(key, keys_beside(table_, read_)));
  return node;
}

void TomlTable::fail(const toml::node& node, std::string_view key, const std::string& expected,
                     const std::string& suggestion) const {
  file_.fail(node, std::string(key) + ": expected " + expected + ", got " + printable(words_of_value(node)) + suggestion);
}

void TomlTable::fail(std::string_view key, const std::string& reason) const {
  const toml::node* node = table_.get(key);
  file_.fail(node != nullptr ? *node : table_, std::string(key) + ": " + reason);
}

int TomlTable::whole(std::string_view key, int least, int largest, std::optional<int> otherwise) {
  const toml::node* node = find(key, otherwise.has_value());
  if (!node) return *otherwise;
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < least || *value > largest) fail(*node, key, "a whole number, " + range_of(least, largest));
  return static_cast<int>(*value);
}

float TomlTable::number(std::string_view key, std::optional<float> otherwise) {
  const toml::node* node = find(key, otherwise.has_value());
  if (!node) return *otherwise;
  const auto value = document().binary32(*node);
  if (!value) fail(*node, key, "a number");
  return *value;
}

float TomlTable::number(std::string_view key, float least, float largest) {
  const toml::node* node = find(key, false);
  const auto value = document().binary32(*node);
  if (!value || !(*value >= least && *value <= largest)) fail(*node, key, "a number, " + range_of(least, largest));
  return *value;
}

std::string TomlTable::text(std::string_view key, bool may_have_lines) {
  const toml::node* node = find(key, false);
  const auto value = node->value_exact<std::string>();
  if (!value || value->empty() || !is_printable(*value, may_have_lines))
    fail(*node, key, may_have_lines ? "a text in quotes" : "a text of one line in quotes");
  return *value;
}

std::vector<int> TomlTable::wholes(std::string_view key, int least, int largest) {
  const toml::node* node = find(key, false);
  const std::string expected = "a list of different whole numbers, each " + range_of(least, largest);
  const toml::array* list = node->as_array();
  if (!list || list->empty()) fail(*node, key, expected);
  std::vector<int> all;
  for (const toml::node& element : *list) {
    const auto value = element.value_exact<std::int64_t>();
    if (!value || *value < least || *value > largest || std::ranges::count(all, *value) > 0) fail(element, key, expected);
    all.push_back(static_cast<int>(*value));
  }
  return all;
}

bool TomlTable::flag(std::string_view key, bool otherwise) {
  const toml::node* node = find(key, true);
  if (!node) return otherwise;
  const auto value = node->value_exact<bool>();
  if (!value) fail(*node, key, "true or false");
  return *value;
}

std::vector<bool> TomlTable::flags(std::string_view key) {
  const toml::node* node = find(key, false);
  const std::string expected = "a list of true, false or both, each once";
  const toml::array* list = node->as_array();
  if (!list || list->empty()) fail(*node, key, expected);
  std::vector<bool> all;
  for (const toml::node& element : *list) {
    const auto value = element.value_exact<bool>();
    if (!value || std::ranges::count(all, *value) > 0) fail(element, key, expected);
    all.push_back(*value);
  }
  return all;
}

std::vector<std::string> TomlTable::texts(std::string_view key, std::size_t least) {
  const toml::node* node = find(key, false);
  const std::string expected = "a list of " + std::to_string(least) + " or more texts in quotes";
  const toml::array* list = node->as_array();
  if (!list || list->size() < least) fail(*node, key, expected);
  std::vector<std::string> all;
  for (const toml::node& element : *list) {
    const auto value = element.value_exact<std::string>();
    if (!value || value->empty() || !is_printable(*value, true)) fail(element, key, expected);
    all.push_back(*value);
  }
  return all;
}

TomlTable TomlTable::table(std::string_view key) {
  const toml::node* node = find(key, false);
  if (!node->is_table()) fail(*node, key, "a table");
  return {file_, *node->as_table()};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key, false);
  const toml::array* list = node->as_array();
  if (!list || list->empty()) fail(*node, key, "a list of tables such as [{ law = \"wall\" }]");
  std::vector<TomlTable> all;
  for (const toml::node& element : *list) {
    if (!element.is_table()) fail(element, key, "a list of tables such as [{ law = \"wall\" }]");
    all.emplace_back(file_, *element.as_table());
  }
  return all;
}

void TomlTable::expect_no_other() const {
  for (const auto& [key, node] : table_)
    if (!read_.contains(key.str()))
      file_.fail(node, "unknown key " + printable(key.str()) + suggestion(key.str(), {read_.begin(), read_.end()}));
}

}  // namespace forceshade::files
