// SPDX-License-Identifier: BSD-3-Clause
#include "fast/meshes/mesh.h"

#include <algorithm>
#include <cmath>

#include "fast/domain.h"
#include "fast/meshes/curve_order.h"
#include "fast/meshes/decide.h"
#include "fast/meshes/session.h"
#include "fast/numbers/arithmetic.h"
#include "forceshade/fast.h"
#include "forceshade/law.h"

namespace forceshade::fast {

std::variant<Mesh, ParameterError> Mesh::build(const MeshRendering& rendering) {
  for (const char* fault : {arithmetic_fault_here(), force_arithmetic_fault(), MeshSession::arithmetic_fault()})
    if (fault != nullptr) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (const auto error = first_error(rendering)) return *error;
  const mesh::TriangleMesh& triangles = rendering.mesh();
  if (triangles.triangles.size() > kMostTriangles)
    return ParameterError{"number of triangles", "", static_cast<float>(triangles.triangles.size()), 1, kMostTriangles};
  Mesh result;
  const bool is_textured = rendering.shading == mesh::Shading::texture_scheme;
  if (is_textured) {
    auto map = HeightMapField::build({rendering.texture.map.parts}, height::Mode::force_shaded, 1);
    if (const auto* error = std::get_if<ParameterError>(&map)) return *error;
    result.texture_map_ = std::make_shared<const HeightMapField>(std::get<HeightMapField>(std::move(map)));
  }
  result.sides_ = rendering.sides;
  const std::vector<std::uint32_t> order = curve_order(triangles);
  result.faces_.resize(order.size());
  result.face_of_file_.resize(order.size());
  for (std::uint32_t f = 0; f < order.size(); ++f) {
    Face& face = result.faces_[f];
    result.face_of_file_[order[f]] = f;
    face.vertex = triangles.triangles[order[f]];
    face.twin.fill(kRim);
    face.index_and_folds = order[f] << Face::kBendBits;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        face.corner[i][axis] = quantised(triangles.vertices[face.vertex[i]][axis]);
        result.largest_coordinate_ = std::max(result.largest_coordinate_, std::fabs(face.corner[i][axis]));
      }
  }
  result.first_around_.assign(triangles.vertices.size(), kRim);
  result.join();
  result.find_folds();
  const auto in_order = [&](auto& into, const auto& from) {
    into.reserve(order.size());
    for (const std::uint32_t t : order) into.push_back(from[t]);
  };
  if (rendering.has_corner_normals()) in_order(result.normals_, rendering.normals);
  if (is_textured) in_order(result.textures_, rendering.texture.corners);
  result.materials_ = rendering.materials.list;
  if (!rendering.materials.of_triangle.empty()) in_order(result.material_of_face_, rendering.materials.of_triangle);
  result.has_friction_ = forceshade::has_friction(rendering.materials);
  result.has_stiffness_ = has_own_stiffness(rendering.materials);
  result.has_damping_ = has_own_damping(rendering.materials);
  result.tree_ = BoxTree(result.faces_);
  return result;
}

// Finds each half-edge's other half among those that start at its end.
void Mesh::join() {
  // Vertices are numbered by their first face, so that those of neighbouring faces lie together.
  std::vector<std::uint32_t> local(first_around_.size(), ~0U), ends;
  std::uint32_t used = 0;
  std::vector<std::array<std::uint32_t, 3>> vertex(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& number = local[faces_[f].vertex[i]];
      if (number == ~0U) number = used++;
      vertex[f][i] = number;
    }
  std::vector<std::uint32_t> start(used + std::size_t{1}, 0);
  for (const auto& v : vertex)
    for (const std::uint32_t number : v) ++start[number + std::size_t{1}];
  for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  std::vector<HalfEdge> from(3 * faces_.size());
  std::vector<std::uint32_t> filled(start.begin(), start.end() - 1);
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (std::uint32_t i = 0; i < 3; ++i) from[filled[vertex[f][i]]++] = 3 * f + i;
  // An edge's other half is found among the half-edges from either end: from the end that has fewer.
  const auto count = [&](std::uint32_t v) { return start[v + std::size_t{1}] - start[v]; };
  const auto number = [&](HalfEdge h) { return vertex[face_of(h)][corner_of(h)]; };
  for (HalfEdge h = 0; h < 3 * faces(); ++h) {
    const std::uint32_t a = number(h), b = number(next(h));
    const bool is_from_start = count(a) <= count(b);
    const std::uint32_t hub = is_from_start ? a : b, other = is_from_start ? b : a;
    for (std::uint32_t j = start[hub]; j < start[hub + std::size_t{1}]; ++j)
      for (const HalfEdge found : {from[j], previous(from[j])})
        if (found != h && number(found == from[j] ? next(found) : found) == other)
          faces_[face_of(h)].twin[corner_of(h)] = found;
  }
  // The half-edge that a fan starts from: at the rim the one whose other half is missing.
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (std::uint32_t i = 0; i < 3; ++i) {
      HalfEdge& first = first_around_[faces_[f].vertex[i]];
      if (first == kRim || (faces_[f].twin[i] == kRim && twin(first) != kRim)) first = 3 * f + i;
    }
}

// n1·(d - a) and n2·(c - a) have the same sign: both are the volume of the tetrahedron of the two triangles.
void Mesh::find_folds() {
  for (HalfEdge h = 0; h < 3 * faces(); ++h) {
    Face& face = faces_[face_of(h)];
    const HalfEdge other = twin(h);
    if (other == kRim || other < h) continue;
    const int sign = side_of(face, start_point(previous(other)), FilteredStages());
    const auto angle = static_cast<std::uint32_t>(sign > 0 ? Fold::narrow : sign == 0 ? Fold::flat : Fold::wide);
    face.index_and_folds |= angle << (2 * corner_of(h));
    faces_[face_of(other)].index_and_folds |= angle << (2 * corner_of(other));
  }
}

std::size_t Mesh::bytes() const noexcept {
  return faces_.capacity() * sizeof(Face) + first_around_.capacity() * sizeof(HalfEdge) +
         face_of_file_.capacity() * sizeof(std::uint32_t) + normals_.capacity() * sizeof(normals_[0]) +
         textures_.capacity() * sizeof(textures_[0]) + materials_.capacity() * sizeof(mesh::Material) +
         material_of_face_.capacity() * sizeof(std::uint32_t) + tree_.bytes();
}

}  // namespace forceshade::fast
