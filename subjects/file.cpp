// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/file.h"

#include <algorithm>
#include <utility>

#include "files/printable.h"
#include "files/shell.h"
#include "files/suggestion.h"
#include "subjects/mesh.h"
#include "subjects/read.h"
#include "subjects/scene.h"
#include "subjects/tables.h"
#include "subjects/words.h"
#include "text/number_text.h"

namespace forceshade::subjects {
namespace {

namespace fs = std::filesystem;
using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t kLargestFile = 1 << 16;

Options options_of(const files::TomlDocument& document, const fs::path& file) {
  Options options;
  for (const auto& [key, node] : document.root()) {
    if (is_former(key.str(), node, file)) continue;
    if (key.str() != kDamping) {
      options.add(option_of(std::string(key.str()), node, document, file, names_of_keys(), "subject"));
      continue;
    }
    for (Option& one : options_of_damping(node, document, file)) options.add(std::move(one));
  }
  if (!options.has_kind())
    throw Error(file.string() + ": has none of the keys " + words_of_kinds("and", "") + "; expected one of them");
  return options;
}

// A subject file with these keys and values, in this order.
std::string file_of(const Entries& entries) {
  std::string text;
  for (const auto& [key, value] : entries) {
    if (value.empty()) continue;
    text += key + " = \"";
    for (const char c : files::printable(value)) text += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
    text += "\"\n";
  }
  return text;
}

std::string millimetres(float value) {
  return shortest(value) + "mm";
}

Entries entries_of_law(const DescribedLaw& law) {
  Entries entries{{"law", std::string(name_of(law.law))}};
  if (has_bump_geometry(law.law))
    entries.insert(entries.end(),
                   {{"radius", millimetres(law.parameters.radius)}, {"width", millimetres(law.parameters.width)}});
  return entries;
}

// The entries of a height map, mesh or scene.
Entries entries_of_one(const Options& options, bool with_folders) {
  if (options.has("mesh")) return written_mesh(options, with_folders);
  if (options.has("scene")) return written_scene(options, with_folders);
  const fs::path file = options.value("height-map");
  return {{"height-map", with_folders ? file.string() : file.filename().string()}};
}

std::string written_stiffness(const Options& options) {
  return shortest(stiffness_of(options)) + "N/mm";
}

}  // namespace

Options options_of_file(const fs::path& file) {
  return options_of(document_in(files::parse_toml_file(file, kLargestFile), file.string()), file);
}

Options options_of_text(const std::string& text, const fs::path& file) {
  return options_of(document_in(files::parse_toml(text, file, kLargestFile), file.string()), file);
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
    if (!value.empty()) words += (words.empty() ? "--" : " --") + key + ' ' + files::quoted_for_shell(value);
  return words;
}

}  // namespace forceshade::subjects
