// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads triangle meshes from files, repairs them on demand, checks them exactly, and computes corner normals. The library is
// forceshade::meshes, of the component meshes.
//
//   const auto checked = mesh::check(mesh::load("sphere.off", mesh::Unit::mm));
//   if (const auto* findings = std::get_if<mesh::Findings>(&checked)) throw std::runtime_error(findings->words());
//   const auto& mesh = std::get<mesh::CheckedMesh>(checked);
//   const MeshRendering rendering{.checked = mesh,
//                                 .normals = mesh::corner_normals(mesh).normals,
//                                 .shading = mesh::Shading::vertex_scheme,
//                                 .stiffness = 0.5F};  // N/mm; for fast::GodObject of fast.h
//
// Coordinates are in mm, within 10 000 mm. The demands on a mesh: docs/meshes.md, "What is checked".
//
// Errors: unreadable files throw Error; defects of a readable mesh are returned as Findings, in words with the numbers
// of faces and vertices, from 0 as in the file.
//
// Threads: the functions keep no state, and may run at once; check() uses threads of its own.
//
// Not promised: the words of findings and notes, and how long check() takes of a mesh that crosses itself often.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/error.h"
#include "forceshade/mesh.h"

namespace forceshade::mesh {

// The unit of the coordinates in the file, which no format states.
enum class Unit { mm, cm, m, in };

inline constexpr std::array<std::string_view, 4> kUnitNames{"mm", "cm", "m", "in"};

using TexturePoint = std::array<float, 2>;

// The names that a file gives its faces, one to each or none.
struct FaceNames {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::vector<std::string> names;          // each once, in the order in which faces first have it
  std::vector<std::uint32_t> of_triangle;  // the place of its name in the list, or kNone; empty where no face has a name
};

// A mesh with what else a file says of its corners and faces.
struct LoadedMesh {
  TriangleMesh mesh;
  CornerNormals normals;                             // empty, or one for each corner of each triangle; as the file has them
  std::vector<std::array<TexturePoint, 3>> texture;  // the same
  std::vector<std::uint64_t> lines;                  // of each triangle's face, from 1; empty for a binary file
  std::vector<std::string> notes;                    // changes from the file's own words, one sentence each
  FaceNames materials;                               // usemtl of an OBJ file, material or material_index of a PLY file
  FaceNames groups;                                  // g of an OBJ file
};

// The triangles in the order of the file; a face with more corners a, b, c, d, ... is the triangles (a, b, c), (a, c, d), ... A
// coordinate is the binary32 number of mm nearest to the number in the file times its unit, rounded once; below 2^-30 mm in
// size it is 0. Every coordinate is within 10000 mm and every index is that of a vertex. Nothing else is checked:
// include/forceshade/meshes.h. Throws Error; then it has taken no more memory than some 100 times the file's size, whatever the
// file declares.
LoadedMesh load_with_corners(const std::filesystem::path& file, Unit unit);

// Its mesh alone.
TriangleMesh load(const std::filesystem::path& file, Unit unit);

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
  undecided        // too many pairs of triangles are near each other to decide the last in reasonable time
};
inline constexpr std::size_t kFaults = 11;

struct Finding {
  Fault fault{};
  std::vector<std::uint32_t> triangles, vertices;  // that it is about; of many only the first

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
// not depend on their number. Throws Interrupted.
std::variant<CheckedMesh, Findings> check(TriangleMesh mesh, const Monitor& monitor = {});

// As check() where the mesh is regular; any other set of triangles is given, too, as it is. Findings are of coordinates,
// indices and counts alone, or of the triangles where none has an area. Throws Interrupted.
std::variant<CheckedMesh, Findings> check_any(TriangleMesh mesh, const Monitor& monitor = {});

// The sides of which no other are named. `front` where each edge has as many triangles in one direction as in the other, which
// a closed mesh has; else `both`. Triangles without area do not count, and vertices with equal coordinates are one.
Sides usual_sides(const CheckedMesh& mesh);

struct Facts {
  std::uint64_t vertices = 0, triangles = 0;
  std::uint64_t unused_vertices = 0;           // in no triangle
  std::uint64_t edges = 0, rim_edges = 0;      // of all; with one triangle
  std::uint64_t parts = 0;                     // joined over edges
  Vertex low{}, high{};                        // mm: the box around the used vertices
  double shortest_edge = 0, longest_edge = 0;  // mm
  double area = 0;                             // mm^2
  double volume = 0;                           // mm^3, signed, of a closed mesh: negative where the fronts are inside; else 0

  bool is_closed() const { return rim_edges == 0; }
};

// The mesh is regular.
Facts facts_of(const CheckedMesh& mesh);

// The kinds of things that a regular mesh has not (docs/soups.md). Pairs of triangles touch where their borders alone meet,
// beside what common vertices say; their insides cross, or coincide in one plane.
enum class Irregularity { no_area, same_vertices, many_at_edge, same_direction, several_fans, touching, crossing, coinciding };
inline constexpr std::array<std::string_view, 8> kIrregularityNames{"faces without area",
                                                                    "faces with the vertices of a face before them",
                                                                    "edges with more than two faces",
                                                                    "edges with faces turned over",
                                                                    "vertices with several fans",
                                                                    "pairs of faces that touch",
                                                                    "pairs of faces that cross",
                                                                    "pairs of faces that coincide"};

struct Irregularities {
  static constexpr std::size_t kListed = 5;

  struct Place {
    std::vector<std::uint32_t> triangles;  // of many only the first
    Vertex near{};                         // mm: the vertex, the middle of the edge, or of the box in which two triangles meet
  };
  struct Kind {
    std::uint64_t count = 0;
    std::vector<Place> places;  // the first ones
  };
  std::array<Kind, kIrregularityNames.size()> kinds;
  std::uint64_t equal_vertices = 0;  // that have the coordinates of one before them
  bool is_complete = true;           // false: too many triangles are near each other to look at all pairs

  const Kind& of(Irregularity kind) const { return kinds[static_cast<std::size_t>(kind)]; }
};

// Each decided exactly. Vertices with equal coordinates count as one, and triangles without area for no_area alone. Every index
// is that of a vertex, and every coordinate is within 10000 mm. Throws Interrupted.
Irregularities irregularities_of(TriangleMesh mesh, const Monitor& monitor = {});

// Two triangles, the lower first, with edges of one triangle each, as irregularities_of() counts, that come near each other
// without touching: the nearest of these.
struct Crack {
  std::array<std::uint32_t, 2> triangles{};
  Vertex near{};        // mm: an end of one of them
  double distance = 0;  // mm
};

// The edges of one triangle, and those of them that are nearer to each other than a length; two with a common end where their
// other ends are. A crack is as wide as its distance, and a hand can pass.
struct Borders {
  std::uint64_t edges = 0;
  double length = 0;  // mm, of all
  std::vector<Crack> cracks;
};

// Each decided exactly. nearer_than: mm, 0 for none, or 2^-30 at least.
Borders borders_of(TriangleMesh mesh, float nearer_than = 0);

// The vertex with the most triangles, the first of several.
struct LargestFan {
  std::uint32_t vertex = 0;
  std::uint64_t triangles = 0;
};
LargestFan largest_fan(const TriangleMesh& mesh);
// The most triangles at a vertex with which a move of a tick from there takes no longer than some 0.1 ms (docs/speed.md,
// "Vertices of many triangles").
inline constexpr std::uint64_t kLargestQuickFan = 1000;

// The number of components that binary64 decided, and of those that it left to intervals of more bits.
struct NormalStages {
  std::uint64_t binary64 = 0, intervals = 0;
};

struct ComputedNormals {
  CornerNormals normals;
  NormalStages stages;
};

// At each corner the unit mean of the unit normals of the triangles around its vertex, weighted by their angles there: of those
// that are joined to the corner's own triangle over edges at the vertex that do not separate. An edge separates if its
// triangles turn by more than the crease angle, 0 to 180 degrees; at 180 none does. Each component is the binary32 number
// nearest to the exact one; zeros are +0. Where the mean is 0 and so has no direction, the normal is (0, 0, 0), which shades
// nothing. On a mesh that is not regular every edge separates but those of two triangles in opposite directions, with vertices
// and triangles counted as usual_sides() does. Throws std::invalid_argument where the angle is out of its range.
ComputedNormals corner_normals(const CheckedMesh& mesh, double crease_degrees = 180);

struct Repaired {
  // A vertex that was moved onto another, both by their numbers at first; vertices of equal coordinates count as the first.
  struct Moved {
    std::uint32_t vertex = 0, onto = 0;
    double distance = 0;  // mm
  };
  // A face that was split at a vertex beside one of its edges, by their numbers at first.
  struct Split {
    std::uint32_t triangle = 0, vertex = 0;
    double distance = 0;  // mm
  };

  TriangleMesh mesh;
  std::vector<std::string> done;  // one sentence each; empty if nothing was
  std::vector<Moved> moved;
  std::vector<Split> split;
};

// Repairs the mesh in this order: coordinates below 2^-30 mm in size are 0; vertices with equal coordinates are one, in the
// order in which they first come; faces go that have an index of no vertex, a coordinate that is no number within 10000 mm, a
// vertex twice or no area, and all but the first of several with the same vertices; faces are turned over until all that are
// joined over edges with two faces run along these in opposite directions, in each part as few as possible (where both ways
// turn as many, its first face stays), unless it cannot be done. Faces that are kept stay in their order. Nothing is moved,
// filled or cut: what is still no mesh then (include/forceshade/meshes.h) is not repaired.
//
// join: mm, 2^-30 at least. Then, before faces with the same vertices go, each end of an edge with one face is moved onto the
// nearest other that was not moved and has a lower number, the lowest of equally near ones, if that is within this length,
// decided exactly. Nothing else moves. Where such an end is then beside the inside of such an edge of another face and within
// the length of it, that face is split there; its parts follow each other. Throws std::invalid_argument with the reason where
// a face or a part of it would lose its area or turn by a right angle or more.
Repaired repair(TriangleMesh mesh, std::optional<float> join = {});

}  // namespace forceshade::mesh
