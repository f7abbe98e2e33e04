// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random surfaces that are hard for a god-object, each in the place where it is easy to describe.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "forceshade/mesh.h"
#include "properties/binary32.h"
#include "properties/mesh_points.h"
#include "properties/positions.h"

namespace forceshade::tests {

class Solids : protected properties::Draws {
 protected:
  using Point = properties::Point;
  using Point2 = std::array<double, 2>;

  // Triangles in a plane, counter-clockwise; its border as a loop, counter-clockwise.
  struct Planar {
    std::vector<Point2> points;
    std::vector<mesh::Triangle> triangles;
    std::vector<std::uint32_t> border;
  };
  struct Solid {
    std::vector<Point> vertices;
    std::vector<mesh::Triangle> triangles;
    bool is_closed = false;
  };

  explicit Solids(std::uint64_t seed) : Draws(seed) {}

  bool is_one_of(std::uint64_t number) { return bits() % number == 0; }
  int whole(int low, int high) {  // both included
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }

  // A coordinate as a mesh may have it.
  static double narrow(double value) {
    const auto kept = static_cast<double>(static_cast<float>(value));
    return std::fabs(kept) < 0x1p-30 ? 0 : kept;
  }

  // has_slivers: with triangles that are nearly without height.
  Planar grid(double width_of_cell, double depth_of_cell, bool has_slivers) {
    const int columns = whole(1, 8), rows = whole(1, 8);
    Planar planar;
    const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i)
        planar.points.push_back({on_lattice((i - columns / 2) * width_of_cell), on_lattice((j - rows / 2) * depth_of_cell)});
    add_cells(planar.triangles, rows + 1, columns + 1, false);
    for (int i = 0; i < columns; ++i) planar.border.push_back(index(i, 0));
    for (int j = 0; j < rows; ++j) planar.border.push_back(index(columns, j));
    for (int i = columns; i > 0; --i) planar.border.push_back(index(i, rows));
    for (int j = rows; j > 0; --j) planar.border.push_back(index(0, j));
    if (!has_slivers && is_one_of(3)) return planar;
    // Points off the border move while every triangle at them stays counter-clockwise; towards slivers, while the least area
    // falls.
    for (int attempt = 0; attempt < (has_slivers ? 60 : 3) * columns * rows && columns > 1 && rows > 1; ++attempt) {
      const auto moved = index(whole(1, columns - 1), whole(1, rows - 1));
      const auto least_area = [&] {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : planar.triangles)
          if (a == moved || b == moved || c == moved)
            least = std::min(least, twice_area(planar.points[a], planar.points[b], planar.points[c]));
        return least;
      };
      const double before = least_area();
      const Point2 old = planar.points[moved];
      planar.points[moved] = {on_lattice(old[0] + uniform(-0.6, 0.6) * width_of_cell),
                              on_lattice(old[1] + uniform(-0.6, 0.6) * depth_of_cell)};
      const double after = least_area();
      if (after <= 0 || (has_slivers && after > before)) planar.points[moved] = old;
    }
    return planar;
  }

  // Around a vertex of 3 to 200 triangles.
  Planar fan() {
    const int valence = is_one_of(3) ? whole(3, 200) : whole(3, 12);
    const double roughness = uniform(0, 0.9);
    for (;;) {
      Planar planar;
      planar.points.push_back({0, 0});
      for (int i = 0; i < valence; ++i) {
        const double angle = 2 * kPi * (i + uniform(0, roughness)) / valence, radius = 32 * uniform(1 - roughness, 1);
        planar.points.push_back({on_lattice(radius * std::cos(angle)), on_lattice(radius * std::sin(angle))});
      }
      bool is_star = true;
      for (int i = 0; i < valence; ++i) {
        const auto a = static_cast<std::uint32_t>(1 + i), b = static_cast<std::uint32_t>(1 + (i + 1) % valence);
        planar.triangles.push_back({0, a, b});
        planar.border.push_back(a);
        is_star = is_star && twice_area(planar.points[0], planar.points[a], planar.points[b]) > 0;
      }
      if (is_star) return planar;
    }
  }

  // Level, tilted, rough, nearly level, of numbers of all binades.
  Solid sheet(const Planar& planar) {
    const int kind = whole(0, 8);
    const double amplitude = std::exp2(whole(-13, 3)), wave = std::exp2(uniform(-4, -1));
    const double slope_x = whole(-4, 4) * 0.25, slope_y = whole(-4, 4) * 0.25;
    const auto height = [&](double x, double y) -> double {
      switch (kind) {
        case 0: return 0;
        case 1: return slope_x * x + slope_y * y;
        case 2: return slope_x * x + slope_y * y + kLattice * whole(-1, 1);
        case 3: return on_lattice(8 * std::sin(wave * x) * std::cos(wave * y));
        case 4: return (x * x - y * y) * 0x1p-6;
        case 5: return static_cast<double>(any_binade());
        case 6: return static_cast<double>(tiny());
        case 7: return is_one_of(4) ? amplitude : 0;
        default: return uniform(-1, 1) * amplitude;
      }
    };
    Solid solid{{}, planar.triangles};
    for (const auto& [x, y] : planar.points) solid.vertices.push_back({x, y, narrow(height(x, y))});
    return solid;
  }

  // The rim of a fan at any height, its centre above and below: over every point of the plane the upper fan is higher.
  Solid bipyramid() {
    const Planar planar = fan();
    Solid solid = sheet(planar);
    const auto below = static_cast<std::uint32_t>(solid.vertices.size());
    const double upper = solid.vertices[0][2];
    const double gap = is_one_of(2) ? kLattice * whole(1, 64) : uniform(0.1, 30);
    const double lower = narrow(upper - gap);
    solid.vertices.push_back({0, 0, lower == 0 ? std::min(0.0, upper - kLattice) : lower});
    for (const auto& [centre, a, b] : planar.triangles) solid.triangles.push_back({below, b, a});
    solid.is_closed = true;
    return solid;
  }

  // Closed, with walls at a right angle to a level or rough top and bottom.
  Solid slab(const Planar& planar) {
    Solid solid = sheet(planar);
    const auto count = static_cast<std::uint32_t>(solid.vertices.size());
    const double low = -std::exp2(whole(4, 5));
    const bool is_parallel = is_one_of(2);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Point top = solid.vertices[i];
      solid.vertices.push_back({top[0], top[1], is_parallel ? static_cast<double>(static_cast<float>(top[2] + low)) : 4 * low});
    }
    for (const auto& [a, b, c] : planar.triangles) solid.triangles.push_back({a + count, c + count, b + count});
    for (std::size_t i = 0; i < planar.border.size(); ++i) {
      const std::uint32_t a = planar.border[i], b = planar.border[(i + 1) % planar.border.size()];
      add_quad(solid.triangles, {a + count, b + count, b, a});
    }
    solid.is_closed = true;
    return solid;
  }

  // Two sheets, down to one unit in the last place apart.
  Solid double_wall() {
    const Planar planar = is_one_of(2) ? grid(4, 4, false) : fan();
    Solid solid = sheet(planar);
    const auto count = static_cast<std::uint32_t>(solid.vertices.size());
    const double gap = std::exp2(whole(-13, 1));
    const bool is_nearest = is_one_of(2), is_turned = is_one_of(2);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto [x, y, z] = solid.vertices[i];
      const auto next = static_cast<double>(properties::neighbour(static_cast<float>(z), 1));
      const double above = narrow(is_nearest && std::fabs(next) >= 0x1p-30 ? next : z + gap);
      solid.vertices.push_back({x, y, above == 0 ? 0x1p-30 : above});
    }
    for (const auto& [a, b, c] : planar.triangles)
      solid.triangles.push_back(is_turned ? mesh::Triangle{a + count, c + count, b + count}
                                          : mesh::Triangle{a + count, b + count, c + count});
    return solid;
  }

  // An octahedron, subdivided; each vertex at its own distance from the centre. Every triangle, seen from the centre, stays
  // counter-clockwise and close to where it was, so that they cover the sphere of directions once.
  Solid star() {
    Solid solid{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
                true};
    for (int level = whole(0, 3); level > 0; --level) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
      const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(solid.vertices.size()));
        if (is_new) {
          const Point &A = solid.vertices[a], &B = solid.vertices[b];
          solid.vertices.push_back(properties::scaled_to({A[0] + B[0], A[1] + B[1], A[2] + B[2]}, 1));
        }
        return found->second;
      };
      std::vector<mesh::Triangle> finer;
      for (const auto& [a, b, c] : solid.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      }
      solid.triangles = std::move(finer);
    }
    const double roughness = is_one_of(2) ? 0 : uniform(0, 0.8);
    for (Point& vertex : solid.vertices) {
      vertex = properties::scaled_to(vertex, 32 * uniform(1 - roughness, 1));
      for (double& coordinate : vertex) coordinate = on_lattice(coordinate);
    }
    return solid;
  }

  Solid torus() {
    Solid solid;
    const int around = whole(6, 14), across = whole(5, 9);
    for (int j = 0; j < around; ++j)
      for (int i = 0; i < across; ++i) {
        const double u = 2 * kPi * j / around, v = 2 * kPi * i / across, radius = 24 + 8 * std::cos(v);
        solid.vertices.push_back(
            {on_lattice(radius * std::cos(u)), on_lattice(radius * std::sin(u)), on_lattice(8 * std::sin(v))});
      }
    add_cells(solid.triangles, around, across, true);
    for (auto& [a, b, c] : solid.triangles) std::swap(b, c);  // outwards
    solid.is_closed = true;
    return solid;
  }

  // To and fro, each turn above the one before.
  Solid folds() {
    std::vector<Point2> profile;
    const double rise = is_one_of(2) ? kLattice : std::exp2(whole(-12, 3)), reach = std::exp2(whole(0, 5));
    double z = 0;
    for (int i = whole(3, 8); i > 0; --i) {
      profile.push_back({i % 2 == 0 ? reach : -reach, z});
      z += on_lattice(rise * whole(1, 4));
    }
    return extruded(profile);
  }

  // Horizontal and vertical faces.
  Solid stairs() {
    std::vector<Point2> profile{{-32, 0}};
    for (int i = whole(2, 8); i > 0; --i) {
      const Point2 last = profile.back();
      profile.push_back({last[0] + on_lattice(uniform(0.1, 8)), last[1]});
      profile.push_back({profile.back()[0], last[1] + on_lattice((is_one_of(2) ? 1 : -1) * uniform(0.1, 8))});
    }
    profile.push_back({profile.back()[0] + 4, profile.back()[1]});
    return extruded(profile);
  }

 private:
  static constexpr double kPi = 3.14159265358979;
  // mm: what most coordinates are multiples of. With sizes up to 64 mm, products of two are exact in binary64.
  static constexpr double kLattice = 0x1p-14;

  static double on_lattice(double value) { return std::round(value / kLattice) * kLattice; }
  static double twice_area(const Point2& a, const Point2& b, const Point2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  // Along either diagonal.
  void add_quad(std::vector<mesh::Triangle>& triangles, const std::array<std::uint32_t, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    const bool is_first = is_one_of(2);
    triangles.insert(triangles.end(), {{a, b, is_first ? c : d}, {is_first ? a : b, c, d}});
  }

  // The cells of a grid of vertices that is there already, row by row; cyclic in both directions or in none.
  void add_cells(std::vector<mesh::Triangle>& triangles, int rows, int columns, bool is_cyclic) {
    const auto index = [&](int j, int i) { return static_cast<std::uint32_t>(j % rows * columns + i % columns); };
    const int last = is_cyclic ? 0 : 1;
    for (int j = 0; j < rows - last; ++j)
      for (int i = 0; i < columns - last; ++i)
        add_quad(triangles, {index(j, i), index(j, i + 1), index(j + 1, i + 1), index(j + 1, i)});
  }

  // A profile in x and z that does not cross itself, along y.
  Solid extruded(const std::vector<Point2>& profile) {
    Solid solid;
    const int rows = whole(2, 6);
    const double width = std::exp2(whole(-2, 3));
    for (int j = 0; j < rows; ++j)
      for (const auto& [x, z] : profile) solid.vertices.push_back({x, width * (j - rows / 2), z});
    add_cells(solid.triangles, rows, static_cast<int>(profile.size()), false);
    return solid;
  }
};

}  // namespace forceshade::tests
