// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/soup.h"

#include <algorithm>
#include <numeric>

#include "fast/domain.h"
#include "fast/meshes/curve_order.h"
#include "fast/soups/points.h"

namespace forceshade::fast::soups {
namespace {

// The lowest index of a used vertex with the same coordinates, for each that is used.
std::vector<std::uint32_t> names_of(const std::vector<mesh::Vertex>& vertices, const std::vector<bool>& is_used) {
  std::vector<std::uint32_t> order(vertices.size()), names(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::erase_if(order, [&](std::uint32_t v) { return !is_used[v]; });
  std::ranges::sort(
      order, [&](std::uint32_t a, std::uint32_t b) { return vertices[a] != vertices[b] ? vertices[a] < vertices[b] : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i)
    names[order[i]] = i > 0 && vertices[order[i]] == vertices[order[i - 1]] ? names[order[i - 1]] : order[i];
  return names;
}

bool has_area(const Face& f) {
  const Vector3<Ball> about = normal<Ball>(f);
  if (about.x.is_sure() || about.y.is_sure() || about.z.is_sure()) return true;
  const Vector3<Whole> exact = normal<Whole>(f);
  return !(exact.x.is_zero() && exact.y.is_zero() && exact.z.is_zero());
}

}  // namespace

Soup::Soup(const mesh::TriangleMesh& mesh, const std::vector<mesh::Sides>& sides, const std::vector<mesh::Material>& materials,
           const mesh::CornerNormals& normals) {
  vertices_.reserve(mesh.vertices.size());
  faces_.reserve(mesh.triangles.size());
  properties_.reserve(mesh.triangles.size());
  if (!normals.empty()) normals_.reserve(mesh.triangles.size());
  for (const mesh::Vertex& vertex : mesh.vertices) vertices_.push_back(quantised(vertex));
  std::vector<bool> is_used(vertices_.size());
  for (const mesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  const std::vector<std::uint32_t> names = names_of(vertices_, is_used);
  is_name_.resize(vertices_.size());
  face_of_file_.assign(mesh.triangles.size(), kNoFace);
  for (const std::uint32_t t : curve_order(mesh)) {
    Face face{};
    for (std::size_t i = 0; i < 3; ++i) {
      face.vertex[i] = names[mesh.triangles[t][i]];
      face.corner[i] = vertices_[face.vertex[i]];
    }
    face.twin.fill(kRim);
    face.index_and_folds = t << Face::kBendBits;
    if (!has_area(face)) continue;
    for (const std::uint32_t name : face.vertex) is_name_[name] = true;
    face_of_file_[t] = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back(face);
    Properties its{(sides.size() == 1 ? sides.front() : sides[t]) == mesh::Sides::both};
    if (!materials.empty()) {
      its.static_friction = materials[t].static_friction;
      its.dynamic_friction = materials[t].dynamic_friction;
      its.stiffness = materials[t].stiffness;
      its.damping = materials[t].damping;
    }
    has_friction_ = has_friction_ || its.static_friction > 0;
    has_damping_ = has_damping_ || its.damping != damping::Limits{};
    properties_.push_back(its);
    if (!normals.empty()) normals_.push_back(normals[t]);
  }
  tree_ = BoxTree(faces_);
}

std::size_t Soup::bytes() const noexcept {
  return sizeof(Soup) + vertices_.capacity() * sizeof(mesh::Vertex) + is_name_.capacity() / 8 +
         faces_.capacity() * sizeof(Face) + face_of_file_.capacity() * sizeof(std::uint32_t) +
         properties_.capacity() * sizeof(Properties) + normals_.capacity() * sizeof(normals_[0]) + tree_.bytes();
}

}  // namespace forceshade::fast::soups
