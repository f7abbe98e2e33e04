// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random meshes that are hard for a god-object.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/solids.h"

namespace forceshade::tests {

inline constexpr std::array<std::string_view, 11> kMeshFamilies{
    "height field",  // an open sheet
    "slivers",       // the same with triangles that are nearly without height
    "needles",       // the same with cells up to 2^15 times as long as they are wide
    "fan",           // one vertex with 3 to 200 triangles: a pyramid, a saddle, rough
    "bipyramid",     // two such fans, closed
    "slab",          // closed, with walls at a right angle to a level or rough top and bottom
    "double wall",   // two sheets, down to one unit in the last place apart
    "star",          // closed, smooth to spiky
    "torus",         // closed
    "folds",         // a sheet that is folded to and fro, nearly onto itself
    "stairs"         // horizontal and vertical faces
};

struct RandomMesh {
  std::size_t family;  // in kMeshFamilies
  mesh::TriangleMesh mesh;
  mesh::Sides sides;
};

// An endless, repeatable stream of meshes, each family in turn. Every one is what docs/god-object.md demands, because of how it
// is built. Axes change places, the size is multiplied by a power of two, some lie far from the origin; vertices and triangles
// come in any order.
class MeshSource : private Solids {
  Point any_direction() {
    const double x = uniform(-1, 1), y = uniform(-1, 1);
    return {x, y, uniform(-1, 1)};
  }

  // The draws of corner(0), corner(1) and corner(2), in this order.
  template <class Corner>
  static auto three(const Corner& corner) {
    const auto first = corner(0), second = corner(1);
    return std::array{first, second, corner(2)};
  }

 public:
  explicit MeshSource(std::uint64_t seed) : Solids(seed) {}

  RandomMesh next() { return of_family(count_++ % kMeshFamilies.size()); }
  RandomMesh of_family(std::size_t family) {
    Solid made = solid(family);
    const bool is_usual = !is_one_of(8);
    const mesh::Sides sides = made.is_closed == is_usual ? mesh::Sides::front : mesh::Sides::both;
    return {family, placed(std::move(made)), sides};
  }

  // One normal for each vertex, or one for each of some of its triangles; unit vectors about those of the surface, but for
  // some that point elsewhere.
  mesh::CornerNormals normals_of(const mesh::TriangleMesh& mesh) {
    std::vector<Point> flat, smooth(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Point A = properties::wide(mesh.vertices[a]),
                  n = properties::cross(properties::difference(properties::wide(mesh.vertices[b]), A),
                                        properties::difference(properties::wide(mesh.vertices[c]), A));
      flat.push_back(properties::scaled_to(n, 1));
      for (const std::uint32_t v : {a, b, c})
        for (std::size_t axis = 0; axis < 3; ++axis) smooth[v][axis] += flat.back()[axis];
    }
    const std::uint64_t crease = is_one_of(3) ? 0 : 2 + bits() % 8, stray = is_one_of(2) ? 0 : 16;
    const auto narrowed = [&](const Point& normal) {
      const bool is_stray = stray != 0 && is_one_of(stray);
      const Point unit = properties::scaled_to(is_stray ? any_direction() : normal, 1);
      return mesh::Normal{static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2])};
    };
    std::vector<mesh::Normal> shared;
    for (const Point& normal : smooth) shared.push_back(narrowed(normal));
    mesh::CornerNormals normals;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const mesh::Normal own = narrowed(flat[i]);
      const auto corner = [&](std::size_t k) { return crease != 0 && is_one_of(crease) ? own : shared[mesh.triangles[i][k]]; };
      normals.push_back(three(corner));
    }
    return normals;
  }

  // One material for all triangles, or some by face: smooth, from 2^-10 to 2^10, and infinite; without a stiffness.
  mesh::Materials materials_of(const mesh::TriangleMesh& mesh) {
    mesh::Materials materials;
    for (int i = whole(1, 6); i > 0; i -= 2) materials.list.push_back(material());
    if (materials.list.size() > 1)
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        materials.of_triangle.push_back(static_cast<std::uint32_t>(bits() % materials.list.size()));
    return materials;
  }

  // A map laid along two directions, some 20 mm of it over the mesh; some corners have a point or a gradient of their own, so
  // that there are seams.
  mesh::CornerTextures textures_of(const mesh::TriangleMesh& mesh) {
    const auto kept = [](double value, double most) { return static_cast<float>(narrow(std::clamp(value, -most, most))); };
    const double size = properties::size_of(mesh);
    // Along axes every other time, so that coordinates have few bits and the map's edges and kinks are met.
    const bool is_along_axes = is_one_of(2);
    const double per_mm = is_along_axes ? std::exp2(std::round(std::log2(10 / size))) : uniform(1, 20) / size;
    const std::size_t first = bits() % 3;
    const auto direction = [&](std::size_t axis) {
      Point along = any_direction();
      if (is_along_axes) {
        along = {};
        along[(first + axis) % 3] = 1;
      }
      for (double& component : along) component *= per_mm;
      return along;
    };
    const std::array<Point, 2> along{direction(0), direction(1)};
    const std::uint64_t seam = is_one_of(3) ? 0 : 4 + bits() % 16;
    const Point origin = properties::wide(mesh.vertices[mesh.triangles[0][0]]);
    mesh::CornerTextures textures;
    for (const mesh::Triangle& triangle : mesh.triangles)
      textures.push_back(three([&](std::size_t k) {
        mesh::CornerTexture its;
        const bool is_own = seam != 0 && is_one_of(seam);
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double step = is_own ? std::round(uniform(-4, 4)) : 0;
          const Point way = properties::difference(properties::wide(mesh.vertices[triangle[k]]), origin);
          its.point[axis] = kept(properties::dot(along[axis], way) + step, 1e4);
          for (std::size_t i = 0; i < 3; ++i)
            (axis == 0 ? its.gradient_x : its.gradient_y)[i] = kept(is_own ? uniform(-1, 1) : along[axis][i], 1e3);
        }
        return its;
      }));
    return textures;
  }

 private:
  Solid solid(std::size_t family) {
    switch (family) {
      case 0: return sheet(grid(std::exp2(whole(-3, 2)), std::exp2(whole(-3, 2)), false));
      case 1: return sheet(grid(4, 4, true));
      case 2: return sheet(grid(std::exp2(whole(-13, -4)), std::exp2(whole(0, 2)), false));
      case 3: return sheet(fan());
      case 4: return bipyramid();
      case 5: return slab(is_one_of(2) ? grid(4, 4, is_one_of(2)) : fan());
      case 6: return double_wall();
      case 7: return star();
      case 8: return torus();
      case 9: return folds();
      default: return stairs();
    }
  }

  mesh::Material material() {
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

  // Elsewhere, of another size, turned, renumbered.
  mesh::TriangleMesh placed(Solid solid) {
    // Does so where each coordinate is then exactly a binary32 of the domain, and not one that is read as 0.
    const auto change = [&](const auto& changed) {
      const auto can_be = [&](double x) {
        return reference::in_domain(static_cast<float>(changed(x))) && narrow(changed(x)) == changed(x);
      };
      if (!std::ranges::all_of(solid.vertices, [&](const Point& v) { return std::ranges::all_of(v, can_be); })) return;
      for (Point& v : solid.vertices)
        for (double& x : v) x = changed(x);
    };
    if (is_one_of(4)) {
      const double offset = std::exp2(whole(3, 8)) * whole(-7, 7);
      change([=](double x) { return x + offset; });
    }
    const double scale = is_one_of(2) ? 1 : std::exp2(whole(-14, 8));
    change([=](double x) { return x * scale; });

    std::array<std::size_t, 3> axes{0, 1, 2};
    for (std::size_t i = 0; i < 3; ++i) std::swap(axes[i], axes[bits() % 3]);
    const std::array<double, 3> signs{is_one_of(2) ? 1.0 : -1.0, is_one_of(2) ? 1.0 : -1.0, 1.0};
    const bool is_odd = axes[1] == (axes[0] + 2) % 3;
    const bool is_mirrored = is_odd != (signs[0] * signs[1] < 0);

    const auto shuffled = [&](std::size_t size) {
      std::vector<std::uint32_t> order(size);
      std::iota(order.begin(), order.end(), 0U);
      for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[bits() % i]);
      return order;
    };
    mesh::TriangleMesh mesh;
    const std::vector<std::uint32_t> new_index = shuffled(solid.vertices.size());
    mesh.vertices.resize(solid.vertices.size());
    for (std::size_t i = 0; i < solid.vertices.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        mesh.vertices[new_index[i]][axis] = static_cast<float>(signs[axis] * solid.vertices[i][axes[axis]]);
    // An open sheet may as well face the other way.
    const bool is_turned = is_mirrored != (!solid.is_closed && is_one_of(2));
    for (const std::uint32_t old : shuffled(solid.triangles.size())) {
      mesh::Triangle triangle = solid.triangles[old];
      if (is_turned) std::swap(triangle[1], triangle[2]);
      std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(bits() % 3), triangle.end());
      for (std::uint32_t& v : triangle) v = new_index[v];
      mesh.triangles.push_back(triangle);
    }
    return mesh;
  }

  std::size_t count_ = 0;
};

}  // namespace forceshade::tests
