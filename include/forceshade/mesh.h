// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A triangle mesh and the god-object on it: numbers only. Their meaning, and the demands on a mesh: docs/god-object.md.
//
//   mesh::TriangleMesh tetrahedron{{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
//   const mesh::GodObject nowhere;  // the state at the beginning of a path
//   const bool is_new = nowhere.place == mesh::Place::nowhere;
//
// Lengths are in mm, forces in N, the stiffness in N/mm. A mesh is checked once, by mesh::check() or mesh::check_any() of
// meshes.h, and only what they give can be rendered: fast::GodObject of fast.h does it, reference::GodObject of reference.h
// defines it. All of these are values, which threads may share while none changes them. Nothing here allocates but the vectors'
// copies, or throws but std::bad_alloc.
//
// Not promised: more enumerators or members may come in a new version (docs/versions.md).
//
// Source: Zilles and Salisbury (1995) for the god-object; Morgenbesser and Srinivasan, RLE Technical Report 606 (MIT, 1996) for
// the shading.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "forceshade/damping.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"

namespace forceshade {
class Monitor;
}  // namespace forceshade

namespace forceshade::mesh {

using Vertex = std::array<float, 3>;            // mm
using Triangle = std::array<std::uint32_t, 3>;  // indices of vertices; the normal (b - a) x (c - a) points to the front
using Normal = std::array<float, 3>;            // about a unit vector: each component is rounded to binary32

// Triangles and vertices keep the order of their file: the god-object's state names them by their index, from 0.
struct TriangleMesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
};

// One normal for each corner of each triangle, in the order of the triangle's vertices (the vertex scheme).
using CornerNormals = std::vector<std::array<Normal, 3>>;

// A corner of a triangle on a height map that is laid over the mesh (the texture scheme).
struct CornerTexture {
  std::array<float, 2> point{};       // (x, y) on the map, mm
  Normal gradient_x{}, gradient_y{};  // mm/mm: how fast, and in which direction along the surface, x and y grow

  bool operator==(const CornerTexture&) const = default;
};
using CornerTextures = std::vector<std::array<CornerTexture, 3>>;

// The texture at each corner of each triangle. Without corners there is no texture.
struct Texture {
  CornerTextures corners;
  HeightMap map;  // `surface` is not used: the depth is that of the mesh
};

// The surface of a triangle as a hand feels it: Coulomb friction and stiffness (docs/friction.md), and how much of a path's
// damping acts on it (docs/damping.md).
struct Material {
  std::optional<float> stiffness = {};  // N/mm, in [10^-3, 10^3]; nothing: that of the rendering
  float static_friction = 0;            // 0, infinity, or 2^-10 to 2^10; at least the dynamic one
  float dynamic_friction = 0;           // the same
  damping::Limits damping = {};

  bool operator==(const Material&) const = default;
};

// The material of each triangle. Without a list, all have the rendering's stiffness and no friction.
struct Materials {
  std::vector<Material> list;
  std::vector<std::uint32_t> of_triangle;  // indices into the list; empty: all triangles have the first of it

  bool operator==(const Materials&) const = default;
};

// The directions in which a triangle blocks motion: against its normal, or against and along it.
enum class Sides { front, both };

// The result of a check, instead of the mesh: include/forceshade/meshes.h.
struct Findings;

// A mesh whose triangles are joined as docs/meshes.md demands. They may also meet beside their common vertices.
// Only mesh::check_joints() makes it.
class JoinedMesh {
 public:
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  friend std::variant<JoinedMesh, Findings> check_joints(TriangleMesh mesh);
  explicit JoinedMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {}

  TriangleMesh mesh_;
};

// A mesh that can be rendered. Only mesh::check() and mesh::check_any() make it.
class CheckedMesh {
 public:
  const TriangleMesh& mesh() const { return mesh_; }
  // True of what mesh::check() gives, whose triangles are joined. Otherwise it is any set of triangles, of which some may have
  // no area, and docs/soups.md defines the god-object on it.
  bool is_regular() const { return is_regular_; }

 private:
  friend std::variant<CheckedMesh, Findings> check(TriangleMesh mesh, const Monitor& monitor);
  friend std::variant<CheckedMesh, Findings> check_any(TriangleMesh mesh, const Monitor& monitor);
  CheckedMesh(TriangleMesh mesh, bool is_regular) : mesh_(std::move(mesh)), is_regular_(is_regular) {}

  TriangleMesh mesh_;
  bool is_regular_;
};

// The one list of the shading schemes. vertex_scheme uses corner normals; texture_scheme these and a texture.
enum class Shading { none, vertex_scheme, edge_scheme, texture_scheme };

inline constexpr std::array<std::string_view, 2> kSidesNames{"front", "both"};
inline constexpr std::array<std::string_view, 4> kShadingNames{"none", "vertex", "edge", "texture"};

constexpr std::string_view name_of(Sides sides) {
  return kSidesNames[static_cast<std::size_t>(sides)];
}
constexpr std::string_view name_of(Shading shading) {
  return kShadingNames[static_cast<std::size_t>(shading)];
}

constexpr bool has_corner_normals(Shading shading) {
  return shading == Shading::vertex_scheme || shading == Shading::texture_scheme;
}

// The one list of the contact rules: which point the god-object goes for in a tick, and whether friction may stop it before.
// sub_goal uses corner normals. friction goes for the position and uses the coefficients of the materials.
enum class Contact { direct, sub_goal, friction };

inline constexpr std::array<std::string_view, 3> kContactNames{"direct", "sub-goal", "friction"};
inline constexpr Contact kUsualContact = {};  // the default

constexpr std::string_view name_of(Contact contact) {
  return kContactNames[static_cast<std::size_t>(contact)];
}
constexpr bool has_corner_normals(Contact contact) {
  return contact == Contact::sub_goal;
}

// The place of the god-object. `nowhere`: no valid position has come yet.
enum class Place : std::uint8_t { nowhere, free, vertex, edge, triangle };
enum class Side : std::uint8_t { front, back };

inline constexpr std::array<std::string_view, 5> kPlaceNames{"nowhere", "free", "vertex", "edge", "triangle"};
inline constexpr std::array<std::string_view, 2> kSideNames{"front", "back"};

// A place on a mesh that is not regular which lies in several features, or is the foot of a position, with a parameter that is
// no multiple of 2^-24 (docs/soups.md). `place` and `index` are then the first feature that it names. none: `place` says all.
enum class Meeting : std::uint8_t {
  none,
  line,
  edges,
  edge_and_triangle,
  triangles,
  foot_on_triangle,
  foot_on_edge,
  foot_on_line
};

// The whole memory of a god-object: exact, of constant size, the same on every machine. What a place does not use is 0.
struct GodObject {
  Place place = Place::nowhere;
  Side side = Side::front;               // of the surface; front where it is free
  bool is_slipping = false;              // with friction: it slipped, and has not come to hold since
  std::array<float, 3> position{};       // free: mm, as quantised; a foot: of the hand whose foot it is
  std::array<std::uint32_t, 2> index{};  // vertex v: {v}; edge: {a, b}, a < b; triangle i: {i}; several of them: {i, j}
  std::array<std::uint32_t, 2>
      parameter{};  // in units of 2^-24. Edge: a + m (b - a): {m}. Triangle: a + k (b - a) + l (c - a): {k, l}. Line: {k}

  // On a mesh that is not regular.
  Meeting meeting = Meeting::none;
  std::array<std::uint32_t, 2> further{};  // edges: of the second one; triangles, edge and triangle: the last one; line: corner
  std::array<std::uint32_t, 2> cell{};     // the name of the cell, which `side` belongs to: triangle, number of its piece

  bool operator==(const GodObject&) const = default;
};

// The names of a tick's Status.
inline constexpr std::array<std::string_view, 4> kTickStatusNames{"free", "touching", "invalid", "unfinished"};

// The result of one position.
struct Tick {
  Status status = Status::invalid;
  std::uint16_t moves = 0;       // flights and slides; a refused one is not counted
  std::array<float, 3> force{};  // N, each component the binary32 nearest to the exact one; zeros are +0
  GodObject after;               // the state that the next tick starts from
  damping::Limits damping = {};  // of where the force is from
};

}  // namespace forceshade::mesh

namespace forceshade {

// The parts that a god-object on a mesh is built from.
struct MeshRendering {
  mesh::CheckedMesh checked;
  mesh::CornerNormals normals = {};  // one for each corner where the shading or the contact rule uses them
  mesh::Sides sides = mesh::Sides::front;
  mesh::Shading shading = mesh::Shading::none;
  float stiffness = 0;         // K, N/mm, in [10^-3, 10^3]
  mesh::Texture texture = {};  // of the texture scheme
  mesh::Contact contact = mesh::kUsualContact;
  mesh::Materials materials = {};

  const mesh::TriangleMesh& mesh() const { return checked.mesh(); }
  bool has_corner_normals() const { return mesh::has_corner_normals(shading) || mesh::has_corner_normals(contact); }
};

}  // namespace forceshade
