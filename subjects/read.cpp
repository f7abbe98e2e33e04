// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/read.h"

#include <algorithm>
#include <filesystem>

#include "fast/domain.h"
#include "files/quantity.h"
#include "forceshade/fast.h"
#include "forceshade/subjects.h"
#include "subjects/damping.h"
#include "subjects/height_map.h"
#include "subjects/mesh.h"
#include "subjects/scene.h"
#include "subjects/words.h"

namespace forceshade::subjects {
namespace {

std::string given_or(const Options& options, std::string_view key, const char* usual) {
  return options.has(key) ? options.value(key) : usual;
}

// The error, with a hint where the width that does not fit is the default.
std::string refusal_of_bump(const ParameterError& error, const Options& options) {
  const bool is_unchosen = !options.has("width") && error.parameter == std::string_view("width");
  return words_of(error, options) +
         (is_unchosen ? "; the width is that of the thesis unless --width is given beside --radius" : "");
}

std::vector<LawId> ids_of(const std::string& names) {
  std::vector<LawId> ids;
  if (names == "all")
    for (const LawName& law : kLaws) ids.push_back(law.id);
  else
    for (const std::string& name : files::at_commas(names)) ids.push_back(*law_named(name));
  return ids;
}

std::vector<Description> read(const Options& options, Laws laws, const Monitor& monitor) {
  expect_consistent(options, laws);
  const std::string mesh = options.value("mesh"), scene = options.value("scene"), map = options.value("height-map");
  const float stiffness = stiffness_of(options);
  const auto name_of_file = [](const std::string& file) { return std::filesystem::path(file).filename().string(); };
  if (!scene.empty()) return {read_scene(options, stiffness, monitor)};
  const damping::Described damping = read_damping(options);
  if (!mesh.empty()) return {{name_of_file(mesh), read_mesh(options, stiffness, monitor), damping}};
  if (!map.empty()) {
    heights::Spec spec = read_height_map(options, stiffness);
    return {{name_of_file(map), DescribedHeightMap{std::move(spec.map), spec.mode, stiffness}, damping}};
  }
  std::vector<Description> all;
  for (const DescribedLaw& law : laws_of(options)) all.push_back({std::string(name_of(law.law)), law, damping});
  return all;
}

}  // namespace

std::vector<Description> read(const Options& options, const Monitor& monitor) {
  return read(options, Laws::several, monitor);
}

Description read_one(const Options& options, const Monitor& monitor) {
  return std::move(read(options, Laws::one, monitor).front());
}

Description read_file(const std::filesystem::path& file, const Monitor& monitor) {
  return read_one(options_of_file(file), monitor);
}

Description read_text(const std::string& text, const std::filesystem::path& file, const Monitor& monitor) {
  return read_one(options_of_text(text, file), monitor);
}

float stiffness_of(const Options& options) {
  if (const char* fault = fast::arithmetic_fault()) throw Error(std::string("no law can be trusted here: ") + fault);
  return files::parse_stiffness(options.name("stiffness"), given_or(options, "stiffness", kUsualStiffness));
}

std::vector<DescribedLaw> laws_of(const Options& options) {
  Parameters parameters;
  parameters.stiffness = stiffness_of(options);
  const float radius = files::parse_length(options.name("radius"), given_or(options, "radius", kUsualRadius)),
              width = files::parse_length(options.name("width"), given_or(options, "width", kUsualWidth));
  const std::vector<LawId> ids = ids_of(options.value("law"));
  // All have the same numbers; a law takes those that are its own.
  if (std::ranges::any_of(ids, has_bump_geometry)) {
    parameters.radius = radius;
    parameters.width = width;
  } else {
    for (const char* key : {"radius", "width"})
      if (options.has(key))
        throw Error(options.name(key) + ": has no effect on the law " + options.value("law") +
                    ", which has no bump; expected none");
  }
  std::vector<DescribedLaw> all;
  for (const LawId id : ids) {
    const auto law = fast::Law::build(id, parameters);
    if (const auto* error = std::get_if<ParameterError>(&law)) throw Error(refusal_of_bump(*error, options));
    all.push_back({id, parameters});
  }
  return all;
}

}  // namespace forceshade::subjects
