// SPDX-License-Identifier: BSD-3-Clause
#include "apps/subject_option.h"

#include <algorithm>
#include <filesystem>

#include "apps/options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_file.h"
#include "apps/tell.h"
#include "forceshade/checks.h"
#include "forceshade/mesh.h"
#include "forceshade/meshes.h"
#include "text/joined.h"

namespace forceshade::apps {
namespace {

constexpr const char *kRadiusHelp = "R, radius of the bump", *kWidthHelp = "w, width of the bump on the plane";

// Calls `read` with a monitor that draws how far the check of the mesh or scene is, if there is one.
template <class Read>
auto read_by(const subjects::Options& options, const Read& read) {
  const std::string file = options.value(options.has("scene") ? "scene" : "mesh");
  return with_progress("check of " + std::filesystem::path(file).filename().string(),
                       [&](const Monitor& monitor) { return read(options, monitor); });
}

}  // namespace

SubjectOption::SubjectOption(CLI::App& command, subjects::Laws laws, bool damps) : laws_(laws), damps_(damps) {
  const std::string group = command.option_defaults()->get_group();
  command.option_defaults()->group(kSubjectGroup);
  const auto add = [&](const std::string& key, const std::string& type, const std::string& help) {
    CLI::Option* option = command.add_option("--" + key, values_[key], help)->type_name(type);
    option->check([key, laws](const std::string& value) { return subjects::refusal_of(key, value, laws); });
    return options_[key] = option;
  };
  const auto add_usual = [&](const std::string& key, const std::string& type, const std::string& help, const char* usual) {
    values_[key] = usual;
    return add(key, type, help)->capture_default_str();
  };
  CLI::Option* law = add("law", "ID", subjects::expected_law(laws));
  CLI::Option* radius = add_usual("radius", "LENGTH", kRadiusHelp, subjects::kUsualRadius);
  CLI::Option* width = add_usual("width", "LENGTH", kWidthHelp, subjects::kUsualWidth);
  add_usual("stiffness", "STIFFNESS", "K, stiffness", subjects::kUsualStiffness);
  CLI::Option* map = add("height-map", "SPEC", "instead of a law: a height map, a TOML file (docs/height-maps.md)");
  for (CLI::Option* of_a_law : {law, radius, width}) of_a_law->excludes(map);
  CLI::Option* mesh =
      add("mesh", "FILE", "instead of a law: a triangle mesh, an OBJ, OFF, PLY or STL file (docs/meshes.md)")->excludes(map);
  for (CLI::Option* of_a_law : {law, radius, width}) of_a_law->excludes(mesh);
  CLI::Option* scene =
      add("scene", "FILE", "instead of a law: objects at their places or with a motion, a TOML file (docs/scenes.md)")
          ->excludes(map);
  for (CLI::Option* other : {law, radius, width, mesh}) other->excludes(scene);
  add("unit", joined(mesh::kUnitNames, "|"), "of a mesh's coordinates, which no format says")->needs(mesh);
  // Options of meshes and scenes: expect_consistent() says where one of these is missing.
  add("sides", joined(mesh::kSidesNames, "|"),
      "of a mesh or scene that block motion; default: front where it is closed, else both");
  add("shading", joined(subjects::shading_words(), "|"),
      "of a mesh or scene: vertex, which is the default, turns the force to the interpolated normal, edge as the thesis has "
      "it, texture, of a mesh alone, tilts that normal by a height map, a TOML file");
  add_usual(
      "contact", joined(mesh::kContactNames, "|"),
      "of a mesh or scene: in a contact the god-object goes for the position (direct), or for that as a plane would hold it "
      "which is turned to the interpolated normal (sub-goal); then --shading is none unless given; or it sticks and slips "
      "(friction), which is the default beside coefficients of friction",
      name_of(mesh::kUsualContact).data());
  CLI::Option* friction =
      add("friction", "MU|STATIC,DYNAMIC", "of a mesh: coefficients of friction, each 0, inf or from 2^-10 to 1024")
          ->needs(mesh);
  add("materials", "FILE", "of a mesh: a TOML file with friction, stiffness and damping of groups and faces (docs/meshes.md)")
      ->needs(mesh)
      ->excludes(friction);
  add("texture-scale", "LENGTH",
      "of a textured mesh: the length of one unit of the texture coordinates in its file, which no format says")
      ->needs(mesh);
  add("crease", "ANGLE (0 to 180)", "of a mesh or scene: an edge that turns by more is not shaded over");
  if (damps) {
    add(std::string(subjects::kDamping), "DAMPING[,MOST]",
        "B, damping along the force, in N s/mm, and behind a comma the most by which it lengthens the force, 1 to 1024 or inf "
        "(docs/damping.md); default: none, 2");
    add(std::string(subjects::kDrag), "DAMPING[,FORCE]",
        "drag across the force, in N s/mm, and behind a comma the force in N from which on it is full; default: none, 0.25");
    add(std::string(subjects::kDampingFilter), "SHARE|TIME",
        "the filter of the damper's velocity: the share of the newest one, 2^-10 to 1, or a time constant such as 2ms; "
        "default: 1, no filter");
  }
  // expand_subject_files() has put the file's options in its place before the command line is parsed.
  command.add_option("--subject", "a TOML file that has these options as its keys (docs/subjects.md)")->type_name("FILE");
  command.option_defaults()->group(group);
}

bool SubjectOption::is_given() const {
  return std::ranges::any_of(options_, [](const auto& each) {
    return std::ranges::find(subjects::kKinds, each.first) != subjects::kKinds.end() && !each.second->empty();
  });
}

subjects::Options SubjectOption::options() const {
  subjects::Options given;
  for (const auto& [key, option] : options_)
    if (!option->empty()) given.add({key, values_.at(key)});
  if (is_given()) return given;
  if (laws_ == subjects::Laws::one) throw CLI::RequiredError(subjects::words_of_kinds("or"));
  given.add({"law", "all"});
  return given;
}

std::vector<Description> SubjectOption::descriptions() const {
  if (laws_ == subjects::Laws::several) return read_by(options(), subjects::read);
  std::vector<Description> one{read_with_progress(options())};
  if (!damps_ && !one.front().damping.parameters.is_off()) tell(one.front().name + kDampingLeftOut);
  return one;
}

std::vector<std::shared_ptr<const properties::Subject>> SubjectOption::subjects() const {
  std::vector<std::shared_ptr<const properties::Subject>> all;
  for (const Description& one : descriptions()) all.push_back(properties::subject_of(one));
  return all;
}

Rendering SubjectOption::rendering() const {
  return built(rendering_of(description()));
}

Description read_with_progress(const subjects::Options& options) {
  return read_by(options, subjects::read_one);
}

BumpOptions::BumpOptions(CLI::App& command)
    : radius_option_(add_length(command, "--radius", radius_, kRadiusHelp)),
      width_option_(add_length(command, "--width", width_, kWidthHelp)) {
  for (CLI::Option* option : {radius_option_, width_option_}) option->group(kSubjectGroup);
}

Parameters BumpOptions::bump() const {
  subjects::Options options{{"law", std::string(name_of(LawId::bump_cylinder))}, {"stiffness", "1"}};
  if (!radius_option_->empty()) options.add({"radius", radius_});
  if (!width_option_->empty()) options.add({"width", width_});
  return subjects::laws_of(options).front().parameters;
}

}  // namespace forceshade::apps
