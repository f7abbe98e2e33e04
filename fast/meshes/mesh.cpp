// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/meshes/mesh.h"

#include <algorithm>
#include <cmath>

#include "forceshade/fast/domain.h"
#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/meshes/decide.h"
#include "forceshade/fast/meshes/session.h"
#include "forceshade/fast/numbers/arithmetic.h"
#include "forceshade/vocabulary/law.h"

namespace forceshade::fast {
namespace {

// The ten lower bits spread, with two free bits after each.
std::uint32_t spread(std::uint32_t bits) noexcept {
  bits = (bits | bits << 16) & 0x030000FFU;
  bits = (bits | bits << 8) & 0x0300F00FU;
  bits = (bits | bits << 4) & 0x030C30C3U;
  return (bits | bits << 2) & 0x09249249U;
}

// The triangles along a Z-curve through the middles of their boxes.
std::vector<std::uint32_t> curve_order(const mesh::TriangleMesh& mesh) {
  std::array<float, 3> low, high;
  low.fill(HUGE_VALF);
  high.fill(-HUGE_VALF);
  for (const mesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], mesh.vertices[v][i]);
        high[i] = std::max(high[i], mesh.vertices[v][i]);
      }
  const float side = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const float scale = side > 0 ? 1023 / (3 * side) : 0;
  struct Keyed {
    std::uint32_t key, triangle;
  };
  std::vector<Keyed> keyed(mesh.triangles.size()), other(keyed.size());
  for (std::size_t t = 0; t < keyed.size(); ++t) {
    std::uint32_t key = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      float sum = 0;
      for (const std::uint32_t v : mesh.triangles[t]) sum += mesh.vertices[v][i] - low[i];
      key |= spread(std::min(static_cast<std::uint32_t>(sum * scale), 1023U)) << i;
    }
    keyed[t] = {key, static_cast<std::uint32_t>(t)};
  }
  for (unsigned shift = 0; shift < 30; shift += 10) {
    std::array<std::size_t, 1025> start{};
    for (const Keyed& k : keyed) ++start[(k.key >> shift & 1023U) + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    for (const Keyed& k : keyed) other[start[k.key >> shift & 1023U]++] = k;
    keyed.swap(other);
  }
  std::vector<std::uint32_t> order(keyed.size());
  std::ranges::transform(keyed, order.begin(), [](const Keyed& k) { return k.triangle; });
  return order;
}

std::string face_text(std::uint32_t index) {
  return "triangle " + std::to_string(index);
}

std::string first_error(const mesh::TriangleMesh& mesh, const mesh::CornerNormals& normals) {
  if (mesh.triangles.empty()) return "the mesh has no triangle";
  if (mesh.triangles.size() > Mesh::kMostTriangles)
    return "the mesh has " + std::to_string(mesh.triangles.size()) + " triangles; expected " +
           std::to_string(Mesh::kMostTriangles) + " at most";
  if (!normals.empty() && normals.size() != mesh.triangles.size())
    return "expected the normals of as many triangles as the mesh has";
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.vertices.size()) return face_text(t) + " names vertex " + std::to_string(v) + ", which is not there";
      for (const float coordinate : mesh.vertices[v])
        if (!in_domain(coordinate)) return "vertex " + std::to_string(v) + " is outside the domain";
    }
  for (std::uint32_t t = 0; t < normals.size(); ++t)
    for (const mesh::Normal& normal : normals[t])
      for (const float component : normal)
        if (!std::isfinite(component)) return face_text(t) + " has a normal that is not finite";
  return {};
}

// Of the corners of a texture: points within the domain, gradients of 0 or from 2^-30 to 1000 mm/mm.
std::string first_error(const mesh::CornerTextures& corners, std::size_t triangles, bool has_normals) {
  constexpr float kSteepest = 1000;
  if (corners.size() != triangles) return "expected the points of the texture of as many triangles as the mesh has";
  if (!has_normals) return "a texture needs corner normals";
  for (std::uint32_t t = 0; t < corners.size(); ++t)
    for (const mesh::CornerTexture& corner : corners[t]) {
      if (!in_domain(corner.point[0]) || !in_domain(corner.point[1]))
        return face_text(t) + " has a point of the texture outside the domain";
      for (const mesh::Normal& gradient : {corner.gradient_x, corner.gradient_y})
        for (const float component : gradient) {
          const float size = std::fabs(component);
          if (!(size == 0 || (size >= kPositionQuantum && size <= kSteepest)))
            return face_text(t) + " has a gradient of its texture outside 2^-30 to 1000 mm/mm";
        }
    }
  return {};
}

}  // namespace

std::variant<Mesh, std::string> Mesh::build(const mesh::TriangleMesh& triangles, const mesh::CornerNormals& normals,
                                            mesh::Sides sides, const mesh::Texture& texture,
                                            mesh::SelfIntersections self_intersections) {
  for (const char* fault : {arithmetic_fault_here(), force_arithmetic_fault(), MeshSession::arithmetic_fault()})
    if (fault != nullptr) return ParameterError{"arithmetic", "", 0, 0, 0, fault}.message();
  if (std::string error = first_error(triangles, normals); !error.empty()) return error;
  Mesh result;
  if (!texture.corners.empty()) {
    if (std::string error = first_error(texture.corners, triangles.triangles.size(), !normals.empty()); !error.empty())
      return error;
    auto map = HeightMapField::build({texture.map.parts}, height::Rendering::force_shaded, 1);
    if (const auto* error = std::get_if<ParameterError>(&map)) return "the texture's height map: " + error->message();
    result.texture_map_ = std::make_shared<const HeightMapField>(std::get<HeightMapField>(std::move(map)));
  }
  result.sides_ = sides;
  result.has_sheets_ = self_intersections == mesh::SelfIntersections::allowed;
  const std::vector<std::uint32_t> order = curve_order(triangles);
  result.faces_.resize(order.size());
  result.face_of_file_.resize(order.size());
  for (std::uint32_t f = 0; f < order.size(); ++f) {
    Face& face = result.faces_[f];
    result.face_of_file_[order[f]] = f;
    face.vertex = triangles.triangles[order[f]];
    face.twin.fill(kRim);
    face.index_and_edge_angles = order[f] << Face::kBendBits;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        face.corner[i][axis] = quantised(triangles.vertices[face.vertex[i]][axis]);
        result.largest_coordinate_ = std::max(result.largest_coordinate_, std::fabs(face.corner[i][axis]));
      }
  }
  result.first_around_.assign(triangles.vertices.size(), kRim);
  if (std::string error = result.join(); !error.empty()) return error;
  result.find_bends();
  if (!normals.empty()) {
    result.normals_.reserve(order.size());
    for (const std::uint32_t t : order) result.normals_.push_back(normals[t]);
  }
  if (!texture.corners.empty()) {
    result.textures_.reserve(order.size());
    for (const std::uint32_t t : order) result.textures_.push_back(texture.corners[t]);
  }
  result.tree_ = BoxTree(result.faces_);
  return result;
}

// Finds each half-edge's other half among those that start at its end.
std::string Mesh::join() {
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
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    return "the edge of vertices " + std::to_string(a) + " and " + std::to_string(b);
  };
  // Both an edge's other half and a second triangle in the same direction are found among the half-edges from either end: from
  // the end that has fewer.
  const auto count = [&](std::uint32_t v) { return start[v + std::size_t{1}] - start[v]; };
  const auto number = [&](HalfEdge h) { return vertex[face_of(h)][corner_of(h)]; };
  for (HalfEdge h = 0; h < 3 * faces(); ++h) {
    const std::uint32_t a = number(h), b = number(next(h));
    if (a == b) return face_text(faces_[face_of(h)].index()) + " has a vertex twice";
    const bool is_from_start = count(a) <= count(b);
    const std::uint32_t hub = is_from_start ? a : b, other = is_from_start ? b : a;
    for (std::uint32_t j = start[hub]; j < start[hub + std::size_t{1}]; ++j)
      for (const HalfEdge found : {from[j], previous(from[j])}) {
        if (found == h || number(found == from[j] ? next(found) : found) != other) continue;
        if (number(found) == a)
          return between(this->start(h), this->start(next(h))) +
                 " has two triangles in the same direction: " + face_text(faces_[face_of(h)].index()) + " and " +
                 face_text(faces_[face_of(found)].index());
        faces_[face_of(h)].twin[corner_of(h)] = found;
      }
  }
  // The half-edge that a fan starts from: at the rim the one whose other half is missing.
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (std::uint32_t i = 0; i < 3; ++i) {
      HalfEdge& first = first_around_[faces_[f].vertex[i]];
      if (first == kRim || (faces_[f].twin[i] == kRim && twin(first) != kRim)) first = 3 * f + i;
    }
  // One fan for each vertex: around() from the first half-edge reaches all of them.
  for (std::size_t file = 0; file < first_around_.size(); ++file) {
    if (first_around_[file] == kRim) continue;
    const std::uint32_t all = start[local[file] + std::size_t{1}] - start[local[file]];
    std::uint32_t reached = 0;
    HalfEdge h = first_around_[file];
    do {
      ++reached;
      h = around(h);
    } while (h != kRim && h != first_around_[file] && reached <= all);
    if (reached != all) return "the triangles around vertex " + std::to_string(file) + " do not form one fan";
  }
  return {};
}

// n1·(d - a) and n2·(c - a) have the same sign: both are the volume of the tetrahedron of the two triangles.
void Mesh::find_bends() {
  for (HalfEdge h = 0; h < 3 * faces(); ++h) {
    Face& face = faces_[face_of(h)];
    const HalfEdge other = twin(h);
    if (other == kRim || other < h) continue;
    const int sign = side_of(face, start_point(previous(other)), FilteredStages());
    const auto angle = static_cast<std::uint32_t>(sign > 0 ? EdgeAngle::narrow : sign == 0 ? EdgeAngle::flat : EdgeAngle::wide);
    face.index_and_edge_angles |= angle << (2 * corner_of(h));
    faces_[face_of(other)].index_and_edge_angles |= angle << (2 * corner_of(other));
  }
}

std::size_t Mesh::bytes() const noexcept {
  return faces_.capacity() * sizeof(Face) + first_around_.capacity() * sizeof(HalfEdge) +
         face_of_file_.capacity() * sizeof(std::uint32_t) + normals_.capacity() * sizeof(normals_[0]) +
         textures_.capacity() * sizeof(textures_[0]) + tree_.bytes();
}

}  // namespace forceshade::fast
