// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/tests/meshes/random_meshes.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace forceshade::tests {
namespace {

using mesh::TriangleMesh;
using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
mesh::Vertex vertex(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// (columns + 1)·(rows + 1) vertices over a grid of pitch 1, each square cut along either diagonal; seen from above.
template <class Height>
TriangleMesh sheet(std::uint32_t columns, std::uint32_t rows, Random& random, const Height& height) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i)
      mesh.vertices.push_back(vertex(i - 0.5 * columns, j - 0.5 * rows, height(i, j)));
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      const bool other = random() % 2 == 0;
      mesh.triangles.push_back(other ? mesh::Triangle{a, b, d} : mesh::Triangle{a, b, c});
      mesh.triangles.push_back(other ? mesh::Triangle{a, d, c} : mesh::Triangle{b, d, c});
    }
  return mesh;
}

// Two apexes and a ring: each apex has `sides` triangles. Every ray from the middle meets it once, whatever the radii are.
template <class Radius>
TriangleMesh double_cone(std::uint32_t sides, double apex, const Radius& radius) {
  TriangleMesh mesh;
  mesh.vertices = {vertex(0, 0, apex), vertex(0, 0, -apex)};
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides, r = radius(i);
    mesh.vertices.push_back(vertex(r * std::cos(angle), r * std::sin(angle), 0));
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

// An octahedron, each face cut into f² triangles, its vertices at radius(direction) from the middle: seen whole from there.
template <class Radius>
TriangleMesh star(int f, const Radius& radius) {
  TriangleMesh mesh;
  // Over a grid of |i| + |j| <= f, the upper and the lower half; the border is shared.
  const auto side = static_cast<std::uint32_t>(2 * f + 1);
  std::vector<std::uint32_t> number(std::size_t{2} * side * side, ~0U);
  const auto at = [&](int i, int j, int half) -> std::uint32_t {
    const int k = f - std::abs(i) - std::abs(j);
    const std::size_t slot = (static_cast<std::size_t>(k == 0 ? 0 : half) * side + static_cast<std::size_t>(j + f)) * side +
                             static_cast<std::size_t>(i + f);
    if (number[slot] == ~0U) {
      const double z = half == 0 ? k : -k, length = std::sqrt(1.0 * i * i + 1.0 * j * j + z * z), r = radius() / length;
      number[slot] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(vertex(r * i, r * j, r * z));
    }
    return number[slot];
  };
  for (int half = 0; half < 2; ++half)
    for (int j = -f; j < f; ++j)
      for (int i = -f; i < f; ++i) {
        // The square's two triangles, cut so that the border |i| + |j| = f is followed.
        const std::array<std::array<int, 2>, 4> corner{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
        const bool falls = (2 * i + 1 > 0) == (2 * j + 1 > 0);
        const std::array<std::array<int, 3>, 2> pieces = falls ? std::array<std::array<int, 3>, 2>{{{0, 1, 3}, {1, 2, 3}}}
                                                               : std::array<std::array<int, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}};
        for (const auto& piece : pieces) {
          bool is_inside = true;
          mesh::Triangle t{};
          for (std::size_t c = 0; c < 3; ++c) {
            const auto& [x, y] = corner[static_cast<std::size_t>(piece[c])];
            is_inside = is_inside && std::abs(x) + std::abs(y) <= f;
          }
          if (!is_inside) continue;
          for (std::size_t c = 0; c < 3; ++c) {
            const auto& [x, y] = corner[static_cast<std::size_t>(piece[c])];
            t[c] = at(x, y, half);
          }
          if (half == 1) std::swap(t[1], t[2]);
          mesh.triangles.push_back(t);
        }
      }
  return mesh;
}

// A second component: the first one moved and turned over.
void add_turned(TriangleMesh& mesh, double down) {
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  const TriangleMesh first = mesh;
  for (const mesh::Vertex& v : first.vertices)
    mesh.vertices.push_back({v[0], v[1], static_cast<float>(static_cast<double>(v[2]) - down)});
  for (const mesh::Triangle& t : first.triangles) mesh.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
}

using Vector = std::array<double, 3>;
Vector normal_of(const TriangleMesh& mesh, const mesh::Triangle& t) {
  const auto at = [&](std::size_t i, std::size_t axis) { return static_cast<double>(mesh.vertices[t[i]][axis]); };
  Vector u{}, v{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = at(1, axis) - at(0, axis);
    v[axis] = at(2, axis) - at(0, axis);
  }
  Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& component : n) component /= length;
  return n;
}

mesh::Normal rounded(const Vector& n) {
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {0, 0, 1};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
}

// Around most vertices the mean of the triangles' normals, around the others each triangle's own.
mesh::CornerNormals corner_normals(const TriangleMesh& mesh, Random& random) {
  std::vector<Vector> mean(mesh.vertices.size());
  std::vector<bool> is_sharp(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) is_sharp[v] = random() % 4 == 0;
  for (const mesh::Triangle& t : mesh.triangles) {
    const Vector n = normal_of(mesh, t);
    for (const std::uint32_t v : t)
      for (std::size_t axis = 0; axis < 3; ++axis) mean[v][axis] += n[axis];
  }
  mesh::CornerNormals normals;
  for (const mesh::Triangle& t : mesh.triangles) {
    normals.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) normals.back()[i] = rounded(is_sharp[t[i]] ? normal_of(mesh, t) : mean[t[i]]);
  }
  return normals;
}

}  // namespace

RandomMesh random_mesh(std::uint32_t seed) {
  Random random(seed);
  const auto size = [&](std::uint32_t low, std::uint32_t high) {
    return low + static_cast<std::uint32_t>(random() % (high - low + 1));
  };
  RandomMesh result;
  result.sides = mesh::Sides::both;
  switch (seed % kMeshFamilies) {
    case 0:
      result.name = "lattice sheet";
      result.mesh = sheet(size(2, 6), size(2, 6), random, [&](auto, auto) { return 0.25 * static_cast<double>(random() % 3); });
      break;
    case 1:
      result.name = "rough sheet";
      result.mesh = sheet(size(2, 7), size(2, 7), random, [&](auto, auto) { return uniform(random, -1, 1); });
      break;
    case 2: {
      result.name = "nearly flat sheet";
      const double reach = std::ldexp(1.0, -static_cast<int>(random() % 24));
      result.mesh = sheet(size(2, 7), size(2, 7), random, [&](auto, auto) { return uniform(random, -reach, reach); });
      break;
    }
    case 3:
      result.name = "thin double wall";
      result.mesh = sheet(size(2, 5), size(2, 5), random, [&](auto, auto) { return 0.5 * static_cast<double>(random() % 2); });
      add_turned(result.mesh, std::ldexp(1.0, -static_cast<int>(random() % 18)));
      break;
    case 4: {
      result.name = "double cone";
      const std::uint32_t sides = random() % 4 == 0 ? size(100, 200) : size(3, 12);
      const double apex = uniform(random, 0.05, 3);
      result.mesh = double_cone(sides, apex, [](auto) { return 1.0; });
      result.sides = random() % 2 == 0 ? mesh::Sides::front : mesh::Sides::both;
      break;
    }
    case 5: {
      result.name = "spiky double cone";
      const std::uint32_t sides = 2 * size(2, 12);
      const double apex = uniform(random, 0.2, 2);
      result.mesh = double_cone(sides, apex, [&](std::uint32_t i) { return i % 2 == 0 ? 1.0 : uniform(random, 0.1, 3); });
      result.sides = mesh::Sides::front;
      break;
    }
    case 6:
      result.name = "blunt star";
      result.mesh = star(static_cast<int>(size(1, 4)), [] { return 2.0; });
      result.sides = mesh::Sides::front;
      break;
    case 7: {
      // Flat enough that the god-object slides far in one tick.
      result.name = "long strip";
      const double reach = std::ldexp(1.0, -2 - static_cast<int>(random() % 8));
      result.mesh = sheet(size(20, 60), 4, random, [&](auto, auto) { return uniform(random, -reach, reach); });
      break;
    }
    default:
      result.name = "rough star";
      result.mesh = star(static_cast<int>(size(2, 4)), [&] { return uniform(random, 1, 2.5); });
      result.sides = random() % 2 == 0 ? mesh::Sides::front : mesh::Sides::both;
      break;
  }
  // Linear maps with powers of two keep a mesh embedded, and its numbers exact.
  const std::size_t squeezed = random() % 6;
  const double squeeze = std::ldexp(1.0, -static_cast<int>(random() % 10)),
               scale = std::ldexp(1.0, static_cast<int>(random() % 12) - 5);
  for (mesh::Vertex& v : result.mesh.vertices)
    for (std::size_t axis = 0; axis < 3; ++axis)
      v[axis] = static_cast<float>(static_cast<double>(v[axis]) * scale * (axis == squeezed ? squeeze : 1));
  result.normals = corner_normals(result.mesh, random);
  return result;
}

RandomPath::RandomPath(const RandomMesh& mesh, std::uint32_t seed) : mesh_(mesh), random_(seed) {}

std::array<float, 3> RandomPath::on_surface() {
  const mesh::Triangle& t = mesh_.mesh.triangles[below(mesh_.mesh.triangles.size())];
  std::array<double, 3> weight{1, 0, 0};
  switch (below(4)) {
    case 0: break;
    case 1: weight = {0.5, 0.5, 0}; break;
    case 2: weight = {0.25, 0.25, 0.5}; break;
    default:
      weight[1] = uniform(0, 1);
      weight[2] = uniform(0, 1 - weight[1]);
      weight[0] = 1 - weight[1] - weight[2];
      break;
  }
  std::array<float, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += weight[c] * static_cast<double>(mesh_.mesh.vertices[t[c]][axis]);
    place[axis] = static_cast<float>(sum);
  }
  return place;
}

std::array<float, 3> RandomPath::next() {
  const auto step = [&](double size) {
    for (float& coordinate : position_) coordinate = static_cast<float>(static_cast<double>(coordinate) + uniform(-size, size));
  };
  if (stroke_ > 0) {
    --stroke_;
    for (std::size_t axis = 0; axis < 3; ++axis) position_[axis] += direction_[axis];
    return position_;
  }
  switch (below(12)) {
    case 0: break;  // the same again
    case 1:
    case 2: step(std::pow(10.0, uniform(-9, 1))); break;
    case 3: position_ = on_surface(); break;
    case 4:
    case 5:
      position_ = on_surface();
      step(std::pow(10.0, uniform(-6, 0)));
      break;
    case 6: {
      position_ = on_surface();
      position_[below(3)] += static_cast<float>(uniform(-1, 1));
      break;
    }
    case 7:
    case 8: {
      const std::size_t axis = below(3);
      position_[axis] = mesh_.mesh.vertices[below(mesh_.mesh.vertices.size())][axis];
      break;
    }
    case 9: {
      const std::array<float, 3> to = on_surface();
      stroke_ = 1 + static_cast<int>(below(8));
      for (std::size_t axis = 0; axis < 3; ++axis)
        direction_[axis] = (to[axis] - position_[axis]) / static_cast<float>(stroke_ - below(2) * 0.5);
      break;
    }
    case 10:
      if (below(8) == 0) {
        std::array<float, 3> wrong = position_;
        constexpr std::array<float, 3> kWrong{std::numeric_limits<float>::quiet_NaN(), HUGE_VALF, -10001};
        wrong[below(3)] = kWrong[below(3)];
        return wrong;
      }
      step(std::pow(10.0, uniform(-3, 3)));
      break;
    default: {
      // Through the surface to about as far behind it.
      const std::array<float, 3> through = on_surface();
      for (std::size_t axis = 0; axis < 3; ++axis) position_[axis] = 2 * through[axis] - position_[axis];
      break;
    }
  }
  for (float& coordinate : position_)
    if (std::fabs(coordinate) > 1e4F) coordinate = 0;
  return position_;
}

}  // namespace forceshade::tests
