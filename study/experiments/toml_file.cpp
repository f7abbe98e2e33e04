// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/toml_file.h"

#include <algorithm>
#include <sstream>

#include "files/printable.h"
#include "files/suggestion.h"
#include "study/experiments/error.h"

namespace forceshade::experiments {
namespace {

constexpr std::size_t kLargestToml = 1 << 20;

std::string range_of(auto least, auto largest) {
  std::ostringstream words;
  words << least << " to " << largest;
  return words.str();
}

}  // namespace

heights::TomlDocument parsed_toml(const std::filesystem::path& file) {
  auto root = heights::parse_toml_file(file, kLargestToml);
  if (const auto* fault = std::get_if<heights::TomlFault>(&root)) {
    const std::string reason = files::printable(fault->reason);
    throw fault->line == 0 ? Error(file, reason) : Error(file, fault->line, reason);
  }
  return std::get<heights::TomlDocument>(std::move(root));
}

const toml::node* TomlTable::find(std::string_view key, bool is_optional) {
  read_.emplace(key);
  const toml::node* node = table_.get(key);
  if (!node && !is_optional)
    throw Error(file_, table_.source().begin.line,
                "key " + std::string(key) + " is missing" + files::suggestion(key, heights::keys_beside(table_, read_)));
  return node;
}

void TomlTable::fail(const toml::node& node, std::string_view key, const std::string& expected,
                     const std::string& suggestion) const {
  throw Error(
      file_, node.source().begin.line,
      std::string(key) + ": expected " + expected + ", got " + files::printable(heights::words_of_value(node)) + suggestion);
}

void TomlTable::fail(std::string_view key, const std::string& reason) const {
  const toml::node* node = table_.get(key);
  throw Error(file_, (node != nullptr ? node->source() : table_.source()).begin.line, std::string(key) + ": " + reason);
}

int TomlTable::whole(std::string_view key, int least, int largest, std::optional<int> otherwise) {
  const toml::node* node = find(key, otherwise.has_value());
  if (!node) return *otherwise;
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < least || *value > largest) fail(*node, key, "a whole number, " + range_of(least, largest));
  return static_cast<int>(*value);
}

float TomlTable::number(std::string_view key, float least, float largest) {
  const toml::node* node = find(key, false);
  const auto value = document_.binary32(*node);
  if (!value || !(*value >= least && *value <= largest)) fail(*node, key, "a number, " + range_of(least, largest));
  return *value;
}

std::string TomlTable::text(std::string_view key, bool may_have_lines) {
  const toml::node* node = find(key, false);
  const auto value = node->value_exact<std::string>();
  if (!value || value->empty() || !files::is_printable(*value, may_have_lines))
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
    if (!value || value->empty() || !files::is_printable(*value, true)) fail(element, key, expected);
    all.push_back(*value);
  }
  return all;
}

TomlTable TomlTable::table(std::string_view key) {
  const toml::node* node = find(key, false);
  if (!node->is_table()) fail(*node, key, "a table");
  return {file_, document_, *node->as_table()};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key, false);
  const toml::array* list = node->as_array();
  if (!list || list->empty()) fail(*node, key, "a list of tables such as [{ law = \"wall\" }]");
  std::vector<TomlTable> all;
  for (const toml::node& element : *list) {
    if (!element.is_table()) fail(element, key, "a list of tables such as [{ law = \"wall\" }]");
    all.push_back({file_, document_, *element.as_table()});
  }
  return all;
}

void TomlTable::expect_no_other() const {
  for (const auto& [key, node] : table_)
    if (!read_.contains(key.str()))
      throw Error(file_, node.source().begin.line,
                  "unknown key " + files::printable(key.str()) + files::suggestion(key.str(), {read_.begin(), read_.end()}));
}

}  // namespace forceshade::experiments
