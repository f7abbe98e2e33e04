// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map as a small TOML file: how it is rendered, and its parts. The keys: docs/height-maps.md, "As a TOML file".

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "rendering/height_map.h"
#include "rendering/heights/load.h"

namespace forceshade::heights {

struct Spec {
  HeightMap map;
  height::Rendering rendering;
};

// Files of grids are taken relative to `file`. Throws Error, which names the line, the key, what was expected and what was got;
// whether a number is in its domain is for who builds a law to say.
Spec read_spec(const std::filesystem::path& file);

// On which lines each part and each of its keys stand, for messages about a number that is out of its domain.
struct PartLines {
  std::uint32_t part = 0;
  std::map<std::string, std::uint32_t> keys;

  // The line of the number that a ParameterError calls so, "sigma" for sigma_mm; the line of the part where no one key has it.
  std::uint32_t of(std::string parameter) const;
};
struct Lines {
  std::vector<PartLines> parts, surface;
};

// Throws Error.
Lines lines_of_parts(const std::filesystem::path& file);

// The same file as a text that stands in `directory`: its map shading polygons with these knots, whatever it was before.
std::string shading_polygons(const std::filesystem::path& file, const std::vector<height::Knot>& knots,
                             const std::filesystem::path& directory);

}  // namespace forceshade::heights
