// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A triangle mesh as the real-time path reads it: one cache line for each triangle, in an order in which neighbours are near
// each other, and a tree of boxes over runs of them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "fast/meshes/box_tree.h"
#include "fast/meshes/large_pages.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::fast {

class HeightMapField;

// The angle of two triangles along an edge, seen from in front: n1·(d - a) is > 0, 0 or < 0 (docs/god-object.md).
enum class Fold : std::uint32_t { narrow, flat, wide };

// A half-edge is 3·face + i: the edge from corner i of the face to corner i + 1. Faces are numbered as they lie in memory.
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge kRim = ~HalfEdge{0};  // the other half of an edge at the rim

struct alignas(64) Face {
  std::array<std::array<float, 3>, 3> corner;  // mm
  std::array<std::uint32_t, 3> vertex;         // of the file
  std::array<HalfEdge, 3> twin;                // the other half of edge i, or kRim
  std::uint32_t index_and_folds;               // of the file, above two bits for each edge

  static constexpr unsigned kBendBits = 6;
  std::uint32_t index() const noexcept { return index_and_folds >> kBendBits; }
  Fold fold(std::uint32_t i) const noexcept { return static_cast<Fold>(index_and_folds >> (2 * i) & 3U); }
};
static_assert(sizeof(Face) == 64);
using Faces = std::vector<Face, LargePages<Face>>;

inline std::uint32_t face_of(HalfEdge h) noexcept {
  return h / 3;
}
inline std::uint32_t corner_of(HalfEdge h) noexcept {
  return h % 3;
}
inline std::uint32_t after(std::uint32_t corner) noexcept {
  return corner == 2 ? 0 : corner + 1;
}
inline std::uint32_t before(std::uint32_t corner) noexcept {
  return corner == 0 ? 2 : corner - 1;
}
inline HalfEdge next(HalfEdge h) noexcept {
  return 3 * face_of(h) + after(corner_of(h));
}
inline HalfEdge previous(HalfEdge h) noexcept {
  return 3 * face_of(h) + before(corner_of(h));
}

// The coefficients of Coulomb friction in a triangle or along an edge.
struct Coefficients {
  float static_friction = 0, dynamic_friction = 0;

  bool is_rough() const noexcept { return static_friction > 0; }
};

// Immutable once it is built, safe to share between threads.
class Mesh {
 public:
  static constexpr std::size_t kMostTriangles = std::size_t{1} << 26;

  // As GodObject::build() of include/forceshade/fast.h.
  static std::variant<Mesh, ParameterError> build(const MeshRendering& rendering);

  const Face& face(std::uint32_t f) const noexcept { return faces_[f]; }
  std::uint32_t vertices() const noexcept { return static_cast<std::uint32_t>(first_around_.size()); }
  std::uint32_t faces() const noexcept { return static_cast<std::uint32_t>(faces_.size()); }
  const Faces& all_faces() const noexcept { return faces_; }
  // From the vertex; where it is at the rim, the one from which around() reaches every other.
  HalfEdge first_around(std::uint32_t vertex) const noexcept { return first_around_[vertex]; }
  std::uint32_t face_of_file(std::uint32_t triangle) const noexcept { return face_of_file_[triangle]; }
  HalfEdge twin(HalfEdge h) const noexcept { return faces_[face_of(h)].twin[corner_of(h)]; }
  std::uint32_t start(HalfEdge h) const noexcept { return faces_[face_of(h)].vertex[corner_of(h)]; }
  const float* start_point(HalfEdge h) const noexcept { return faces_[face_of(h)].corner[corner_of(h)].data(); }
  // Has what is beyond the half-edge h brought into the cache while other work is done: a slide goes there, in this tick or in
  // a later one. With it come the triangles that share 256 bytes with it, some of which are near it.
  FORCESHADE_INLINE void fetch_beyond(HalfEdge h) const noexcept {
    if (h == kRim) [[unlikely]]
      return;
    // As a number, because the last group may reach beyond the array.
    const auto four = reinterpret_cast<std::uintptr_t>(faces_.data() + (face_of(h) & ~3U));
    for (std::size_t i = 0; i < 4; ++i) __builtin_prefetch(reinterpret_cast<const void*>(four + i * sizeof(Face)));
  }
  FORCESHADE_INLINE void fetch_neighbours(std::uint32_t f) const noexcept {
    for (const HalfEdge other : faces_[f].twin) fetch_beyond(other);
  }
  // The next half-edge from the same vertex, counter-clockwise as seen from in front; kRim after the last one.
  HalfEdge around(HalfEdge h) const noexcept { return twin(previous(h)); }
  bool is_at_rim(std::uint32_t vertex) const noexcept { return twin(first_around_[vertex]) == kRim; }

  mesh::Sides sides() const noexcept { return sides_; }
  const BoxTree& tree() const noexcept { return tree_; }
  float largest_coordinate() const noexcept { return largest_coordinate_; }
  bool has_friction() const noexcept { return has_friction_; }
  FORCESHADE_INLINE Coefficients friction_in_triangle(std::uint32_t f) const noexcept {
    const mesh::Material& material = material_of(f);
    return {material.static_friction, material.dynamic_friction};
  }
  // The larger ones of the edge's triangles.
  Coefficients friction_on_edge(HalfEdge h) const noexcept {
    const Coefficients a = friction_in_triangle(face_of(h));
    if (twin(h) == kRim) return a;
    const Coefficients b = friction_in_triangle(face_of(twin(h)));
    return {std::max(a.static_friction, b.static_friction), std::max(a.dynamic_friction, b.dynamic_friction)};
  }
  // True if materials have a stiffness of their own; then that of a face, if its material does. N/mm.
  bool has_stiffness() const noexcept { return has_stiffness_; }
  std::optional<float> stiffness_in_triangle(std::uint32_t f) const noexcept { return material_of(f).stiffness; }
  // True if materials limit a path's damping; then how a face's does.
  bool has_damping() const noexcept { return has_damping_; }
  damping::Limits damping_in_triangle(std::uint32_t f) const noexcept { return material_of(f).damping; }
  // The normals of the three corners of face f; empty where the mesh has none.
  const std::array<mesh::Normal, 3>* normals(std::uint32_t f) const noexcept {
    return normals_.empty() ? nullptr : &normals_[f];
  }
  // The height map that is laid over the mesh, and where the corners of face f are on it; null where the mesh has none.
  const HeightMapField* texture_map() const noexcept { return texture_map_.get(); }
  const std::array<mesh::CornerTexture, 3>* texture(std::uint32_t f) const noexcept {
    return textures_.empty() ? nullptr : &textures_[f];
  }
  // The size of everything that it holds but the height map, which is shared.
  std::size_t bytes() const noexcept;

 private:
  // The face's material, on a mesh that has materials.
  FORCESHADE_INLINE const mesh::Material& material_of(std::uint32_t f) const noexcept {
    return materials_[material_of_face_.empty() ? 0 : material_of_face_[f]];
  }
  void join();
  void find_folds();

  Faces faces_;
  std::vector<HalfEdge> first_around_;       // by vertex of the file
  std::vector<std::uint32_t> face_of_file_;  // by triangle of the file
  std::vector<std::array<mesh::Normal, 3>> normals_;
  mesh::CornerTextures textures_;
  std::shared_ptr<const HeightMapField> texture_map_;
  BoxTree tree_;
  mesh::Sides sides_ = mesh::Sides::front;
  bool has_friction_ = false, has_stiffness_ = false, has_damping_ = false;
  std::vector<mesh::Material> materials_;
  std::vector<std::uint32_t> material_of_face_;
  float largest_coordinate_ = 0;
};

}  // namespace forceshade::fast
