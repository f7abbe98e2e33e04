// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/height_map.h"

#include "forceshade/fast.h"
#include "rendering/mesh_rendering.h"
#include "subjects/words.h"

namespace forceshade::subjects {
namespace {

std::optional<ParameterError> error_of(const HeightMap& map, height::Mode mode) {
  const auto law = fast::HeightMapField::build(map, mode, 1);
  const auto* error = std::get_if<ParameterError>(&law);
  return error == nullptr ? std::nullopt : std::optional(*error);
}

// The line of the number that is at fault, or of its part.
std::string place(const std::string& file, const HeightMap& map) {
  const heights::Lines lines = heights::lines_of_parts(file);
  const auto search = [&](const std::vector<height::Part>& parts, const std::vector<heights::PartLines>& at) -> std::string {
    for (std::size_t i = 0; i < parts.size() && i < at.size(); ++i)
      if (const auto error = error_of({{parts[i]}}, height::Mode::true_height))
        return "line " + std::to_string(at[i].of(error->parameter)) + ": ";
    return "";
  };
  const std::string line = search(map.parts, lines.parts);
  return line.empty() ? search(map.surface, lines.surface) : line;
}

}  // namespace

void expect_valid(const std::string& file, const heights::Spec& spec) {
  if (const auto error = error_of(spec.map, spec.mode)) throw Error(file + ": " + place(file, spec.map) + error->message());
}

heights::Spec read_height_map(const Options& options, float stiffness) {
  const std::string file = options.value("height-map");
  heights::Spec spec = heights::read_spec(file);
  if (const auto error = error_of_stiffness(stiffness)) throw Error(words_of(*error, options));
  expect_valid(file, spec);
  return spec;
}

}  // namespace forceshade::subjects
