// SPDX-License-Identifier: BSD-3-Clause
// Looks for meshes and positions at which a tick among crossing sheets takes many operations: hill climbing on vertices and
// positions, from needles through a cube, plates that meet at a tiny angle, and the like. FORCESHADE_CROSSING_SEARCH=STEPS climbs
// for longer.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "forceshade/fast/meshes/god_object.h"
#include "forceshade/meshes/check.h"
#include "forceshade/properties/positions.h"
#include "forceshade/reference/meshes/god_object.h"
#include "forceshade/tests/meshes/god_object_paths.h"

namespace forceshade {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;
using Place = std::array<double, 3>;  // mm

constexpr float kStiffness = 0.3F;  // N/mm
constexpr std::array<const char*, 6> kFamilies{"a needle through a cube",     "two needles through a cube", "plates at a tiny angle",
                                               "three plates through a point", "two pyramids",               "plates and a needle"};
constexpr std::size_t kPositions = 4;

// How many decisions a tick makes.
struct Counted {
  static constexpr bool kFilter = true;
  std::size_t* in_binary64;
  std::size_t* in_integers;
  bool sure(bool is_proved) const noexcept {
    *in_binary64 += is_proved;
    return is_proved;
  }
  void note(fast::Stage) const noexcept { ++*in_integers; }
};

struct Cost {
  std::size_t operations = 0, in_binary64 = 0, in_integers = 0;
  int tries = 0, moves = 0;
  bool is_unfinished = false;
  double microseconds = 0;
};

struct Case {
  TriangleMesh mesh;
  Sides sides = Sides::front;
  std::array<std::array<float, 3>, kPositions> positions{};
};

class Random : public properties::Draws {
 public:
  explicit Random(std::uint64_t seed) : Draws(seed) {}
  // Every decade as likely.
  double size(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Place direction() {
    for (;;) {
      const Place v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if (square < 0.01 || square > 1) continue;
      const double length = std::sqrt(square);
      return {v[0] / length, v[1] / length, v[2] / length};
    }
  }
  std::size_t below(std::size_t count) { return bits() % count; }
};

Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Place normalised(const Place& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

// Two directions at a right angle to it and to each other.
std::array<Place, 2> across(Random& random, const Place& along) {
  const Place first = normalised(cross(along, random.direction()));
  return {first, cross(along, first)};
}

// The point middle + a u + b v + c w.
std::array<float, 3> at(const Place& middle, const Place& u, double a, const Place& v, double b, const Place& w, double c) {
  std::array<float, 3> place{};
  for (std::size_t i = 0; i < 3; ++i) place[i] = static_cast<float>(middle[i] + a * u[i] + b * v[i] + c * w[i]);
  return place;
}

// The half sides of a box along u, v, w; u, v, w right-handed.
void add_box(TriangleMesh& mesh, const Place& middle, const Place& u, double a, const Place& v, double b, const Place& w, double c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(at(middle, u, i & 4 ? a : -a, v, i & 2 ? b : -b, w, i & 1 ? c : -c));
  for (const auto& [i, j, k] : {std::array{0U, 1U, 3U}, {0U, 3U, 2U}, {4U, 6U, 7U}, {4U, 7U, 5U}, {0U, 4U, 5U}, {0U, 5U, 1U},
                                {2U, 3U, 7U}, {2U, 7U, 6U}, {0U, 2U, 6U}, {0U, 6U, 4U}, {1U, 5U, 7U}, {1U, 7U, 3U}})
    mesh.triangles.push_back({first + i, first + j, first + k});
}
void add_cube(TriangleMesh& mesh) {
  add_box(mesh, {0, 0, 0}, {1, 0, 0}, 5, {0, 1, 0}, 5, {0, 0, 1}, 5);
}
void add_needle(TriangleMesh& mesh, Random& random) {
  const Place along = random.direction();
  const auto [u, v] = across(random, along);
  const Place middle{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
  add_box(mesh, middle, u, random.size(1e-5, 1), v, random.size(1e-5, 1), along, random.size(3, 30));
}
void add_plate(TriangleMesh& mesh, Random& random, const Place& middle, const Place& normal) {
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
void add_pyramid(TriangleMesh& mesh, Random& random, const Place& apex, const Place& up) {
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
Place tilted(Random& random, const Place& normal) {
  const Place off = random.direction();
  const double angle = random.size(1e-6, 1);
  return normalised({normal[0] + angle * off[0], normal[1] + angle * off[1], normal[2] + angle * off[2]});
}

TriangleMesh drawn(std::size_t family, Random& random) {
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
      add_pyramid(mesh, random, {middle[0] + by * off[0], middle[1] + by * off[1], middle[2] + by * off[2]}, random.direction());
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
void draw_positions(Case& one, Random& random) {
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
  for (std::size_t i = 1; i < kPositions; ++i) {
    one.positions[i] = near_triangle();
    if (i == 1 || random.below(3) == 0) continue;
    const Place off = random.direction();
    const double by = random.size(1e-6, 3);
    for (std::size_t axis = 0; axis < 3; ++axis)
      one.positions[i][axis] = one.positions[i - 1][axis] + static_cast<float>(by * off[axis]);
  }
}

Case nudged(Case one, Random& random) {
  const auto nudge = [&](float& coordinate) {
    coordinate += static_cast<float>(random.size(1e-8, 1) * (random.below(2) == 0 ? 1 : -1));
  };
  switch (random.below(8)) {
    case 0: draw_positions(one, random); break;
    case 1: nudge(one.mesh.vertices[random.below(one.mesh.vertices.size())][random.below(3)]); break;
    case 2: one.sides = one.sides == Sides::front ? Sides::both : Sides::front; break;
    default:
      for (std::size_t i = 0; i < 1 + random.below(3); ++i) nudge(one.positions[1 + random.below(kPositions - 1)][random.below(3)]);
  }
  return one;
}

std::optional<fast::Mesh> built(const Case& one) {
  if (!std::holds_alternative<mesh::CheckedMesh>(mesh::check(one.mesh, mesh::SelfIntersections::allowed))) return std::nullopt;
  auto mesh = fast::Mesh::build(one.mesh, {}, one.sides, {}, mesh::SelfIntersections::allowed);
  if (!std::holds_alternative<fast::Mesh>(mesh)) return std::nullopt;
  return std::get<fast::Mesh>(std::move(mesh));
}

// Of the tick that takes the most operations.
Cost cost_of(const fast::Mesh& mesh, const Case& one) {
  fast::Arrival at;
  Cost worst;
  for (const std::array<float, 3>& p : one.positions) {
    Cost cost;
    mesh::Tick tick;
    const auto start = std::chrono::steady_clock::now();
    fast::step(mesh, at, p, kStiffness, mesh::Shading::none, Counted{&cost.in_binary64, &cost.in_integers}, tick);
    cost.microseconds = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    cost.tries = at.tries;
    cost.moves = at.moves;
    cost.is_unfinished = !at.is_finished;
    cost.operations = cost.in_binary64 + 20 * cost.in_integers + 20 * static_cast<std::size_t>(cost.tries);
    if (cost.operations > worst.operations) worst = cost;
  }
  return worst;
}

std::size_t steps_of_the_search() {
  const char* given = std::getenv("FORCESHADE_CROSSING_SEARCH");
  return given == nullptr ? 3000 : std::strtoull(given, nullptr, 10);
}

TEST(crossing_search, no_tick_takes_more_tries_than_it_may) {
  const std::size_t steps = steps_of_the_search();
  for (std::size_t family = 0; family < kFamilies.size(); ++family) {
    Cost worst;
    Case worst_case;
    std::size_t unfinished = 0, meshes = 0;
    for (std::uint64_t climb = 0; climb * 100 < steps; ++climb) {
      Random random(1000 * family + climb);
      Case one;
      Cost cost;
      for (std::size_t step = 0, idle = 0; step < 300 && idle < 60; ++step, ++idle) {
        Case next = one;
        if (one.mesh.triangles.empty()) {
          next.mesh = drawn(family, random);
          draw_positions(next, random);
        } else {
          next = nudged(std::move(next), random);
        }
        const auto mesh = built(next);
        if (!mesh) continue;
        ++meshes;
        const Cost found = cost_of(*mesh, next);
        unfinished += found.is_unfinished;
        if (found.operations < cost.operations) continue;
        if (found.operations > cost.operations) idle = 0;
        cost = found;
        one = std::move(next);
      }
      if (cost.operations > worst.operations) worst = cost, worst_case = one;
    }
    std::printf("  %-30s %zu meshes, %zu unfinished; at worst %zu operations (%d tries, %d moves, %zu in binary64, %zu in integers, %s), %.1f us\n",
                kFamilies[family], meshes, unfinished, worst.operations, worst.tries, worst.moves, worst.in_binary64,
                worst.in_integers, worst.is_unfinished ? "unfinished" : "finished", worst.microseconds);
  }
}

}  // namespace
}  // namespace forceshade
