// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A TOML file of an experiment, read key by key; errors name the file, the line and the key. Included by source files alone.

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/suggestion.h"
#include "rendering/heights/toml_file.h"

namespace forceshade::experiments {

// Throws Error: a file that cannot be opened, is longer than 1 MiB, nests too deep or is no TOML.
heights::TomlDocument parsed_toml(const std::filesystem::path& file);

template <class T>
using Words = std::span<const std::pair<std::string_view, T>>;

// One table of the file. What a call throws is an Error.
class TomlTable {
 public:
  // The document outlives this.
  TomlTable(const std::filesystem::path& file, const heights::TomlDocument& document)
      : TomlTable(file, document, document.root()) {}

  bool has(std::string_view key) const { return table_.contains(key); }
  int whole(std::string_view key, int least, int largest, std::optional<int> otherwise = std::nullopt);
  // The nearest binary32 number.
  float number(std::string_view key, float least, float largest);
  // UTF-8 that a screen may show; may_have_lines: line feeds are allowed.
  std::string text(std::string_view key, bool may_have_lines = false);
  // A list of at least one whole number, each once.
  std::vector<int> wholes(std::string_view key, int least, int largest);
  bool flag(std::string_view key, bool otherwise);
  std::vector<bool> flags(std::string_view key);
  std::vector<std::string> texts(std::string_view key, std::size_t least);
  TomlTable table(std::string_view key);
  std::vector<TomlTable> tables(std::string_view key);

  template <class T>
  T word(std::string_view key, Words<T> words, std::optional<T> otherwise = std::nullopt) {
    const toml::node* node = find(key, otherwise.has_value());
    if (!node) return *otherwise;
    const auto got = node->value_exact<std::string>();
    std::string expected;
    std::vector<std::string> names;
    for (const auto& [word, value] : words) {
      if (got == word) return value;
      expected += (expected.empty() ? "one of " : ", ") + std::string(word);
      names.emplace_back(word);
    }
    fail(*node, key, expected, files::suggestion(got.value_or(""), names));
  }

  // A key that was not read is a mistake, most likely a misspelt one.
  void expect_no_other() const;

  // At the key's line, or the table's where there is no such key.
  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

 private:
  TomlTable(const std::filesystem::path& file, const heights::TomlDocument& document, const toml::table& table)
      : file_(file), document_(document), table_(table) {}

  const toml::node* find(std::string_view key, bool is_optional);
  [[noreturn]] void fail(const toml::node& node, std::string_view key, const std::string& expected,
                         const std::string& suggestion = "") const;

  std::filesystem::path file_;
  const heights::TomlDocument& document_;
  const toml::table& table_;  // of the document
  std::set<std::string, std::less<>> read_;
};

}  // namespace forceshade::experiments
