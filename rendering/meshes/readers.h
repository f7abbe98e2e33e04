// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Declarations shared by the readers of the formats.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "forceshade/error.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/lines.h"
#include "rendering/meshes/load.h"
#include "text/number_text.h"

namespace forceshade::mesh {

LoadedMesh read_obj(const std::filesystem::path& file, const FileUnits& units);
LoadedMesh read_off(const std::filesystem::path& file, const FileUnits& units);
LoadedMesh read_ply(const std::filesystem::path& file, const FileUnits& units);
LoadedMesh read_stl(const std::filesystem::path& file, const FileUnits& units);

// More of either no file may have, so that three times the number fits in 32 bits.
inline constexpr std::uint64_t kMost = std::uint64_t{1} << 28;

// A corner of a face: places in the lists of vertices, normals and points of the texture.
struct Corner {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::uint32_t vertex = 0, normal = kNone, texture = kNone;
};

// The most corners of one face. Its triangles have a vertex in common, so that the check, which compares each two of them,
// takes time that grows with the square: 0.9 s for as many as this.
inline constexpr std::size_t kMostCorners = 4096;

// Gives triangles their names of one kind. It takes no memory as long as none has one.
class Naming {
 public:
  // The name of the triangles that are added from now on; empty for none.
  void begin(std::string_view name);
  // The next triangle, in front of which there are so many.
  void add(std::size_t before);
  FaceNames take(std::size_t triangles);

 private:
  FaceNames named_;
  std::unordered_map<std::string, std::uint32_t> places_;
  std::string name_;
  std::uint32_t place_ = FaceNames::kNone;  // of name_, once a triangle has it
};

// Makes a mesh of the vertices and faces of a file.
class Builder {
 public:
  std::vector<Vertex> vertices;
  std::vector<Normal> normals;
  std::vector<TexturePoint> texture;
  Naming materials, groups;

  // Adds a face of 3 corners or more, whose places are in the lists. A face of more than kMostCorners makes take() throw.
  // line: of the file, from 1; 0 where the file is binary.
  void add_face(std::span<const Corner> corners, std::uint64_t line);
  bool has_faces() const { return faces_ > 0; }
  // Room for as many as a file declares, but for kMost at most: a size_t of 32 bits holds these, and take() refuses more.
  void reserve_vertices(std::uint64_t count) { vertices.reserve(static_cast<std::size_t>(std::min(count, kMost))); }
  void reserve_triangles(std::uint64_t count) {
    loaded_.mesh.triangles.reserve(static_cast<std::size_t>(std::min(count, kMost)));
  }

  // Throws Error where there is no triangle, or are too many.
  LoadedMesh take(const std::filesystem::path& file);

 private:
  LoadedMesh loaded_;
  std::uint64_t faces_ = 0, split_faces_ = 0;
  struct LongFace {
    std::uint64_t face, line;  // the first one, from 1
    std::size_t corners;
  };
  std::optional<LongFace> too_long_;
  // The first face with a corner that has none, from 1.
  std::optional<std::uint64_t> without_normal_, without_texture_;
};

// The coordinate that a number of mm is read as; nothing where it is no coordinate.
std::optional<float> coordinate(float number);

// A coordinate of a vertex. Throws Error.
float coordinate_of(const Lines& lines, std::string_view word, Unit unit);
// A component of a normal, without a unit, or of a point of the texture in units of so many mm, with the limits of a
// coordinate. Throws Error.
float component_of(const Lines& lines, std::string_view word, const files::Decimal& unit = 1);
// The message about a number, `got`, that is no coordinate within 10000 mm, and about one that is no component.
std::string refusal_of_coordinate(const std::string& got, Unit unit);
std::string refusal_of_component(const std::string& got, const files::Decimal& unit);

// Reads a text in the first layout, or, where that fails, in the second. Where both fail, the error is that of the first, in
// which most files are written.
template <class First, class Second>
LoadedMesh in_either_layout(const First& first, const Second& second) {
  try {
    return first();
  } catch (const Error&) {
    try {
      return second();
    } catch (const Error&) {
    }
    throw;
  }
}

// Throws Error where a file of so many bytes cannot hold the number of things, each of so many bytes at least, or where they
// are more than kMost. `place` is "line 12: " or "byte 84: ".
void expect_room(const std::filesystem::path& file, const std::string& place, std::uint64_t number, const std::string& things,
                 std::uint64_t bytes_each, std::uint64_t bytes);

}  // namespace forceshade::mesh
