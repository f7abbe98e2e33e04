// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A TOML file, read and parsed within limits. Included by source files alone.

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace forceshade::files {

// A fault that keeps a file from being parsed. The reason may hold text of the file.
struct TomlFault {
  std::uint32_t line;  // from 1; 0 where none is known
  std::string reason;
};

// "line 3: ", for a message; empty where no line is known.
inline std::string line_words(std::size_t line) {
  return line == 0 ? "" : "line " + std::to_string(line) + ": ";
}

// The contents of a file. toml++ makes binary64 numbers of decimals; these are read from the text, and rounded once.
class TomlDocument {
 public:
  TomlDocument(const std::string& text, const std::filesystem::path& file);  // throws toml::parse_error

  const toml::table& root() const { return root_; }

  // The number as the file has it, without underscores; empty where the node is no number.
  std::string number(const toml::node& node) const;
  // The binary32 number nearest to it.
  std::optional<float> binary32(const toml::node& node) const;
  // A text, a number, or a list of these with commas between them, as a command line has it; empty for anything else.
  std::string words_of_scalars(const toml::node& node) const;

 private:
  toml::table root_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> decimals_;  // by line and column
};

// That of at most `most_bytes`, which nests no deeper than nesting.h allows.
std::variant<TomlDocument, TomlFault> parse_toml_file(const std::filesystem::path& file, std::size_t most_bytes);

// The same of a text. file: its name.
std::variant<TomlDocument, TomlFault> parse_toml(const std::string& text, const std::filesystem::path& file,
                                                 std::size_t most_bytes);

// The node's value as it may stand behind "got".
std::string words_of_value(const toml::node& node);

// The keys of a table that have not been read, for a terminal: where a key is missing, it may be among them misspelt.
std::vector<std::string> keys_beside(const toml::table& table, const std::set<std::string, std::less<>>& read);

}  // namespace forceshade::files
