// SPDX-License-Identifier: BSD-3-Clause
#include "files/toml_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "files/decimal.h"
#include "files/file_kind.h"
#include "files/nesting.h"
#include "files/printable.h"

namespace forceshade::files {
namespace {

struct Scope {
  std::string_view name, expected;  // the part that toml++ was reading, in its words; the text allowed there
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

using Place = std::pair<std::uint32_t, std::uint32_t>;  // line and column, from 1

void add_places_of_decimals(const toml::node& node, std::vector<Place>& places) {
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) add_places_of_decimals(value, places);
  if (const toml::array* list = node.as_array())
    for (const toml::node& value : *list) add_places_of_decimals(value, places);
  if (node.is_floating_point()) places.emplace_back(node.source().begin.line, node.source().begin.column);
}

bool begins_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80;
}

// The word of a number at the beginning of the text, without underscores and a + in front.
std::string number_at(std::string_view text) {
  std::string word(text.substr(0, text.find_first_not_of("+-_.0123456789eEinfa")));
  std::erase(word, '_');
  return word.starts_with('+') ? word.substr(1) : word;
}

}  // namespace

// A column counts the characters of UTF-8.
TomlDocument::TomlDocument(const std::string& text, const std::filesystem::path& file)
    : root_(toml::parse(text, file.string())) {
  std::vector<Place> places;
  add_places_of_decimals(root_, places);
  std::ranges::sort(places);
  Place here{1, 0};
  auto next = places.begin();
  for (std::size_t i = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0; i < text.size() && next != places.end();
       ++i) {
    if (begins_character(text[i])) ++here.second;
    if (here == *next) decimals_.emplace(*next++, number_at(std::string_view(text).substr(i)));
    if (text[i] == '\n') here = {here.first + 1, 0};
  }
}

std::string TomlDocument::number(const toml::node& node) const {
  if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
  const auto rounded = node.value_exact<double>();
  if (!rounded) return "";
  const auto found = decimals_.find({node.source().begin.line, node.source().begin.column});
  const std::string text = found == decimals_.end() ? "" : found->second;
  const auto exact = Decimal::of(text);
  if (std::isfinite(*rounded) ? !exact || exact->nearest<double>() != *rounded : text.empty())
    throw std::logic_error("a number of a TOML file is not where toml++ says that it is");
  return text;
}

std::optional<float> TomlDocument::binary32(const toml::node& node) const {
  const auto rounded = node.value<double>();  // of a whole number, too
  if (!rounded || !std::isfinite(*rounded)) return rounded;
  return Decimal::of(number(node))->nearest<float>();
}

std::string TomlDocument::words_of_scalars(const toml::node& node) const {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const std::string text = number(node); !text.empty()) return text;
  std::string all;
  if (const toml::array* list = node.as_array())
    for (const toml::node& each : *list) {
      const std::string one = each.is_array() ? "" : words_of_scalars(each);
      if (one.empty()) return "";
      all += (all.empty() ? "" : ",") + one;
    }
  return all;
}

std::variant<TomlDocument, TomlFault> parse_toml_file(const std::filesystem::path& file, std::size_t most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return TomlFault{0, "cannot be opened: " + std::generic_category().message(errno)};
  std::string text;
  std::array<char, 1 << 12> bytes;
  do {
    in.read(bytes.data(), bytes.size());
    text.append(bytes.data(), static_cast<std::size_t>(in.gcount()));
  } while (in && text.size() <= most_bytes);
  if (in.bad()) return TomlFault{0, "cannot be read: " + std::generic_category().message(errno)};
  return parse_toml(text, file, most_bytes);
}

std::variant<TomlDocument, TomlFault> parse_toml(const std::string& text, const std::filesystem::path& file,
                                                 std::size_t most_bytes) {
  if (text.size() > most_bytes) return TomlFault{0, "expected at most " + std::to_string(most_bytes) + " bytes, got more"};
  if (const std::string kind = binary_kind(text); !kind.empty()) return TomlFault{0, "expected a TOML file, got " + kind};
  if (const auto line = line_nested_too_deep(text))
    return TomlFault{*line, "expected at most " + std::to_string(kMostBrackets) + " brackets within each other and " +
                                std::to_string(kMostDots) + " dots in a key, got more"};
  try {
    return TomlDocument(text, file);
  } catch (const toml::parse_error& error) {
    if (const std::string kind = text_kind(text); !kind.empty() && kind != kTomlFile)
      return TomlFault{0, "expected a TOML file, got " + kind};
    return TomlFault{error.source().begin.line, words_of_syntax_error(std::string(error.description()))};
  }
}

std::string words_of_value(const toml::node& node) {
  std::ostringstream words;
  words.imbue(std::locale::classic());
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
    if (!read.contains(key.str())) keys.push_back(printable(key.str()));
  return keys;
}

}  // namespace forceshade::files
