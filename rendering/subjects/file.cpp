// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/subjects/file.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "files/csv.h"
#include "files/printable.h"
#include "files/shell.h"
#include "files/suggestion.h"
#include "rendering/heights/toml_file.h"
#include "rendering/subjects/mesh.h"
#include "rendering/subjects/read.h"
#include "rendering/subjects/words.h"

namespace forceshade::subjects {
namespace {

namespace fs = std::filesystem;
using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t kLargestFile = 1 << 16;

std::string beside(const fs::path& file, const std::string& name) {
  return (file.parent_path() / name).string();
}

Option option_of(const std::string& key, const toml::node& node, const fs::path& file) {
  const std::string place = file.string() + ": line " + std::to_string(node.source().begin.line);
  const std::vector<std::string> keys = names_of_keys();
  if (std::ranges::find(keys, key) == keys.end())
    throw BadInput(place + ": unknown key " + key + "; expected keys of a subject" + files::suggestion(key, keys));
  Option option{key, heights::words_of_scalars(node), place + ": " + key};
  if (is_flag(key)) {
    const auto flag = node.value_exact<bool>();
    option.value = !flag ? "" : *flag ? "true" : "false";
  }
  if (option.value.empty())
    throw BadInput(option.name + ": expected " +
                   (is_flag(key) ? "true or false" : "a text in quotes, a number or a list of these") + ", got " +
                   heights::words_of_value(node));
  if (key == "mesh" || key == "height-map" || key == "materials") option.value = beside(file, option.value);
  if (key == "shading" && is_texture(option.value))
    option.value = std::string(kTexturePrefix) + beside(file, option.value.substr(kTexturePrefix.size()));
  return option;
}

Options options_of(const std::variant<toml::table, heights::TomlFault>& parsed, const fs::path& file) {
  if (const auto* fault = std::get_if<heights::TomlFault>(&parsed))
    throw BadInput(file.string() + ": " + (fault->line == 0 ? "" : "line " + std::to_string(fault->line) + ": ") +
                   fault->reason);
  Options options;
  for (const auto& [key, node] : std::get<toml::table>(parsed)) options.add(option_of(std::string(key.str()), node, file));
  if (!options.has("law") && !options.has("height-map") && !options.has("mesh"))
    throw BadInput(file.string() + ": has none of the keys law, height-map and mesh; expected one of them");
  return options;
}

// A subject file with these keys and values, in this order. A value is written as a text, but for "true".
std::string file_of(const Entries& entries) {
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

std::string millimetres(float value) {
  return files::shortest(value) + "mm";
}

Entries entries_of_law(const DescribedLaw& law) {
  Entries entries{{"law", std::string(name_of(law.law))}};
  if (has_bump_geometry(law.law))
    entries.insert(entries.end(),
                   {{"radius", millimetres(law.parameters.radius)}, {"width", millimetres(law.parameters.width)}});
  return entries;
}

// The entries of a height map or mesh.
Entries entries_of_one(const Options& options, bool with_folders) {
  if (options.has("mesh")) return written_mesh(options, with_folders);
  const fs::path file = options.value("height-map");
  return {{"height-map", with_folders ? file.string() : file.filename().string()}};
}

std::string written_stiffness(const Options& options) {
  return files::shortest(stiffness_of(options)) + "N/mm";
}

}  // namespace

Options options_of_file(const fs::path& file) {
  return options_of(heights::parse_toml_file(file, kLargestFile), file);
}

Options options_of_text(const std::string& text, const fs::path& file) {
  return options_of(heights::parse_toml(text, file, kLargestFile), file);
}

std::vector<std::string> written_files(const Options& options) {
  std::vector<Entries> subjects;
  if (options.has("law"))
    for (const DescribedLaw& law : laws_of(options)) subjects.push_back(entries_of_law(law));
  else
    subjects = {entries_of_one(options, false)};
  std::vector<std::string> texts;
  for (Entries& entries : subjects) {
    entries.emplace_back("stiffness", written_stiffness(options));
    texts.push_back(file_of(entries));
  }
  return texts;
}

std::string written_for_shell(const Options& options) {
  if (options.has("law")) return "";
  Entries entries = entries_of_one(options, true);
  entries.emplace_back("stiffness", written_stiffness(options));
  std::string words;
  for (const auto& [key, value] : entries)
    if (!value.empty())
      words += (words.empty() ? "--" : " --") + key + (value == "true" ? "" : ' ' + files::quoted_for_shell(value));
  return words;
}

}  // namespace forceshade::subjects
