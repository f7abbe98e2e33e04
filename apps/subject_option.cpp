// SPDX-License-Identifier: BSD-3-Clause
#include "apps/subject_option.h"

#include <string_view>

#include "apps/options.h"
#include "apps/subject_file.h"
#include "files/csv.h"
#include "properties/height_map_subject.h"
#include "properties/law_subject.h"
#include "properties/mesh_subject.h"

namespace forceshade::apps {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

std::string millimetres(float value) {
  return files::shortest(value) + "mm";
}

Entries entries_of_law(LawId id, const Parameters& parameters) {
  Entries entries{{"law", std::string(name_of(id))}};
  if (has_bump_geometry(id))
    entries.insert(entries.end(), {{"radius", millimetres(parameters.radius)}, {"width", millimetres(parameters.width)}});
  return entries;
}

// As one word of a command line.
std::string quoted_for_shell(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+-@%";
  if (word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

SubjectOption::SubjectOption(CLI::App& command, LawOptions::Laws laws)
    : law_(command, laws), height_map_(command, law_), mesh_(command, law_) {
  // expand_subject_files() has put the file's options in its place before the command line is parsed.
  command.add_option("--subject", "a TOML file that has these options as its keys (docs/subjects.md)")
      ->type_name("FILE")
      ->group(kSubjectGroup);
}

std::vector<std::shared_ptr<const properties::Subject>> SubjectOption::subjects() const {
  if (mesh_.is_given()) return {std::make_shared<properties::MeshSubject>(mesh_.name(), mesh_.read(law_.stiffness()))};
  if (height_map_.is_given()) {
    const float stiffness = law_.stiffness();
    const auto [map, rendering] = height_map_.read(stiffness);
    return {std::make_shared<properties::HeightMapSubject>(height_map_.name(), map, rendering, stiffness)};
  }
  const Parameters parameters = law_.parameters();
  std::vector<std::shared_ptr<const properties::Subject>> all;
  for (const LawId id : law_.laws()) all.push_back(std::make_shared<properties::LawSubject>(id, parameters));
  return all;
}

Rendering SubjectOption::rendering() const {
  if (mesh_.is_given()) return built(rendering_of(mesh_.name(), mesh_.read(law_.stiffness())));
  if (height_map_.is_given()) {
    const float stiffness = law_.stiffness();
    const auto [map, rendering] = height_map_.read(stiffness);
    return built(rendering_of(height_map_.name(), map, rendering, stiffness));
  }
  return built(rendering_of(law_.laws().front(), law_.parameters()));
}

std::vector<std::string> SubjectOption::subject_files() const {
  std::vector<Entries> subjects;
  if (mesh_.is_given())
    subjects = {mesh_.entries()};
  else if (height_map_.is_given())
    subjects = {{{"height-map", height_map_.name()}}};
  else
    for (const LawId id : law_.laws()) subjects.push_back(entries_of_law(id, law_.parameters()));
  std::vector<std::string> texts;
  for (Entries& entries : subjects) {
    entries.emplace_back("stiffness", files::shortest(law_.stiffness()) + "N/mm");
    texts.push_back(subject_file_text(entries));
  }
  return texts;
}

std::string SubjectOption::options_for_shell() const {
  if (is_a_law()) return "";
  Entries entries = mesh_.is_given() ? mesh_.entries(true) : Entries{{"height-map", height_map_.file()}};
  entries.emplace_back("stiffness", files::shortest(law_.stiffness()) + "N/mm");
  std::string options;
  for (const auto& [key, value] : entries)
    if (!value.empty())
      options += (options.empty() ? "--" : " --") + key + (value == "true" ? "" : ' ' + quoted_for_shell(value));
  return options;
}

std::shared_ptr<const properties::Subject> read_subject(const std::string& file) {
  CLI::App command("", "subject");
  const SubjectOption subject(command, LawOptions::Laws::one);
  const ExpandedLine line = expand_subject_files({"--subject", file});
  try {
    command.parse(std::vector<std::string>(line.words.rbegin(), line.words.rend()));
    return subject.subject();
  } catch (const CLI::ParseError& error) {
    throw BadInput(line.placed(reason_of(command, error)));
  } catch (const BadInputOfLines&) {
    throw;
  } catch (const BadInput& error) {
    throw BadInput(line.placed(error.what()));
  }
}

}  // namespace forceshade::apps
