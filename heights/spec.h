// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map as a small TOML file: how it is rendered, and its parts. The keys: docs/height-maps.md, "As a file".

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "forceshade/heights/load.h"
#include "forceshade/vocabulary/height_map.h"

namespace forceshade::heights {

struct Spec {
  HeightMap map;
  height::Rendering rendering;
};

// Files of grids are taken relative to `file`. Throws Error, which names the line, the key, what was expected and what was got;
// whether a number is in its domain is for who builds a law to say.
Spec read_spec(const std::filesystem::path& file);

// On which line each part begins, for messages about a number that is out of its domain. Throws Error.
struct PartLines {
  std::vector<std::uint32_t> parts, surface;
};
PartLines lines_of_parts(const std::filesystem::path& file);

// The same file as a text that stands in `directory`: its map shading polygons with these knots, whatever it was before.
std::string shading_polygons(const std::filesystem::path& file, const std::vector<height::Knot>& knots,
                             const std::filesystem::path& directory);

}  // namespace forceshade::heights
