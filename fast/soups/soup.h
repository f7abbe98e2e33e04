// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any finite set of triangles as the real-time path reads it (docs/soups.md).

#include <cstdint>
#include <span>
#include <vector>

#include "fast/meshes/box_tree.h"
#include "fast/meshes/mesh.h"
#include "forceshade/mesh.h"

namespace forceshade::fast::soups {

// Immutable once it is built, safe to share between threads.
class Soup {
 public:
  // Triangles without area are left out. sides: one for all, or one for each triangle. materials and normals: one for each
  // triangle, or none. Coordinates are within 10^4 mm.
  Soup(const mesh::TriangleMesh& mesh, const std::vector<mesh::Sides>& sides, const std::vector<mesh::Material>& materials = {},
       const mesh::CornerNormals& normals = {});

  // Its vertices are named by the lowest index with the same coordinates that a triangle uses.
  const Faces& faces() const noexcept { return faces_; }
  const BoxTree& tree() const noexcept { return tree_; }
  std::size_t bytes() const noexcept;  // of memory that it holds
  // Null where there is none with an area.
  const Face* numbered(std::uint32_t number) const noexcept {
    return number < face_of_file_.size() && face_of_file_[number] != kNoFace ? &faces_[face_of_file_[number]] : nullptr;
  }
  // Null for a number that is no name of a vertex.
  const float* vertex(std::uint32_t name) const noexcept {
    return name < is_name_.size() && is_name_[name] ? vertices_[name].data() : nullptr;
  }
  bool blocks_along(const Face& f) const noexcept { return properties_[of(f)].blocks_along; }
  float static_friction(const Face& f) const noexcept { return properties_[of(f)].static_friction; }
  float dynamic_friction(const Face& f) const noexcept { return properties_[of(f)].dynamic_friction; }
  bool has_friction() const noexcept { return has_friction_; }
  // N/mm, of the triangle's material or the usual one.
  float stiffness(const Face& f, float usual) const noexcept { return properties_[of(f)].stiffness.value_or(usual); }
  bool has_damping() const noexcept { return has_damping_; }
  damping::Limits damping(const Face& f) const noexcept { return properties_[of(f)].damping; }
  // One for each corner; null without normals.
  const std::array<mesh::Normal, 3>* normals(const Face& f) const noexcept {
    return normals_.empty() ? nullptr : &normals_[of(f)];
  }

 private:
  static constexpr std::uint32_t kNoFace = ~std::uint32_t{0};
  struct Properties {
    bool blocks_along = false;
    float static_friction = 0, dynamic_friction = 0;
    std::optional<float> stiffness = {};
    damping::Limits damping = {};
  };
  std::size_t of(const Face& f) const noexcept { return static_cast<std::size_t>(&f - faces_.data()); }

  std::vector<mesh::Vertex> vertices_;
  std::vector<bool> is_name_;
  Faces faces_;
  std::vector<std::uint32_t> face_of_file_;
  std::vector<Properties> properties_;
  mesh::CornerNormals normals_;
  bool has_friction_ = false, has_damping_ = false;
  BoxTree tree_;
};

}  // namespace forceshade::fast::soups
