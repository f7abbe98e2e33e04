// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/command.h"

#include <unistd.h>

#include <filesystem>

#include "forceshade/apps/length.h"
#include "forceshade/csv/output_file.h"
#include "forceshade/fast/law.h"
#include "forceshade/reference/law.h"

namespace forceshade::apps {
namespace {

std::vector<std::filesystem::path> made_directories;  // each after the one that it is in

std::string law_list() {
  std::string list;
  for (const LawName& law : kLaws) list += (list.empty() ? "" : ", ") + std::string(law.name);
  return list;
}

}  // namespace

LawOptions::LawOptions(CLI::App& command, Laws laws, Defaults defaults) {
  const bool all = laws == Laws::one_or_all;
  const std::string expected = (all ? "all, or one of " : "one of ") + law_list();
  if (all) law_ = "all";
  CLI::Option* law =
      command.add_option("--law", law_, expected)->type_name("ID")->check([all, expected](const std::string& name) {
        return (all && name == "all") || law_named(name) ? "" : "expected " + expected + "; got \"" + name + "\"";
      });
  if (!all) law->required();
  law_option_ = law;
  if (defaults == Defaults::thesis) {
    radius_ = "15.24mm";
    width_ = "25.4mm";
    stiffness_ = "0.5N/mm";
  }
  const auto add = [&](const char* name, std::string& value, const char* help) {
    CLI::Option* option = command.add_option(name, value, help)->type_name("VALUE");
    if (!value.empty()) option->capture_default_str();
    return option;
  };
  add("--radius", radius_, "R, radius of the bump: mm, or with a unit (mm, mil, in, cm, m)");
  add("--width", width_, "w, width of the bump on the plane: mm, or with a unit");
  CLI::Option* stiffness = add("--stiffness", stiffness_, "K, stiffness: N/mm");
  if (defaults == Defaults::none) stiffness->required();
}

void LawOptions::allow_instead(CLI::Option* other) {
  law_option_->required(false)->excludes(other);
  needed_unless_ = other;
}

float LawOptions::stiffness() const {
  if (const char* fault = fast::arithmetic_fault()) throw BadInput(std::string("no law can be trusted here: ") + fault);
  return parse_stiffness("--stiffness", stiffness_);
}

BumpOptions::BumpOptions(CLI::App& command) {
  const auto add = [&](const char* name, std::string& value, const char* help) {
    return command.add_option(name, value, help)->type_name("VALUE")->required();
  };
  options_ = {add("--radius", radius_, "R: mm, or with a unit (mm, mil, in, cm, m)"),
              add("--width", width_, "w: mm, or with a unit")};
}

void BumpOptions::allow_instead(CLI::Option* other) {
  for (CLI::Option* option : options_) option->required(false)->excludes(other);
}

Parameters BumpOptions::bump() const {
  for (const CLI::Option* option : options_)
    if (option->empty()) throw CLI::RequiredError(option->get_name());
  const Parameters bump{parse_length("--radius", radius_), parse_length("--width", width_), 1};
  const auto law = reference::Law::build(LawId::bump_cylinder, bump);
  if (const auto* error = std::get_if<ParameterError>(&law)) throw BadInput("--" + error->message());
  return bump;
}

std::vector<LawId> LawOptions::laws() const {
  if (needed_unless_ && law_.empty()) throw CLI::RequiredError("--law or " + needed_unless_->get_name());
  if (const auto id = law_named(law_)) return {*id};
  std::vector<LawId> all;
  for (const LawName& law : kLaws) all.push_back(law.id);
  return all;
}

Parameters LawOptions::parameters() const {
  Parameters p;
  p.stiffness = stiffness();
  const float radius = radius_.empty() ? 0 : parse_length("--radius", radius_);
  const float width = width_.empty() ? 0 : parse_length("--width", width_);
  for (const LawId id : laws()) {
    if (has_bump_geometry(id)) {
      if (radius_.empty()) throw BadInput("--radius: the law " + std::string(name_of(id)) + " needs it");
      if (width_.empty()) throw BadInput("--width: the law " + std::string(name_of(id)) + " needs it");
      p.radius = radius;
      p.width = width;
    }
    const auto law = fast::Law::build(id, p);
    if (const auto* error = std::get_if<ParameterError>(&law)) throw BadInput("--" + error->message());
  }
  return p;
}

void write_file(const std::string& path, const std::string& text) {
  csv::OutputFile file(path);
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
    throw BadInput(option + ' ' + path + ": expected a directory that can be written to" +
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
