// SPDX-License-Identifier: BSD-3-Clause
#include "apps/height_map_option.h"

#include <filesystem>

#include "apps/options.h"
#include "fast/height_map_field.h"

namespace forceshade::apps {
namespace {

std::optional<ParameterError> error_of(const HeightMap& map, height::Rendering rendering, float stiffness) {
  const auto law = fast::HeightMapField::build(map, rendering, stiffness);
  const auto* error = std::get_if<ParameterError>(&law);
  return error == nullptr ? std::nullopt : std::optional(*error);
}

// The line of the number that is at fault, or of its part.
std::string place(const std::string& file, const HeightMap& map) {
  const heights::Lines lines = heights::lines_of_parts(file);
  const auto search = [&](const std::vector<height::Part>& parts, const std::vector<heights::PartLines>& at) -> std::string {
    for (std::size_t i = 0; i < parts.size() && i < at.size(); ++i)
      if (const auto error = error_of({{parts[i]}}, height::Rendering::true_height, 1))
        return "line " + std::to_string(at[i].of(error->parameter)) + ": ";
    return "";
  };
  const std::string line = search(map.parts, lines.parts);
  return line.empty() ? search(map.surface, lines.surface) : line;
}

}  // namespace

void expect_valid(const std::string& file, const heights::Spec& spec, float stiffness) {
  if (const auto error = error_of(spec.map, spec.rendering, stiffness))
    throw BadInput(file + ": " + place(file, spec.map) + error->message());
}

HeightMapOption::HeightMapOption(CLI::App& command, LawOptions& law) {
  CLI::Option* option =
      command.add_option("--height-map", file_, "instead of a law: a height map, a TOML file (docs/height-maps.md)")
          ->type_name("SPEC")
          ->group(kSubjectGroup);
  law.allow_instead(option);
}

std::string HeightMapOption::name() const {
  return std::filesystem::path(file_).filename();
}

heights::Spec HeightMapOption::read(float stiffness) const {
  heights::Spec spec = heights::read_spec(file_);
  if (const auto error = error_of({{{height::Plane{}}}}, height::Rendering::true_height, stiffness))
    throw BadInput("--" + error->message());
  expect_valid(file_, spec, stiffness);
  return spec;
}

}  // namespace forceshade::apps
