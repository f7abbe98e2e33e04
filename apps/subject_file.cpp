// SPDX-License-Identifier: BSD-3-Clause
#include "apps/subject_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "apps/bad_input.h"
#include "files/csv.h"
#include "files/printable.h"
#include "files/suggestion.h"
#include "rendering/heights/toml_file.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 1 << 16;
constexpr std::string_view kOption = "--subject", kTexture = "texture:";
const std::array<std::string, 13> kKeys{"law",   "radius",  "width",   "stiffness",     "height-map",        "mesh",  "unit",
                                        "sides", "shading", "contact", "texture-scale", "self-intersecting", "crease"};

std::string beside(const fs::path& file, const std::string& name) {
  return (file.parent_path() / name).string();
}

// A text, a number, or a list of texts with commas between them; empty for anything else.
std::string words_of_subject_value(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
  if (const auto number = node.value_exact<double>()) return files::shortest(*number);
  std::string all;
  if (const toml::array* list = node.as_array())
    for (const toml::node& each : *list) {
      const auto text = each.value_exact<std::string>();
      if (!text) return "";
      all += (all.empty() ? "" : ",") + *text;
    }
  return all;
}

void append(const std::string& file, ExpandedLine& line) {
  const auto read = heights::parse_toml_file(file, kLargestFile);
  if (const auto* fault = std::get_if<heights::TomlFault>(&read))
    throw BadInput(file + ": " + (fault->line == 0 ? "" : "line " + std::to_string(fault->line) + ": ") + fault->reason);
  const toml::table& table = std::get<toml::table>(read);
  for (const auto& [key_of_table, node] : table) {
    const std::string key(key_of_table.str());
    const std::string place = file + ": line " + std::to_string(node.source().begin.line);
    if (std::ranges::find(kKeys, key) == kKeys.end())
      throw BadInput(place + ": unknown key " + key + "; expected keys of a subject" +
                     files::suggestion(key, {kKeys.begin(), kKeys.end()}));
    const std::string option = "--" + key;
    line.places.emplace(option, place + ": " + key);
    if (const auto flag = node.value_exact<bool>(); flag && key == "self-intersecting") {
      if (*flag) line.words.push_back(option);
      continue;
    }
    std::string value = words_of_subject_value(node);
    if (value.empty() || key == "self-intersecting")
      throw BadInput(place + ": " + key + ": expected " +
                     (key == "self-intersecting" ? "true or false" : "a text in quotes, a number or a list of texts") +
                     ", got " + heights::words_of_value(node));
    if (key == "mesh" || key == "height-map") value = beside(file, value);
    if (key == "shading" && value.starts_with(kTexture) && value != kTexture)
      value = std::string(kTexture) + beside(file, value.substr(kTexture.size()));
    line.words.push_back(option + '=' + value);
  }
  if (!table.contains("law") && !table.contains("height-map") && !table.contains("mesh"))
    throw BadInput(file + ": has none of the keys law, height-map and mesh; expected one of them");
}

}  // namespace

std::string ExpandedLine::placed(const std::string& message) const {
  const std::string option = message.substr(0, message.find_first_of(": ,"));
  const auto found = places.find(option);
  return found == places.end() ? message : found->second + message.substr(option.size());
}

ExpandedLine expand_subject_files(const std::vector<std::string>& words) {
  ExpandedLine line;
  bool is_expanded = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = words[i].starts_with(std::string(kOption) + '=');
    if (words[i] != kOption && !has_value) {
      line.words.push_back(words[i]);
      continue;
    }
    if (is_expanded) throw BadInput("--subject: expected once, got several times");
    is_expanded = true;
    const std::string file = has_value ? words[i].substr(kOption.size() + 1) : i + 1 < words.size() ? words[++i] : "";
    if (file.empty() || (!has_value && file.starts_with("-"))) throw BadInput("--subject: expected a file after it, got none");
    append(file, line);
  }
  return line;
}

std::string subject_file_text(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string text;
  for (const auto& [key, value] : entries) {
    if (value.empty()) continue;
    text += key + " = ";
    if (value == "true") {
      text += value;
    } else {
      text += '"';
      for (const char c : files::printable(value)) text += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
      text += '"';
    }
    text += '\n';
  }
  return text;
}

}  // namespace forceshade::apps
