// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A triangle mesh from a file. The ending of its name names the format. What is read of each format: formats.md.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "files/bad_input.h"
#include "rendering/mesh.h"

namespace forceshade::mesh {

// "FILE: line 12: reason", or "FILE: byte 84: reason" where the file is binary.
class Error : public files::BadInput {
 public:
  Error(const std::filesystem::path& file, const std::string& reason) : BadInput(file.string() + ": " + reason) {}
};

// The unit of the coordinates in the file, which no format states.
enum class Unit { mm, m, in };

inline constexpr std::array<std::string_view, 3> kUnitNames{"mm", "m", "in"};

using TexturePoint = std::array<float, 2>;

// A mesh with what else a file says of its corners.
struct LoadedMesh {
  TriangleMesh mesh;
  CornerNormals normals;                             // empty, or one for each corner of each triangle; as the file has them
  std::vector<std::array<TexturePoint, 3>> texture;  // the same
  std::vector<std::uint64_t> lines;                  // of each triangle's face, from 1; empty for a binary file
  std::vector<std::string> notes;                    // what the triangles are not word by word in the file: one sentence each
};

// The triangles in the order of the file; a face with more corners a, b, c, d, ... is the triangles (a, b, c), (a, c, d), ... A
// coordinate is the binary32 number of mm nearest to the number in the file times its unit, rounded once; below 2^-30 mm in
// size it is 0. Every coordinate is within 10000 mm and every index is that of a vertex. Nothing else is checked:
// rendering/meshes/check.h. Throws Error; then it has taken no more memory than some 100 times the file's size, whatever the
// file declares.
LoadedMesh load_with_corners(const std::filesystem::path& file, Unit unit);

// Its mesh alone.
TriangleMesh load(const std::filesystem::path& file, Unit unit);

}  // namespace forceshade::mesh
