// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map as a small TOML file: how it is rendered, and its parts. The keys: docs/height-maps.md, "As a file".

#include <filesystem>

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

}  // namespace forceshade::heights
