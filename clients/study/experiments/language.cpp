// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/language.h"

#include <algorithm>
#include <string_view>

#include "files/toml_table.h"

namespace forceshade::experiments {
namespace {

using files::TomlTable;
using Places = std::vector<std::string_view>;

const Places kKeyPlaces{"smaller", "bigger", "done", "enter", "erase"};

// Every {…} of the text has to be one of `places`: a misspelt one would be shown as it is.
void expect_places(const TomlTable& table, std::string_view key, std::string_view text, const Places& places) {
  for (std::size_t at = text.find_first_of("{}"); at != std::string_view::npos; at = text.find_first_of("{}", at + 1)) {
    const std::size_t end = text.find('}', at);
    const bool is_place =
        text[at] == '{' && end != std::string_view::npos && std::ranges::count(places, text.substr(at + 1, end - at - 1)) > 0;
    if (!is_place) {
      std::string expected;
      for (const std::string_view place : places) expected += (expected.empty() ? "{" : ", {") + std::string(place) + '}';
      table.fail(key, "expected nothing in braces but " + expected);
    }
    at = end;
  }
}

Heading heading(TomlTable& root, std::string_view name, const Places& more = {}) {
  TomlTable table = root.table(name);
  Places places = kKeyPlaces;
  places.insert(places.end(), more.begin(), more.end());
  Heading heading{table.text("title"), table.text("text", true)};
  expect_places(table, "title", heading.title, places);
  expect_places(table, "text", heading.text, places);
  table.expect_no_other();
  return heading;
}

Labels labels(TomlTable& root) {
  TomlTable table = root.table("labels");
  Labels labels{table.text("trial"),    table.text("practice"),  table.text("reference"),
                table.text("matching"), table.text("different"), table.text("same")};
  table.expect_no_other();
  return labels;
}

}  // namespace

Language read_language(const std::filesystem::path& file) {
  const files::TomlFile parsed(file);
  TomlTable table(parsed);
  Language language;
  language.name = table.text("language");
  language.matching = heading(table, "matching");
  language.classification = heading(table, "classification");
  language.practice = heading(table, "practice");
  language.block_with_vision = heading(table, "block_with_vision", {"block", "blocks"});
  language.block_without_vision = heading(table, "block_without_vision", {"block", "blocks"});
  language.classification_block = heading(table, "classification_block", {"block", "blocks"});
  language.pause = heading(table, "break", {"trial", "trials"});
  language.resumed = heading(table, "resumed");
  language.end = heading(table, "end");
  language.match = heading(table, "match");
  language.satisfy = heading(table, "satisfy");
  language.classify = heading(table, "classify");
  language.question = heading(table, "question");
  language.questions_after_matching = table.texts("questions_after_matching", 0);
  language.questions_after_classification = table.texts("questions_after_classification", 0);
  language.labels = labels(table);
  language.pictures = table.texts("pictures", 4);
  if (language.pictures.size() != 4) table.fail("pictures", "expected four names");
  table.expect_no_other();
  return language;
}

}  // namespace forceshade::experiments
