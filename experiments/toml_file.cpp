// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/experiments/toml_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include "forceshade/csv/printable.h"
#include "forceshade/experiments/error.h"
#include "forceshade/heights/nesting.h"

namespace forceshade::experiments {
namespace {

constexpr std::size_t kLargestToml = 1 << 20;

std::string text_of_toml(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be opened: " + std::generic_category().message(errno));
  std::string text;
  std::array<char, 1 << 16> bytes;
  do {
    in.read(bytes.data(), bytes.size());
    text.append(bytes.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > kLargestToml) throw Error(file, "expected at most " + std::to_string(kLargestToml) + " bytes, got more");
  } while (in);
  if (in.bad()) throw Error(file, "cannot be read: " + std::generic_category().message(errno));
  return text;
}

std::string range_of(auto least, auto largest) {
  std::ostringstream words;
  words << least << " to " << largest;
  return words.str();
}

}  // namespace

toml::table parsed_toml(const std::filesystem::path& file) {
  const std::string text = text_of_toml(file);
  if (const auto line = heights::line_nested_too_deep(text))
    throw Error(file, *line,
                "expected at most " + std::to_string(heights::kMostBrackets) + " brackets within each other and " +
                    std::to_string(heights::kMostDots) + " dots in a key, got more");
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    const std::string reason = csv::printable(error.description());
    if (error.source().begin.line == 0) throw Error(file, reason);
    throw Error(file, error.source().begin.line, reason);
  }
}

const toml::node* TomlTable::find(std::string_view key, bool is_optional) {
  read_.emplace(key);
  const toml::node* node = table_.get(key);
  if (!node && !is_optional) throw Error(file_, table_.source().begin.line, "key " + std::string(key) + " is missing");
  return node;
}

void TomlTable::fail(const toml::node& node, std::string_view key, const std::string& expected) const {
  std::ostringstream got;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>)
      got << value;
    else
      got << "a list or table";
  });
  throw Error(file_, node.source().begin.line,
              std::string(key) + ": expected " + expected + ", got " + csv::printable(got.str()));
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

double TomlTable::number(std::string_view key, double least, double largest) {
  const toml::node* node = find(key, false);
  const auto value = node->value<double>();  // a whole number, too
  if (!value || !(*value >= least && *value <= largest)) fail(*node, key, "a number, " + range_of(least, largest));
  return *value;
}

std::string TomlTable::text(std::string_view key, bool may_have_lines) {
  const toml::node* node = find(key, false);
  const auto value = node->value_exact<std::string>();
  if (!value || value->empty() || !csv::is_printable(*value, may_have_lines))
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
    if (!value || value->empty() || !csv::is_printable(*value, true)) fail(element, key, expected);
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
    if (!read_.contains(key.str())) throw Error(file_, node.source().begin.line, "unknown key " + csv::printable(key.str()));
}

}  // namespace forceshade::experiments
