// SPDX-License-Identifier: BSD-3-Clause
#include "tests/meshes/hard_crossings.h"

#include <utility>

namespace forceshade::tests {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;

Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
}  // namespace

Place normalised(const Place& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

Place HardDraws::direction() {
  for (;;) {
    const Place v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (square < 0.01 || square > 1) continue;
    return normalised(v);
  }
}

std::array<Place, 2> across(HardDraws& random, const Place& along) {
  const Place first = normalised(cross(along, random.direction()));
  return {first, cross(along, first)};
}

std::array<float, 3> at(const Place& middle, const Place& u, double a, const Place& v, double b, const Place& w, double c) {
  std::array<float, 3> place{};
  for (std::size_t i = 0; i < 3; ++i) place[i] = static_cast<float>(middle[i] + a * u[i] + b * v[i] + c * w[i]);
  return place;
}

void add_box(TriangleMesh& mesh, const Place& middle, const Place& u, double a, const Place& v, double b, const Place& w,
             double c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) mesh.vertices.push_back(at(middle, u, i & 4 ? a : -a, v, i & 2 ? b : -b, w, i & 1 ? c : -c));
  for (const auto& [i, j, k] : {std::array{0U, 1U, 3U},
                                {0U, 3U, 2U},
                                {4U, 6U, 7U},
                                {4U, 7U, 5U},
                                {0U, 4U, 5U},
                                {0U, 5U, 1U},
                                {2U, 3U, 7U},
                                {2U, 7U, 6U},
                                {0U, 2U, 6U},
                                {0U, 6U, 4U},
                                {1U, 5U, 7U},
                                {1U, 7U, 3U}})
    mesh.triangles.push_back({first + i, first + j, first + k});
}
void add_cube(TriangleMesh& mesh) {
  add_box(mesh, {0, 0, 0}, {1, 0, 0}, 5, {0, 1, 0}, 5, {0, 0, 1}, 5);
}
namespace {

void add_needle(TriangleMesh& mesh, HardDraws& random) {
  const Place along = random.direction();
  const auto [u, v] = across(random, along);
  const Place middle{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
  add_box(mesh, middle, u, random.size(1e-5, 1), v, random.size(1e-5, 1), along, random.size(3, 30));
}
void add_plate(TriangleMesh& mesh, HardDraws& random, const Place& middle, const Place& normal) {
  const auto [u, v] = across(random, normal);
  const double a = random.size(2, 20), b = random.size(2, 20);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Place none{};
  for (const auto& [x, y] : {std::array{-a, -b}, std::array{a, -b}, std::array{a, b}, std::array{-a, b}})
    mesh.vertices.push_back(at(middle, u, x, v, y, none, 0));
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}
// Open, its apex pointing along `up`.
void add_pyramid(TriangleMesh& mesh, HardDraws& random, const Place& apex, const Place& up) {
  const auto [u, v] = across(random, up);
  const auto n = static_cast<std::uint32_t>(3 + random.below(10));
  const double radius = random.size(0.01, 5), height = random.size(1, 8);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(at(apex, u, 0, v, 0, up, 0));
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    mesh.vertices.push_back(at(apex, u, radius * std::cos(angle), v, radius * std::sin(angle), up, -height));
  }
  for (std::uint32_t i = 0; i < n; ++i) mesh.triangles.push_back({first, first + 1 + i, first + 1 + (i + 1) % n});
}
Place tilted(HardDraws& random, const Place& normal) {
  const Place off = random.direction();
  const double angle = random.size(1e-6, 1);
  return normalised({normal[0] + angle * off[0], normal[1] + angle * off[1], normal[2] + angle * off[2]});
}

TriangleMesh drawn(std::size_t family, HardDraws& random) {
  TriangleMesh mesh;
  const Place middle{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
  const Place normal = random.direction();
  switch (family) {
    case 0:
    case 1:
      add_cube(mesh);
      for (std::size_t i = 0; i <= family; ++i) add_needle(mesh, random);
      break;
    case 2:
      add_plate(mesh, random, middle, normal);
      for (std::size_t i = 0; i < 1 + random.below(3); ++i) add_plate(mesh, random, middle, tilted(random, normal));
      break;
    case 3:
      for (std::size_t i = 0; i < 3 + random.below(3); ++i) add_plate(mesh, random, middle, random.direction());
      break;
    case 4: {
      const Place off = random.direction();
      const double by = random.size(1e-6, 1);
      add_pyramid(mesh, random, middle, normal);
      add_pyramid(mesh, random, {middle[0] + by * off[0], middle[1] + by * off[1], middle[2] + by * off[2]},
                  tilted(random, normal));
      break;
    }
    default:
      add_plate(mesh, random, middle, normal);
      add_plate(mesh, random, middle, tilted(random, normal));
      add_needle(mesh, random);
  }
  return mesh;
}

// A free position, and others near a triangle, mostly not far from each other.
void draw_positions(HardCase& one, HardDraws& random) {
  one.positions[0] = {50, 60, 70};
  const auto near_triangle = [&] {
    const mesh::Triangle& triangle = one.mesh.triangles[random.below(one.mesh.triangles.size())];
    double a = random.uniform(0, 1), b = random.uniform(0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const Place off = random.direction();
    const double by = random.size(1e-6, 3);
    std::array<float, 3> place{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto corner = [&](std::size_t c) { return static_cast<double>(one.mesh.vertices[triangle[c]][i]); };
      place[i] = static_cast<float>(corner(0) + a * (corner(1) - corner(0)) + b * (corner(2) - corner(0)) + by * off[i]);
    }
    return place;
  };
  for (std::size_t i = 1; i < kHardPositions; ++i) {
    one.positions[i] = near_triangle();
    if (i == 1 || random.below(3) == 0) continue;
    const Place off = random.direction();
    const double by = random.size(1e-6, 3);
    for (std::size_t axis = 0; axis < 3; ++axis)
      one.positions[i][axis] = one.positions[i - 1][axis] + static_cast<float>(by * off[axis]);
  }
}

}  // namespace

HardCase drawn_hard_case(std::size_t family, HardDraws& random) {
  HardCase one;
  one.mesh = drawn(family, random);
  draw_positions(one, random);
  return one;
}

HardCase nudged(HardCase one, HardDraws& random) {
  const auto nudge = [&](float& coordinate) {
    coordinate += static_cast<float>(random.size(1e-8, 1) * (random.below(2) == 0 ? 1 : -1));
  };
  switch (random.below(8)) {
    case 0: draw_positions(one, random); break;
    case 1: nudge(one.mesh.vertices[random.below(one.mesh.vertices.size())][random.below(3)]); break;
    case 2: one.sides = one.sides == Sides::front ? Sides::both : Sides::front; break;
    default:
      for (std::size_t i = 0; i < 1 + random.below(3); ++i)
        nudge(one.positions[1 + random.below(kHardPositions - 1)][random.below(3)]);
  }
  return one;
}

}  // namespace forceshade::tests
