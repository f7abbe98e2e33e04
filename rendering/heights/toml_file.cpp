// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/heights/toml_file.h"

#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include "files/file_kind.h"
#include "files/printable.h"
#include "rendering/heights/nesting.h"

namespace forceshade::heights {

std::variant<toml::table, TomlFault> parse_toml_file(const std::filesystem::path& file, std::size_t most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return TomlFault{0, "cannot be opened: " + std::generic_category().message(errno)};
  std::string text;
  std::array<char, 1 << 16> bytes;
  do {
    in.read(bytes.data(), bytes.size());
    text.append(bytes.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes) return TomlFault{0, "expected at most " + std::to_string(most_bytes) + " bytes, got more"};
  } while (in);
  if (in.bad()) return TomlFault{0, "cannot be read: " + std::generic_category().message(errno)};
  if (const std::string kind = files::binary_kind(text); !kind.empty())
    return TomlFault{0, "expected a TOML file, got " + kind};
  if (const auto line = line_nested_too_deep(text))
    return TomlFault{*line, "expected at most " + std::to_string(kMostBrackets) + " brackets within each other and " +
                                std::to_string(kMostDots) + " dots in a key, got more"};
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    return TomlFault{error.source().begin.line, std::string(error.description())};
  }
}

std::string words_of_value(const toml::node& node) {
  std::ostringstream words;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>)
      words << value;
    else
      words << "a list or table";
  });
  return words.str();
}

std::vector<std::string> keys_beside(const toml::table& table, const std::set<std::string, std::less<>>& read) {
  std::vector<std::string> keys;
  for (const auto& [key, node] : table)
    if (!read.contains(key.str())) keys.push_back(files::printable(key.str()));
  return keys;
}

}  // namespace forceshade::heights
