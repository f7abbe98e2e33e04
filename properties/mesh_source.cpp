// SPDX-License-Identifier: BSD-3-Clause
#include "properties/mesh_source.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "properties/binary32.h"
#include "properties/mesh_points.h"

namespace forceshade::properties {
namespace {

using Point2 = std::array<double, 2>;

// mm: what most coordinates are multiples of. With sizes up to 64 mm, products of two are exact in binary64.
constexpr double kLattice = 0x1p-14;

double twice_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// As a mesh may have it: exactly a binary32 of the domain, and not one that is read as 0.
bool is_coordinate(double value) {
  const auto narrow = static_cast<float>(value);
  return static_cast<double>(narrow) == value && reference::in_domain(narrow) && reference::quantised(narrow) == narrow;
}

}  // namespace

int MeshSource::whole(int low, int high) {
  return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
}

double MeshSource::on_lattice(double value) const {
  return std::round(value / kLattice) * kLattice;
}

MeshSource::Planar MeshSource::grid(double width_of_cell, double depth_of_cell, bool has_slivers) {
  const int columns = whole(1, 8), rows = whole(1, 8);
  Planar planar;
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      planar.points.push_back({on_lattice((i - columns / 2) * width_of_cell), on_lattice((j - rows / 2) * depth_of_cell)});
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      if (bits() % 2 == 0)
        planar.triangles.insert(planar.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        planar.triangles.insert(planar.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  for (int i = 0; i < columns; ++i) planar.border.push_back(index(i, 0));
  for (int j = 0; j < rows; ++j) planar.border.push_back(index(columns, j));
  for (int i = columns; i > 0; --i) planar.border.push_back(index(i, rows));
  for (int j = rows; j > 0; --j) planar.border.push_back(index(0, j));
  if (!has_slivers && bits() % 3 == 0) return planar;
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

MeshSource::Planar MeshSource::fan() {
  const int valence = bits() % 3 == 0 ? whole(3, 200) : whole(3, 12);
  const double roughness = uniform(0, 0.9);
  for (;;) {
    Planar planar;
    planar.points.push_back({0, 0});
    for (int i = 0; i < valence; ++i) {
      const double angle = 2 * 3.14159265358979 * (i + uniform(0, roughness)) / valence,
                   radius = 32 * uniform(1 - roughness, 1);
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

std::vector<double> MeshSource::heights(const Planar& planar) {
  const int kind = whole(0, 8);
  const double amplitude = std::exp2(whole(-13, 3)), wave = std::exp2(uniform(-4, -1));
  const double slope_x = whole(-4, 4) * 0.25, slope_y = whole(-4, 4) * 0.25;
  std::vector<double> z;
  for (const auto& [x, y] : planar.points) switch (kind) {
      case 0: z.push_back(0); break;
      case 1: z.push_back(slope_x * x + slope_y * y); break;
      case 2: z.push_back(slope_x * x + slope_y * y + kLattice * whole(-1, 1)); break;
      case 3: z.push_back(on_lattice(8 * std::sin(wave * x) * std::cos(wave * y))); break;
      case 4: z.push_back((x * x - y * y) * 0x1p-6); break;
      case 5: z.push_back(static_cast<double>(any_binade())); break;
      case 6: z.push_back(static_cast<double>(tiny())); break;
      case 7: z.push_back(bits() % 4 == 0 ? amplitude : 0); break;
      default: z.push_back(uniform(-1, 1) * amplitude);
    }
  for (double& height : z) {
    height = static_cast<double>(static_cast<float>(height));
    if (std::fabs(height) < 0x1p-30) height = 0;
  }
  return z;
}

MeshSource::Solid MeshSource::sheet(const Planar& planar) {
  Solid solid;
  const std::vector<double> z = heights(planar);
  for (std::size_t i = 0; i < z.size(); ++i) solid.vertices.push_back({planar.points[i][0], planar.points[i][1], z[i]});
  solid.triangles = planar.triangles;
  return solid;
}

// The rim of a fan at any height, its centre above and below: over every point of the plane the upper fan is higher.
MeshSource::Solid MeshSource::bipyramid() {
  const Planar planar = fan();
  Solid solid = sheet(planar);
  const auto below = static_cast<std::uint32_t>(solid.vertices.size());
  const double upper = solid.vertices[0][2];
  const double gap = bits() % 2 == 0 ? kLattice * whole(1, 64) : uniform(0.1, 30);
  solid.vertices.push_back({0, 0, static_cast<double>(static_cast<float>(upper - gap))});
  if (std::fabs(solid.vertices.back()[2]) < 0x1p-30) solid.vertices.back()[2] = std::min(0.0, upper - kLattice);
  for (const auto& [centre, a, b] : planar.triangles) solid.triangles.push_back({below, b, a});
  solid.is_closed = true;
  return solid;
}

MeshSource::Solid MeshSource::slab(const Planar& planar) {
  Solid solid = sheet(planar);
  const auto count = static_cast<std::uint32_t>(solid.vertices.size());
  const double low = -std::exp2(whole(4, 5));
  const bool is_parallel = bits() % 2 == 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point top = solid.vertices[i];
    solid.vertices.push_back({top[0], top[1], is_parallel ? static_cast<double>(static_cast<float>(top[2] + low)) : 4 * low});
  }
  for (const auto& [a, b, c] : planar.triangles) solid.triangles.push_back({a + count, c + count, b + count});
  for (std::size_t i = 0; i < planar.border.size(); ++i) {
    const std::uint32_t a = planar.border[i], b = planar.border[(i + 1) % planar.border.size()];
    if (bits() % 2 == 0)
      solid.triangles.insert(solid.triangles.end(), {{a + count, b + count, b}, {a + count, b, a}});
    else
      solid.triangles.insert(solid.triangles.end(), {{a + count, b + count, a}, {b + count, b, a}});
  }
  solid.is_closed = true;
  return solid;
}

MeshSource::Solid MeshSource::double_wall() {
  const Planar planar = bits() % 2 == 0 ? grid(4, 4, false) : fan();
  Solid solid = sheet(planar);
  const auto count = static_cast<std::uint32_t>(solid.vertices.size());
  const double gap = std::exp2(whole(-13, 1));
  const bool is_nearest = bits() % 2 == 0, is_turned = bits() % 2 == 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [x, y, z] = solid.vertices[i];
    const auto next = static_cast<double>(neighbour(static_cast<float>(z), 1));
    const double above = is_nearest && std::fabs(next) >= 0x1p-30 ? next : static_cast<double>(static_cast<float>(z + gap));
    solid.vertices.push_back({x, y, std::fabs(above) < 0x1p-30 ? 0x1p-30 : above});
  }
  for (const auto& [a, b, c] : planar.triangles)
    solid.triangles.push_back(is_turned ? mesh::Triangle{a + count, c + count, b + count}
                                        : mesh::Triangle{a + count, b + count, c + count});
  return solid;
}

// An octahedron, subdivided; each vertex at its own distance from the centre. Every triangle, seen from the centre, stays
// counter-clockwise and close to where it was, so that they cover the sphere of directions once.
MeshSource::Solid MeshSource::star() {
  Solid solid;
  solid.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  solid.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = whole(0, 3); level > 0; --level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(solid.vertices.size()));
      if (is_new) {
        const Point &A = solid.vertices[a], &B = solid.vertices[b];
        solid.vertices.push_back(scaled_to({A[0] + B[0], A[1] + B[1], A[2] + B[2]}, 1));
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
  const double roughness = bits() % 2 == 0 ? 0 : uniform(0, 0.8);
  for (Point& vertex : solid.vertices) {
    vertex = scaled_to(vertex, 32 * uniform(1 - roughness, 1));
    for (double& coordinate : vertex) coordinate = on_lattice(coordinate);
  }
  solid.is_closed = true;
  return solid;
}

// The cells of a grid of vertices that is there already, row by row; cyclic in both directions or in none.
void MeshSource::add_cells(Solid& solid, int rows, int columns, bool is_cyclic) {
  const auto index = [&](int j, int i) { return static_cast<std::uint32_t>(j % rows * columns + i % columns); };
  const int last = is_cyclic ? 0 : 1;
  for (int j = 0; j < rows - last; ++j)
    for (int i = 0; i < columns - last; ++i) {
      const auto a = index(j, i), b = index(j, i + 1), c = index(j + 1, i + 1), d = index(j + 1, i);
      if (bits() % 2 == 0)
        solid.triangles.insert(solid.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        solid.triangles.insert(solid.triangles.end(), {{a, b, d}, {b, c, d}});
    }
}

MeshSource::Solid MeshSource::torus() {
  Solid solid;
  const int around = whole(6, 14), across = whole(5, 9);
  for (int j = 0; j < around; ++j)
    for (int i = 0; i < across; ++i) {
      const double u = 2 * 3.14159265358979 * j / around, v = 2 * 3.14159265358979 * i / across, radius = 24 + 8 * std::cos(v);
      solid.vertices.push_back(
          {on_lattice(radius * std::cos(u)), on_lattice(radius * std::sin(u)), on_lattice(8 * std::sin(v))});
    }
  add_cells(solid, around, across, true);
  for (auto& [a, b, c] : solid.triangles) std::swap(b, c);  // outwards
  solid.is_closed = true;
  return solid;
}

// A profile in x and z that does not cross itself, along y.
MeshSource::Solid MeshSource::extruded(const std::vector<Point2>& profile) {
  Solid solid;
  const int rows = whole(2, 6);
  const double width = std::exp2(whole(-2, 3));
  for (int j = 0; j < rows; ++j)
    for (const auto& [x, z] : profile) solid.vertices.push_back({x, width * (j - rows / 2), z});
  add_cells(solid, rows, static_cast<int>(profile.size()), false);
  return solid;
}

// To and fro, each turn above the one before.
MeshSource::Solid MeshSource::folds() {
  std::vector<Point2> profile;
  const double rise = bits() % 2 == 0 ? kLattice : std::exp2(whole(-12, 3)), reach = std::exp2(whole(0, 5));
  double z = 0;
  for (int i = whole(3, 8); i > 0; --i) {
    profile.push_back({i % 2 == 0 ? reach : -reach, z});
    z += on_lattice(rise * whole(1, 4));
  }
  return extruded(profile);
}

MeshSource::Solid MeshSource::stairs() {
  std::vector<Point2> profile{{-32, 0}};
  for (int i = whole(2, 8); i > 0; --i) {
    const Point2 last = profile.back();
    profile.push_back({last[0] + on_lattice(uniform(0.1, 8)), last[1]});
    profile.push_back({profile.back()[0], last[1] + on_lattice((bits() % 2 == 0 ? 1 : -1) * uniform(0.1, 8))});
  }
  profile.push_back({profile.back()[0] + 4, profile.back()[1]});
  return extruded(profile);
}

// Elsewhere, of another size, turned, renumbered.
mesh::TriangleMesh MeshSource::placed(Solid solid) {
  const auto can_be = [&](const auto& changed) {
    return std::ranges::all_of(solid.vertices, [&](const Point& v) {
      return std::ranges::all_of(v, [&](double x) { return is_coordinate(changed(x)); });
    });
  };
  const auto change = [&](const auto& changed) {
    if (!can_be(changed)) return;
    for (Point& v : solid.vertices)
      for (double& x : v) x = changed(x);
  };
  if (bits() % 4 == 0) {
    const double offset = std::exp2(whole(3, 8)) * whole(-7, 7);
    change([=](double x) { return x + offset; });
  }
  const double scale = bits() % 2 == 0 ? 1 : std::exp2(whole(-14, 8));
  change([=](double x) { return x * scale; });

  std::array<std::size_t, 3> axes{0, 1, 2};
  for (std::size_t i = 0; i < 3; ++i) std::swap(axes[i], axes[bits() % 3]);
  const std::array<double, 3> signs{bits() % 2 == 0 ? 1.0 : -1.0, bits() % 2 == 0 ? 1.0 : -1.0, 1.0};
  const bool is_odd = axes[0] == 0 ? axes[1] == 2 : axes[0] == 1 ? axes[1] == 0 : axes[1] == 1;
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
  const bool is_turned = is_mirrored != (!solid.is_closed && bits() % 2 == 0);
  for (const std::uint32_t old : shuffled(solid.triangles.size())) {
    mesh::Triangle triangle = solid.triangles[old];
    if (is_turned) std::swap(triangle[1], triangle[2]);
    std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(bits() % 3), triangle.end());
    for (std::uint32_t& v : triangle) v = new_index[v];
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

RandomMesh MeshSource::of_family(std::size_t family) {
  const auto solid = [&]() -> Solid {
    switch (family) {
      case 0: return sheet(grid(std::exp2(whole(-3, 2)), std::exp2(whole(-3, 2)), false));
      case 1: return sheet(grid(4, 4, true));
      case 2: return sheet(grid(std::exp2(whole(-13, -4)), std::exp2(whole(0, 2)), false));
      case 3: return sheet(fan());
      case 4: return bipyramid();
      case 5: return slab(bits() % 2 == 0 ? grid(4, 4, bits() % 2 == 0) : fan());
      case 6: return double_wall();
      case 7: return star();
      case 8: return torus();
      case 9: return folds();
      default: return stairs();
    }
  };
  Solid made = solid();
  const bool is_usual = bits() % 8 != 0;
  const mesh::Sides sides = made.is_closed == is_usual ? mesh::Sides::front : mesh::Sides::both;
  return {family, placed(std::move(made)), sides};
}

}  // namespace forceshade::properties
