// SPDX-License-Identifier: BSD-3-Clause
// Normals and texture maps for the corners of a random mesh.
#include <algorithm>
#include <cmath>

#include "properties/mesh_points.h"
#include "properties/mesh_source.h"

namespace forceshade::properties {

mesh::CornerNormals MeshSource::normals_of(const mesh::TriangleMesh& mesh) {
  std::vector<Point> flat, smooth(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point A = wide(mesh.vertices[a]),
                n = cross(difference(wide(mesh.vertices[b]), A), difference(wide(mesh.vertices[c]), A));
    flat.push_back(scaled_to(n, 1));
    for (const std::uint32_t v : {a, b, c})
      for (std::size_t axis = 0; axis < 3; ++axis) smooth[v][axis] += flat.back()[axis];
  }
  const std::uint64_t crease = bits() % 3 == 0 ? 0 : 2 + bits() % 8, stray = bits() % 2 == 0 ? 0 : 16;
  const auto narrow = [&](const Point& normal) {
    const Point unit =
        scaled_to(stray != 0 && bits() % stray == 0 ? Point{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)} : normal, 1);
    return mesh::Normal{static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2])};
  };
  std::vector<mesh::Normal> shared;
  for (const Point& normal : smooth) shared.push_back(narrow(normal));
  mesh::CornerNormals normals;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Normal own = narrow(flat[i]);
    const auto corner = [&](std::size_t k) { return crease != 0 && bits() % crease == 0 ? own : shared[mesh.triangles[i][k]]; };
    const mesh::Normal first = corner(0), second = corner(1), third = corner(2);
    normals.push_back({first, second, third});
  }
  return normals;
}

mesh::Material MeshSource::material() {
  mesh::Material its;
  const int kind = whole(0, 7);
  if (kind == 0) return its;
  its.static_friction = kind == 1   ? HUGE_VALF
                        : kind == 2 ? static_cast<float>(std::exp2(uniform(-10, 10)))
                                    : static_cast<float>(uniform(0.05, 2));
  const int slip = whole(0, 4);
  const auto smaller =
      static_cast<float>(kind == 1 ? uniform(0.05, 2) : uniform(0, 1) * static_cast<double>(its.static_friction));
  its.dynamic_friction = slip == 0 ? its.static_friction : slip == 1 || smaller < 0x1p-10F ? 0 : smaller;
  return its;
}

mesh::Materials MeshSource::materials_of(const mesh::TriangleMesh& mesh) {
  mesh::Materials materials;
  for (int i = whole(1, 6); i > 0; i -= 2) materials.list.push_back(material());
  if (materials.list.size() > 1)
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      materials.of_triangle.push_back(static_cast<std::uint32_t>(bits() % materials.list.size()));
  return materials;
}

mesh::CornerTextures MeshSource::textures_of(const mesh::TriangleMesh& mesh) {
  const auto kept = [](double value, double most) {
    const auto rounded = static_cast<float>(std::clamp(value, -most, most));
    return std::fabs(rounded) < 0x1p-30F ? 0.0F : rounded;
  };
  const double size = size_of(mesh);
  // Along axes every other time, so that coordinates have few bits and the map's edges and kinks are met.
  const bool is_along_axes = bits() % 2 == 0;
  const double per_mm = is_along_axes ? std::exp2(std::round(std::log2(10 / size))) : uniform(1, 20) / size;
  const std::size_t first = bits() % 3;
  const auto direction = [&](std::size_t axis) {
    Point along{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    if (is_along_axes) {
      along = {};
      along[(first + axis) % 3] = 1;
    }
    for (double& component : along) component *= per_mm;
    return along;
  };
  const std::array<Point, 2> along{direction(0), direction(1)};
  const std::uint64_t seam = bits() % 3 == 0 ? 0 : 4 + bits() % 16;
  const Point origin = wide(mesh.vertices[mesh.triangles[0][0]]);
  const auto corner = [&](std::uint32_t vertex) {
    mesh::CornerTexture its;
    const bool is_own = seam != 0 && bits() % seam == 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double step = is_own ? std::round(uniform(-4, 4)) : 0;
      its.point[axis] = kept(dot(along[axis], difference(wide(mesh.vertices[vertex]), origin)) + step, 1e4);
      for (std::size_t i = 0; i < 3; ++i) {
        const double component = is_own ? uniform(-1, 1) : along[axis][i];
        (axis == 0 ? its.gradient_x : its.gradient_y)[i] = kept(component, 1e3);
      }
    }
    return its;
  };
  mesh::CornerTextures textures;
  for (const auto& [a, b, c] : mesh.triangles) {
    const mesh::CornerTexture first_corner = corner(a), second = corner(b), third = corner(c);
    textures.push_back({first_corner, second, third});
  }
  return textures;
}

}  // namespace forceshade::properties
