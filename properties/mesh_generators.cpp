// SPDX-License-Identifier: BSD-3-Clause
#include "properties/mesh_generators.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "properties/binary32.h"
#include "properties/positions.h"

namespace forceshade::properties {
namespace {

using Point = std::array<double, 3>;
using Point2 = std::array<double, 2>;

// mm: what most coordinates are multiples of. With sizes up to 64 mm, products of two are exact in binary64.
constexpr double kLattice = 0x1p-14;

double twice_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point scaled_to(const Point& a, double length) {
  const double factor = length / std::max(std::sqrt(dot(a, a)), std::numeric_limits<double>::min());
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

Point wide(const mesh::Vertex& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// As a mesh may have it: exactly a binary32 of the domain, and not one that is read as 0.
bool is_coordinate(double value) {
  const auto narrow = static_cast<float>(value);
  return static_cast<double>(narrow) == value && reference::in_domain(narrow) && reference::quantised(narrow) == narrow;
}

float in_domain(double value) {
  return static_cast<float>(kept_in_domain(value));
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

mesh::CornerTextures MeshSource::textures_of(const mesh::TriangleMesh& mesh) {
  const auto kept = [](double value, double most) {
    const auto rounded = static_cast<float>(std::clamp(value, -most, most));
    return std::fabs(rounded) < 0x1p-30F ? 0.0F : rounded;
  };
  double size = 0;
  for (const mesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      const Point off = difference(wide(mesh.vertices[v]), wide(mesh.vertices[mesh.triangles[0][0]]));
      size = std::max(size, std::sqrt(dot(off, off)));
    }
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

MeshPath::MeshPath(const mesh::TriangleMesh& mesh, std::uint64_t seed) : Draws(seed), mesh_(mesh), size_(0) {
  for (const mesh::Triangle& triangle : mesh_.triangles)
    for (const std::uint32_t v : triangle) {
      const Point off = difference(wide(mesh_.vertices[v]), wide(mesh_.vertices[mesh_.triangles[0][0]]));
      size_ = std::max(size_, std::sqrt(dot(off, off)));
    }
}

MeshPath::Point MeshPath::corner(std::size_t triangle, std::size_t i) const {
  return wide(mesh_.vertices[mesh_.triangles[triangle][i]]);
}

MeshPath::Point MeshPath::normal(std::size_t triangle) const {
  const Point a = corner(triangle, 0);
  return scaled_to(cross(difference(corner(triangle, 1), a), difference(corner(triangle, 2), a)), 1);
}

MeshPath::Point MeshPath::vertex() {
  return corner(any_triangle(), bits() % 3);
}

// A corner, a point of a side, or any point; at binary fractions as often as not, so that it may be exact.
MeshPath::Point MeshPath::surface_point(std::size_t triangle) {
  const auto fraction = [&](double most) {
    return bits() % 2 == 0 ? uniform(0, most) : most * static_cast<double>(bits() % 9) / 8;
  };
  const double beta = bits() % 4 == 0 ? 0 : fraction(1), gamma = bits() % 4 == 0 ? 0 : fraction(1 - beta);
  const Point a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
  Point point{};
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = a[axis] + beta * (b[axis] - a[axis]) + gamma * (c[axis] - a[axis]);
  return point;
}

void MeshPath::begin_stretch() {
  kind_ = static_cast<PathKind>(bits() % kPathKinds.size());
  left_ = 1 + static_cast<int>(bits() % 40);
  reach_ = std::pow(10, uniform(-9, 3));
  if (bits() % 2 == 0) reach_ = size_ * std::pow(10, uniform(-6, 0));
  const std::size_t triangle = any_triangle();
  const Point towards = normal(triangle), on_surface = surface_point(triangle);
  const double depth = size_ * std::pow(10, uniform(-6, 0)) * (bits() % 4 == 0 ? 1 : -1);
  switch (kind_) {
    case PathKind::walk: break;  // from where it is
    case PathKind::stroke: {
      const Point other = surface_point(any_triangle());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at_[axis] = on_surface[axis] + depth * towards[axis];
        step_[axis] = (other[axis] + depth * towards[axis] - at_[axis]) / left_;
      }
      break;
    }
    case PathKind::press:
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at_[axis] = on_surface[axis] - depth * towards[axis];
        step_[axis] = 2 * depth * towards[axis] / left_;
      }
      break;
    case PathKind::graze:  // to and fro, down to less than a grid step of the surface apart
      reach_ = size_ * std::pow(10, uniform(-10, -6));
      at_ = on_surface;
      step_ = towards;
      break;
    case PathKind::axis_parallel: {
      const std::size_t axis = bits() % 3;
      at_ = bits() % 2 == 0 ? vertex() : on_surface;
      step_ = {};
      step_[axis] = (bits() % 2 == 0 ? 1 : -1) * (bits() % 2 == 0 ? size_ : reach_);
      for (double& length : step_) length = std::ldexp(std::round(std::ldexp(length, 8)), -8);
      at_[axis] -= left_ / 2 * step_[axis];
      break;
    }
    case PathKind::on_surface:
    case PathKind::beside_vertex:
    case PathKind::jump:
    case PathKind::few_bits: break;
    case PathKind::domain_end:
    case PathKind::invalid: left_ = 1 + left_ / 16;
  }
}

MeshPath::Point MeshPath::advanced() {
  switch (kind_) {
    case PathKind::walk:
      return {at_[0] + uniform(-reach_, reach_), at_[1] + uniform(-reach_, reach_), at_[2] + uniform(-reach_, reach_)};
    case PathKind::graze: return at_;
    case PathKind::on_surface: return surface_point(any_triangle());
    case PathKind::beside_vertex: {
      Point point = vertex();
      for (double& x : point) x = static_cast<double>(neighbour(static_cast<float>(x), small_step()));
      return point;
    }
    case PathKind::jump: {
      Point point = vertex();
      for (double& x : point) x += uniform(-size_, size_);
      return point;
    }
    case PathKind::few_bits: {
      Point point = vertex();
      for (double& x : point) x = std::round(x) + static_cast<double>(few_bits(size_));
      return point;
    }
    case PathKind::domain_end: {
      Point point = vertex();
      point[bits() % 3] = static_cast<double>(domain_end());
      return point;
    }
    default: return {at_[0] + step_[0], at_[1] + step_[1], at_[2] + step_[2]};
  }
}

std::array<float, 3> MeshPath::next() {
  if (left_ == 0) begin_stretch();
  --left_;
  if (bits() % 8 != 0) at_ = advanced();
  if (kind_ == PathKind::graze) {
    const double off = uniform(-reach_, reach_);
    return {in_domain(at_[0] + off * step_[0]), in_domain(at_[1] + off * step_[1]), in_domain(at_[2] + off * step_[2])};
  }
  std::array<float, 3> position{in_domain(at_[0]), in_domain(at_[1]), in_domain(at_[2])};
  if (kind_ == PathKind::invalid) {
    constexpr std::array<float, 4> kInvalid{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                            -std::numeric_limits<float>::infinity(), 10000.001F};
    position[bits() % 3] = kInvalid[bits() % kInvalid.size()];
  }
  return position;
}

}  // namespace forceshade::properties
