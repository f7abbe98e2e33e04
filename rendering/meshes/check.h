// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a mesh must be (docs/meshes.md, "What is checked"), decided exactly; what is not is said in words with the numbers
// of faces and vertices, from 0 as in the file.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rendering/mesh.h"
#include "rendering/monitor.h"

namespace forceshade::mesh {

enum class Fault {
  coordinate,      // not a number within 10000 mm
  index,           // not that of a vertex
  empty,           // no triangle at all, or more than can be counted
  vertex_twice,    // in one triangle
  no_area,         // three vertices on a line
  same_vertices,   // as another triangle, in whatever order
  many_at_edge,    // an edge with more than two triangles
  same_direction,  // two triangles run along their edge in the same direction
  several_fans,    // the triangles at a vertex are not one fan
  meeting,         // two triangles have more points in common than their common vertices say
  in_one_plane,    // the same in one plane, of triangles that may cross elsewhere
  undecided        // too many pairs of triangles are near each other to decide the last in reasonable time
};
inline constexpr std::size_t kFaults = 12;

struct Finding {
  Fault fault{};
  std::vector<std::uint32_t> triangles, vertices;  // which it is about; of many only the first

  bool operator==(const Finding&) const = default;
};

// One sentence.
std::string words_of(const Finding& finding);

struct Findings {
  static constexpr std::size_t kListed = 20;  // the most findings of a fault that are listed: the first ones

  std::vector<Finding> listed;                  // in the order of the faults, then of the faces and vertices
  std::array<std::uint64_t, kFaults> counts{};  // of each fault

  bool empty() const { return listed.empty(); }
  // The listed ones, one in a line, and how many more there are. lines: of each triangle in its file (LoadedMesh::lines); where
  // there are any, those of a finding's triangles stand in front of it: "lines 12 and 15: ".
  std::string words(std::span<const std::uint64_t> lines = {}) const;
};

// A coordinate below 2^-30 mm in size is 0 in the mesh that these give; nothing else is changed. All faults are looked for that
// can still be decided beside those found.

// All but whether triangles meet beside their common vertices.
std::variant<JoinedMesh, Findings> check_joints(TriangleMesh mesh);

// Takes some 50 bytes a triangle beside the mesh, and as many threads as the machine has cores, 8 at most; what it finds does
// not depend on their number. With self-intersections allowed, triangles with a common vertex still meet in what they share
// alone, and those in one plane do not meet. Throws Interrupted.
std::variant<CheckedMesh, Findings> check(TriangleMesh mesh, SelfIntersections self_intersections = SelfIntersections::refused,
                                          const Monitor& monitor = {});

}  // namespace forceshade::mesh
