// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a mesh file whose points of the texture have a unit, too.

#include <filesystem>

#include "files/decimal.h"
#include "forceshade/meshes.h"

namespace forceshade::mesh {

struct FileUnits {
  Unit length = Unit::mm;
  files::Decimal texture = 1;  // mm, of points of the texture
};

// As load_with_corners(). A number of a point of the texture is the binary32 number of mm nearest to the number in the file
// times their unit, rounded once, and is within 10000 mm; below 2^-30 mm in size it is 0.
LoadedMesh load_in_units(const std::filesystem::path& file, const FileUnits& units);

}  // namespace forceshade::mesh
