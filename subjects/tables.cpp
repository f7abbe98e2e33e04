// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/tables.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/quantity.h"
#include "files/suggestion.h"
#include "rendering/mesh_rendering.h"
#include "subjects/materials.h"
#include "subjects/words.h"

namespace forceshade::subjects {

namespace fs = std::filesystem;

namespace {

std::string place_of(const toml::node& node, const fs::path& file) {
  return file.string() + ": line " + std::to_string(node.source().begin.line);
}

}  // namespace

files::TomlDocument document_in(std::variant<files::TomlDocument, files::TomlFault> parsed, const std::string& file) {
  if (const auto* fault = std::get_if<files::TomlFault>(&parsed))
    throw Error(file + ": " + files::line_words(fault->line) + fault->reason);
  return std::get<files::TomlDocument>(std::move(parsed));
}

std::string beside(const fs::path& file, const std::string& name) {
  return (file.parent_path() / name).string();
}

bool is_former(std::string_view key, const toml::node& node, const fs::path& file) {
  if (key != "self-intersecting") return false;
  if (!node.is_boolean())
    throw Error(place_of(node, file) + ": " + std::string(key) + ": expected true or false, got " +
                files::words_of_value(node));
  return true;
}

Option option_of(const std::string& key, const toml::node& node, const files::TomlDocument& document, const fs::path& file,
                 const std::vector<std::string>& keys, const std::string& whose) {
  const std::string place = place_of(node, file);
  if (std::ranges::find(keys, key) == keys.end())
    throw Error(place + ": unknown key " + key + "; expected keys of a " + whose + files::suggestion(key, keys));
  Option option{key, document.words_of_scalars(node), place + ": " + key};
  if (option.value.empty())
    throw Error(option.name + ": expected a text in quotes, a number or a list of these, got " + files::words_of_value(node));
  option.value = with_file_placed(key, option.value, [&](const std::string& name) { return beside(file, name); });
  return option;
}

std::string Tables::name_of(const toml::node& at, std::string_view key) const {
  return file_ + ": line " + std::to_string(at.source().begin.line) + ": " + std::string(key);
}

void Tables::fail(const toml::node& at, std::string_view key, const std::string& expected, const toml::node& got) const {
  throw Error(name_of(at, key) + ": expected " + expected + ", got " + files::words_of_value(got));
}

const toml::table& Tables::table_of(std::string_view key, const toml::node& node) const {
  if (!node.is_table()) fail(node, key, "a table", node);
  return *node.as_table();
}

void Tables::expect_keys(const toml::table& table, const std::vector<std::string>& keys) const {
  for (const auto& [key, node] : table)
    if (std::ranges::find(keys, key.str()) == keys.end())
      throw Error(name_of(node, "unknown key ") + std::string(key.str()) + files::suggestion(key.str(), keys));
}

std::vector<const toml::table*> Tables::tables_of(const std::string& key) const {
  const toml::node* const list = root().get(key);
  if (list == nullptr) return {};
  if (!list->is_array_of_tables()) fail(*list, key, "[[" + key + "]]", *list);
  std::vector<const toml::table*> tables;
  for (const toml::node& one : *list->as_array()) tables.push_back(one.as_table());
  return tables;
}

std::string Tables::text_of(const toml::table& table, std::string_view key, std::string_view whose,
                            const std::string& expected) const {
  const toml::node* const node = table.get(key);
  if (node == nullptr) throw Error(name_of(table, whose) + ": expected " + expected + ", got none");
  const std::string text = node->value_exact<std::string>().value_or("");
  if (text.empty()) fail(*node, key, "a text in quotes", *node);
  return text;
}

mesh::Material Tables::material_of(const toml::table& table) const {
  mesh::Material made;
  const auto words = [&](const char* key, const toml::node& node, const char* expected) {
    const std::string text = document_.words_of_scalars(node);
    if (text.empty()) fail(node, key, expected, node);
    return text;
  };
  if (const toml::node* node = table.get("friction"))
    made = parse_friction(name_of(*node, "friction"), words("friction", *node, "a coefficient, or [static, dynamic]"));
  if (const toml::node* node = table.get("stiffness")) {
    const std::string name = name_of(*node, "stiffness");
    made.stiffness = files::parse_stiffness(name, words("stiffness", *node, "a stiffness such as \"0.5N/mm\""));
    if (const auto error = error_of_stiffness(*made.stiffness))
      throw Error(name + error->message().substr(std::string_view(error->parameter).size()));
  }
  for (const auto& [key, its] : {std::pair{"damping", &made.damping.damping}, std::pair{"drag", &made.damping.drag}})
    if (const toml::node* node = table.get(key)) {
      const std::string name = name_of(*node, key), text = words(key, *node, "a number such as \"2Ns/m\"");
      *its = text == "inf" ? HUGE_VALF : files::parse_damping(name, text) + 0.0F;  // -0 is 0
      if (const auto error = error_of_damping(*its))
        throw Error(name + error->message().substr(std::string_view(error->parameter).size()));
    }
  return made;
}

}  // namespace forceshade::subjects
