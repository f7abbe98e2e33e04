// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A TOML file, read key by key; errors name the file, the line and the key. Included by source files alone.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/suggestion.h"
#include "files/toml_file.h"
#include "text/joined.h"

namespace forceshade::files {

// The place in a message: "FILE:3: reason", the line that an editor shows, or "FILE: line 3: reason".
enum class LineForm : std::uint8_t { editor, words };

// The file with its contents. Everything here throws Error.
class TomlFile {
 public:
  // Throws for a file that cannot be opened, is longer than most_bytes, nests too deep or is no TOML.
  explicit TomlFile(std::filesystem::path path, std::size_t most_bytes = 1 << 20, LineForm form = LineForm::editor);

  const std::filesystem::path& path() const { return path_; }
  const TomlDocument& document() const { return *document_; }
  [[noreturn]] void fail(const toml::node& at, const std::string& reason) const { fail(at.source().begin.line, reason); }
  // line: from 1; 0 where none is known.
  [[noreturn]] void fail(std::size_t line, const std::string& reason) const;

 private:
  std::filesystem::path path_;
  LineForm form_;
  std::optional<TomlDocument> document_;
};

template <class T>
using Words = std::span<const std::pair<std::string_view, T>>;

// One table of the file.
class TomlTable {
 public:
  // The file outlives this.
  explicit TomlTable(const TomlFile& file) : TomlTable(file, file.document().root()) {}
  TomlTable(const TomlFile& file, const toml::table& table) : file_(file), table_(table) {}

  bool has(std::string_view key) const { return table_.contains(key); }
  int whole(std::string_view key, int least, int largest, std::optional<int> otherwise = std::nullopt);
  // The nearest binary32 number.
  float number(std::string_view key, std::optional<float> otherwise = std::nullopt);
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
    std::vector<std::string> names;
    for (const auto& [word, value] : words) {
      if (got == word) return value;
      names.emplace_back(word);
    }
    fail(*node, key, "one of " + joined(names, ", "), suggestion(got.value_or(""), names));
  }

  // A key that was not read is a mistake, most likely a misspelt one.
  void expect_no_other() const;

  // At the key's line, or the table's where there is no such key.
  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

 protected:
  // Null for a key that is optional and not there.
  const toml::node* find(std::string_view key, bool is_optional);
  [[noreturn]] void fail(const toml::node& node, std::string_view key, const std::string& expected,
                         const std::string& suggestion = "") const;
  const TomlDocument& document() const { return file_.document(); }

 private:
  const TomlFile& file_;
  const toml::table& table_;  // of the file
  std::set<std::string, std::less<>> read_;
};

}  // namespace forceshade::files
