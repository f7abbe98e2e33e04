// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/heights/toml_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "files/file_kind.h"
#include "files/printable.h"
#include "files/shortest.h"
#include "rendering/heights/nesting.h"

namespace forceshade::heights {
namespace {

struct Scope {
  std::string_view name, expected;  // what toml++ was reading, in its words, and what may stand there
};
constexpr std::string_view kExpectedPair = "KEY = VALUE on a line", kExpectedText = "a text in quotes, which ends on its line";
constexpr std::array kScopes{
    Scope{"root table", kExpectedPair},
    Scope{"key", kExpectedPair},
    Scope{"key-value pair", kExpectedPair},
    Scope{"table header", "the name of a table in brackets, alone on its line, such as [[part]]"},
    Scope{"value", "a text in quotes, a number, true, false, a list or a table"},
    Scope{"boolean", "true or false"},
    Scope{"string", kExpectedText},
    Scope{"unicode scalar sequence", kExpectedText},
    Scope{"literal string", kExpectedText},
    Scope{"array", "a list in brackets, with commas between its elements"},
    Scope{"inline table", "a table in braces, with commas between its keys, such as { KEY = VALUE }"},
    Scope{"comment", "a comment of text alone"},
    Scope{"floating-point", "a number such as 0.5"},
    Scope{"decimal integer", "a number such as 5 or 0.5"},
};

void replace(std::string& text, std::string_view from, std::string_view to) {
  if (const std::size_t at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
}

// "expected KEY = VALUE on a line (expected '=', got the end of the line)": what may stand there, and what toml++ says of it.
std::string words_of_syntax_error(std::string description) {
  constexpr std::string_view kBeginning = "Error while parsing ";
  std::string_view expected = "TOML";
  if (const std::size_t end = description.find(": "); description.starts_with(kBeginning) && end != std::string::npos) {
    const std::string name = description.substr(kBeginning.size(), end - kBeginning.size());
    if (const auto* scope = std::ranges::find(kScopes, name, &Scope::name); scope != kScopes.end()) expected = scope->expected;
    description.erase(0, end + 2);
  }
  if (description.find("utf-8") != std::string::npos) expected = "UTF-8";
  if (description.find("redefine") != std::string::npos) expected = "each key and table once";
  replace(description, "saw '\\n'", "got the end of the line");
  replace(description, "encountered end-of-file", "got the end of the file");
  replace(description, "saw ", "got ");
  return "expected " + std::string(expected) + " (" + description + ')';
}

}  // namespace

std::variant<toml::table, TomlFault> parse_toml_file(const std::filesystem::path& file, std::size_t most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return TomlFault{0, "cannot be opened: " + std::generic_category().message(errno)};
  std::string text;
  std::array<char, 1 << 16> bytes;
  do {
    in.read(bytes.data(), bytes.size());
    text.append(bytes.data(), static_cast<std::size_t>(in.gcount()));
  } while (in && text.size() <= most_bytes);
  if (in.bad()) return TomlFault{0, "cannot be read: " + std::generic_category().message(errno)};
  return parse_toml(text, file, most_bytes);
}

std::variant<toml::table, TomlFault> parse_toml(const std::string& text, const std::filesystem::path& file,
                                                std::size_t most_bytes) {
  if (text.size() > most_bytes) return TomlFault{0, "expected at most " + std::to_string(most_bytes) + " bytes, got more"};
  if (const std::string kind = files::binary_kind(text); !kind.empty())
    return TomlFault{0, "expected a TOML file, got " + kind};
  if (const auto line = line_nested_too_deep(text))
    return TomlFault{*line, "expected at most " + std::to_string(kMostBrackets) + " brackets within each other and " +
                                std::to_string(kMostDots) + " dots in a key, got more"};
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    if (const std::string kind = files::text_kind(text); !kind.empty() && kind != files::kTomlFile)
      return TomlFault{0, "expected a TOML file, got " + kind};
    return TomlFault{error.source().begin.line, words_of_syntax_error(std::string(error.description()))};
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

std::string words_of_scalars(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
  if (const auto number = node.value_exact<double>()) return files::shortest(*number);
  std::string all;
  if (const toml::array* list = node.as_array())
    for (const toml::node& each : *list) {
      const std::string one = each.is_array() ? "" : words_of_scalars(each);
      if (one.empty()) return "";
      all += (all.empty() ? "" : ",") + one;
    }
  return all;
}

std::vector<std::string> keys_beside(const toml::table& table, const std::set<std::string, std::less<>>& read) {
  std::vector<std::string> keys;
  for (const auto& [key, node] : table)
    if (!read.contains(key.str())) keys.push_back(files::printable(key.str()));
  return keys;
}

}  // namespace forceshade::heights
