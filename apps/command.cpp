// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "apps/length.h"
#include "apps/options.h"
#include "fast/law.h"
#include "files/output_file.h"
#include "files/suggestion.h"
#include "reference/law.h"

namespace forceshade::apps {
namespace {

constexpr const char *kRadiusHelp = "R, radius of the bump", *kWidthHelp = "w, width of the bump on the plane";

std::vector<std::filesystem::path> made_directories;  // each after the one that it is in

std::string expected_law(bool may_be_several) {
  std::string list;
  for (const LawName& law : kLaws) list += (list.empty() ? "" : ", ") + std::string(law.name);
  return (may_be_several ? "all, or one or several, with commas between them, of " : "one of ") + list;
}

std::vector<std::string> divided(const std::string& names) {
  std::vector<std::string> all{""};
  for (const char c : names)
    if (c == ',')
      all.emplace_back();
    else
      all.back() += c;
  return all;
}

// The words for the first name that is no law, or not another one than those before it.
std::string refusal_of_law(const std::string& names, bool may_be_several) {
  if (may_be_several && names == "all") return "";
  std::vector<std::string> known;
  for (const LawName& law : kLaws) known.emplace_back(law.name);
  const std::vector<std::string> all = may_be_several ? divided(names) : std::vector{names};
  for (auto name = all.begin(); name != all.end(); ++name) {
    if (!law_named(*name))
      return "expected " + expected_law(may_be_several) + "; got \"" + *name + '"' + files::suggestion(*name, known);
    if (std::find(all.begin(), name, *name) != name) return "expected each law once, got " + *name + " twice";
  }
  return "";
}

// Said where nobody chose the width that does not fit.
std::string refusal_of_bump(const ParameterError& error, const CLI::Option& width) {
  const bool is_unchosen = width.empty() && error.parameter == std::string_view("width");
  return "--" + error.message() +
         (is_unchosen ? "; the width is that of the thesis unless --width is given beside --radius" : "");
}

}  // namespace

LawOptions::LawOptions(CLI::App& command, Laws laws) {
  const bool all = laws == Laws::several;
  const std::string expected = expected_law(all);
  if (all) law_ = "all";
  CLI::Option* law = command.add_option("--law", law_, expected)->type_name("ID")->check([all](const std::string& name) {
    return refusal_of_law(name, all);
  });
  if (!all) law->required();
  law->group(kSubjectGroup);
  law_option_ = law;
  bump_options_ = {add_length(command, "--radius", radius_, kRadiusHelp), add_length(command, "--width", width_, kWidthHelp)};
  add_stiffness(command, stiffness_, "K, stiffness")->group(kSubjectGroup);
  for (CLI::Option* of_a_bump : bump_options_) of_a_bump->group(kSubjectGroup);
}

void LawOptions::allow_instead(CLI::Option* other) {
  law_option_->required(false)->excludes(other);
  for (CLI::Option* of_a_bump : bump_options_) of_a_bump->excludes(other);
  for (CLI::Option* earlier : needed_unless_) other->excludes(earlier);
  needed_unless_.push_back(other);
}

float LawOptions::stiffness() const {
  if (const char* fault = fast::arithmetic_fault()) throw BadInput(std::string("no law can be trusted here: ") + fault);
  return parse_stiffness("--stiffness", stiffness_);
}

BumpOptions::BumpOptions(CLI::App& command) {
  options_ = {add_length(command, "--radius", radius_, kRadiusHelp), add_length(command, "--width", width_, kWidthHelp)};
  for (CLI::Option* option : options_) option->group(kSubjectGroup);
}

void BumpOptions::allow_instead(CLI::Option* other) {
  for (CLI::Option* option : options_) option->excludes(other);
}

Parameters BumpOptions::bump() const {
  const Parameters bump{parse_length("--radius", radius_), parse_length("--width", width_), 1};
  const auto law = reference::Law::build(LawId::bump_cylinder, bump);
  if (const auto* error = std::get_if<ParameterError>(&law)) throw BadInput(refusal_of_bump(*error, *options_[1]));
  return bump;
}

std::vector<LawId> LawOptions::laws() const {
  if (!needed_unless_.empty() && law_.empty()) {
    std::string words = "--law";
    for (std::size_t i = 0; i < needed_unless_.size(); ++i)
      words += (i + 1 < needed_unless_.size() ? ", " : " or ") + needed_unless_[i]->get_name();
    throw CLI::RequiredError(words);
  }
  std::vector<LawId> all;
  if (law_ == "all")
    for (const LawName& law : kLaws) all.push_back(law.id);
  else
    for (const std::string& name : divided(law_)) all.push_back(*law_named(name));
  return all;
}

Parameters LawOptions::parameters() const {
  Parameters p;
  p.stiffness = stiffness();
  const float radius = parse_length("--radius", radius_), width = parse_length("--width", width_);
  for (const LawId id : laws()) {
    if (has_bump_geometry(id)) {
      p.radius = radius;
      p.width = width;
    }
    const auto law = fast::Law::build(id, p);
    if (const auto* error = std::get_if<ParameterError>(&law)) throw BadInput(refusal_of_bump(*error, *bump_options_[1]));
  }
  return p;
}

void write_file(const std::string& path, const std::string& text) {
  files::OutputFile file(path);
  file.stream() << text;
  file.commit();
}

void make_directory(const std::string& option, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path directory = fs::absolute(path, error).lexically_normal();
  fs::path so_far;
  for (const fs::path& part : directory) {
    so_far /= part;
    if (!error && fs::create_directory(so_far, error)) made_directories.push_back(so_far);
  }
  if (error || access(path.c_str(), W_OK) != 0)
    throw BadInput(option + ": expected a directory that can be written to, got \"" + path + '"' +
                   (error ? ": " + error.message() : ""));
}

void remove_unused_directories() {
  // From the innermost outwards; a directory that is not empty stays.
  for (; !made_directories.empty(); made_directories.pop_back()) {
    std::error_code not_empty;
    std::filesystem::remove(made_directories.back(), not_empty);
  }
}

}  // namespace forceshade::apps
