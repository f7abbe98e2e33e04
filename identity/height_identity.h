// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which height map a certificate is about: bound to its numbers, not to the name of a file.

#include <string>
#include <vector>

#include "forceshade/vocabulary/height_map.h"

namespace forceshade::properties {

// What must be the same for two renderers of height maps to be the same.
struct HeightIdentity {
  std::string map_digest;  // SHA-256 of the kind and every number of every part, grid values included, in hex
  height::Rendering rendering = height::Rendering::true_height;
  float stiffness = 0;  // N/mm

  friend bool operator==(const HeightIdentity&, const HeightIdentity&) = default;
};

HeightIdentity identity_of(const HeightMap& map, height::Rendering rendering, float stiffness);

// One line for each part: "gaussian: x_mm 0, y_mm 0, height_mm 3, sigma_mm 5".
std::vector<std::string> words_of(const HeightMap& map);

}  // namespace forceshade::properties
