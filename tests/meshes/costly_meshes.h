// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes on which a tick looks at many triangles, each with positions of a hand that make it do so.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::tests {

struct CostlyMesh {
  const char* family;
  mesh::TriangleMesh mesh;
  mesh::Sides sides;
  std::vector<std::array<float, 3>> positions;  // mm
};

// The position of a search for the worst tick: the mesh's own in turns, and after two rounds varied, as is the worst so far.
inline std::array<float, 3> drawn_position(const CostlyMesh& one, std::size_t step, const std::array<float, 3>& worst,
                                           std::mt19937_64& random) {
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::array<float, 3> p = one.positions[step % one.positions.size()];
  const float reach = std::ldexp(1000.0F, -static_cast<int>(random() % 24));
  if (step >= 2 * one.positions.size())
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = (random() % 2 == 0 ? p : worst)[axis] + (random() % 3 == 0 ? 0 : reach * uniform(random));
  return p;
}

inline std::uint32_t add_vertex(mesh::TriangleMesh& mesh, double x, double y, double z) {
  mesh.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

// n x n slivers side by side, 1 m long, along `way`: where it is no axis, all boxes overlap.
inline CostlyMesh needles(std::uint32_t n, const std::array<double, 3>& way = {1, 1, 1}) {
  CostlyMesh made{"needles", {}, mesh::Sides::both, {{600, 0, 0}}};
  const auto end = [&](double by) {
    return std::array{static_cast<float>(by * way[0]), static_cast<float>(by * way[1]), static_cast<float>(by * way[2])};
  };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double x = i / 16.0, y = j / 16.0;
      const std::uint32_t first = add_vertex(made.mesh, x - 500 * way[0], y - 500 * way[1], -500 * way[2]);
      add_vertex(made.mesh, x - 500 * way[0] + 1.0 / 64, y - 500 * way[1], -500 * way[2]);
      add_vertex(made.mesh, x + 500 * way[0], y + 500 * way[1] + 1.0 / 64, 500 * way[2]);
      made.mesh.triangles.push_back({first, first + 1, first + 2});
    }
  made.positions.push_back(end(-900));
  made.positions.push_back(end(900));
  made.positions.push_back({0.5F, 0.5F, 0.5F});
  made.positions.push_back({static_cast<float>(n) / 16, static_cast<float>(n) / 17, -0.5F});
  return made;
}

// The vertices along the bottom of a straight valley have 2 fan + 4 triangles each.
inline CostlyMesh valley(std::uint32_t hubs, std::uint32_t fan) {
  CostlyMesh made{"a valley of fans", {}, mesh::Sides::front, {}};
  for (std::uint32_t k = 0; k < hubs; ++k) add_vertex(made.mesh, k, 0, 0);
  for (const bool is_left : {true, false}) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      made.mesh.triangles.push_back(is_left ? mesh::Triangle{a, b, c} : mesh::Triangle{a, c, b});
    };
    const auto first = static_cast<std::uint32_t>(made.mesh.vertices.size());
    for (std::uint32_t k = 0; k < hubs; ++k)
      for (std::uint32_t j = 0; j < fan; ++j) add_vertex(made.mesh, k - 0.5 + (j + 0.5) / fan, is_left ? 5 : -5, 5);
    for (std::uint32_t k = 0; k < hubs; ++k) {
      const std::uint32_t start = first + k * fan;
      for (std::uint32_t j = 0; j + 1 < fan; ++j) add(k, start + j + 1, start + j);
      if (k + 1 == hubs) continue;
      add(k, start + fan, start + fan - 1);
      add(k, k + 1, start + fan);
    }
  }
  const auto along = [&](double part) { return static_cast<float>(part * (hubs - 1)); };
  made.positions = {{0.25F, 0, 2}, {0.25F, 0, -1}, {along(0.9), 0.01F, -1}, {along(0.5), 0.01F, -1}, {along(0.01), 0.01F, -1}};
  return made;
}

// n sheets above one another.
inline CostlyMesh layers(std::uint32_t n, mesh::Sides sides) {
  CostlyMesh made{sides == mesh::Sides::front ? "a pile of sheets, from behind" : "a pile of sheets", {}, sides, {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const double z = i / 1024.0;
    const std::uint32_t k = add_vertex(made.mesh, -10, -10, z);
    add_vertex(made.mesh, 10, -10, z);
    add_vertex(made.mesh, 10, 10, z);
    add_vertex(made.mesh, -10, 10, z);
    made.mesh.triangles.push_back({k, k + 1, k + 2});
    made.mesh.triangles.push_back({k, k + 2, k + 3});
  }
  const float above = static_cast<float>(n) / 1024 + 5;
  made.positions = {{3, 1, -5}, {3, 1, above}, {2, 2, -5}, {3, 2, above}, {9, -9, -5}, {12, 12, above}, {2, 2, -5}};
  return made;
}

// n times three slivers through about one point, 1 m along each axis, beside which a hand goes through 100 tiles: each of them
// turns it from one side to the other. Slivers of three axes lie in one leaf of a tree of boxes, whose box the hand is in,
// while it is in no box of a sliver: so the code tests them all, and none counts.
inline CostlyMesh jacks(std::uint32_t n) {
  CostlyMesh made{"slivers of three axes", {}, mesh::Sides::both, {{150, 200, 250}, {330, 380, 430}}};
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double c = i / 128.0, thin = 1.0 / 1024;
      const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
      const auto add = [&](double along, double aside) {
        std::array<double, 3> at{};
        at[axis] = c + along;
        at[j] = c + aside;
        at[k] = c + 3 * thin;
        return add_vertex(made.mesh, at[0], at[1], at[2]);
      };
      const std::uint32_t first = add(-500, 0);
      add(500, 0);
      add(0, thin);
      made.mesh.triangles.push_back({first, first + 1, first + 2});
    }
  for (int tile = 0; tile < 100; ++tile) {
    const double d = 151 + 1.5 * tile, tilt = tile % 2 == 0 ? 0.25 : -0.25;
    const auto add = [&](double a, double b) {  // along (1, -1, 0) and (1, 1, -2)
      const double by = d + tilt * a;
      return add_vertex(made.mesh, by + a + b, by + 50 - a + b, by + 100 - 2 * b);
    };
    const std::uint32_t first = add(-1, -1);
    add(1, -1);
    add(1, 1);
    add(-1, 1);
    made.mesh.triangles.push_back({first, first + 1, first + 2});
    made.mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return made;
}

// n triangles around the origin, whose other corners lie 50 mm off it, at heights up to `height`.
inline CostlyMesh pole(std::uint32_t n, double height) {
  CostlyMesh made{height < 1 ? "one nearly flat vertex" : "one vertex", {}, mesh::Sides::front, {}};
  add_vertex(made.mesh, 0, 0, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    add_vertex(made.mesh, 50 * std::cos(angle), 50 * std::sin(angle), height / 100 * (7919 * i % 100));
    made.mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  made.positions = {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0.1F, 0.1F, -1}, {0, 0, -1}, {0, 0, 2}, {0.25F, 0.125F, -1}};
  return made;
}

}  // namespace forceshade::tests
