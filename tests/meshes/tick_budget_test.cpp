// SPDX-License-Identifier: BSD-3-Clause
// A tick that has looked at 2^14 triangles begins no move: on both sides at the same one, whatever either side has looked at
// beside those that the definition counts.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "fast/domain.h"
#include "forceshade/reference.h"
#include "reference/meshes/crossings.h"
#include "tests/meshes/both_sides.h"
#include "tests/meshes/costly_meshes.h"

namespace forceshade {
namespace {

using mesh::Sides;
using Position = std::array<float, 3>;

constexpr int kMostLooks = 16384;

// A plain run takes smaller meshes of the same families.
bool is_whole() {
  return tests::drawn(4) >= 4;
}

// Triangles that touch nothing, on a coarse grid, so that ways meet borders of boxes, or anywhere.
mesh::TriangleMesh scattered(std::mt19937_64& random, bool is_on_grid, int count) {
  mesh::TriangleMesh mesh;
  std::uniform_real_distribution<float> uniform(-8, 8);
  const auto coordinate = [&] { return is_on_grid ? static_cast<float>(static_cast<int>(random() % 9) - 4) : uniform(random); };
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back({coordinate(), coordinate(), coordinate()});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(tick_budget, both_sides_count_the_same_boxes_on_a_way) {
  std::mt19937_64 random(7);
  std::size_t met = 0, meshes = 0, cut = 0;
  for (int round = 0; meshes < 400; ++round) {
    ASSERT_LT(round, 10000);
    const bool is_on_grid = round % 2 == 0;
    auto checked = mesh::check(scattered(random, is_on_grid, is_on_grid ? 3 : 4));
    if (!std::holds_alternative<mesh::CheckedMesh>(checked)) continue;
    ++meshes;
    const MeshRendering rendering{std::get<mesh::CheckedMesh>(checked), {}, Sides::both, mesh::Shading::none, 1, {}};
    const fast::Mesh mesh = tests::fast_mesh(rendering);
    const reference::meshes::Surface surface(rendering.mesh());
    const reference::meshes::Crossings crossings(surface);
    for (int way = 0; way < 20; ++way) {
      auto ends = scattered(random, is_on_grid || way % 2 == 0, 1).vertices;
      for (mesh::Vertex& end : ends)  // so that ways go past borders of boxes so near that integers decide
        for (float& coordinate : end)
          if (coordinate == 0 && random() % 2 == 0) coordinate = random() % 2 == 0 ? 0x1p-30F : -0x1p-30F;
      if (ends[0] == ends[1]) continue;
      const auto index = static_cast<std::uint32_t>(random() % rendering.mesh().triangles.size());
      const std::uint32_t k = 1 + static_cast<std::uint32_t>(random() % (1U << 23)),
                          l = 1 + static_cast<std::uint32_t>(random() % (1U << 22));
      const bool is_free = way % 3 == 0;
      const fast::GridPoint grid_point =
          is_free ? fast::GridPoint{} : fast::grid_point_in_triangle(mesh, mesh.face_of_file(index), k, l, {});
      const fast::Point g = is_free ? fast::Point::at(ends[0].data()) : fast::point_of(mesh, grid_point);
      const reference::meshes::Vector from =
          is_free ? reference::meshes::exact_point(ends[0]) : surface.position(surface.in_triangle(index, k, l));
      const std::int64_t all = 1 + static_cast<std::int64_t>(random() % 8), left = static_cast<std::int64_t>(random()) % all;
      const std::int64_t not_gone = left < 0 ? -left : left;
      cut += not_gone > 0;
      const auto about = [&](std::size_t axis) {
        double sum = 0;
        for (std::size_t c = 0; c < static_cast<std::size_t>(g.count); ++c)
          sum += static_cast<double>(g.weight[c]) * static_cast<double>(g.corner[c][axis]);
        return 0x1p-24 * sum;
      };
      const Position& p = ends[1];
      const fast::Looks looks(g, p.data(), fast::Looks::Part(not_gone), fast::Looks::Part(all),
                              {static_cast<double>(not_gone) / static_cast<double>(all), way % 5 == 0 ? HUGE_VAL : 0x1p-50},
                              {about(0), about(1), about(2)},
                              {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
      const std::size_t expected = crossings.looks(from, reference::meshes::exact_point(p), {all - not_gone, all});
      ASSERT_EQ(looks.count(mesh, std::numeric_limits<int>::max()), static_cast<int>(expected)) << round << ", way " << way;
      ASSERT_EQ(looks.count(mesh, 1), expected > 0 ? 1 : 0);
      met += expected;
    }
  }
  std::printf("  %zu meshes, %zu boxes on ways, %zu ways that stop before their end\n", meshes, met, cut);
  EXPECT_GT(met, 1000U);
  EXPECT_GT(cut, 1000U);
}

// The same path on both sides, and in integers alone. How many ticks are unfinished.
std::size_t compare(const tests::CostlyMesh& one, int repeats) {
  const MeshRendering rendering{tests::checked(one.mesh), {}, one.sides, mesh::Shading::none, 1, {}};
  tests::BothSides both(rendering);
  std::size_t unfinished = 0;
  for (const Position& p : one.positions)
    for (int i = 0; i < repeats; ++i) {
      const mesh::Tick tick = both.step(p, one.family);
      unfinished += tick.status == Status::unfinished && tick.moves < 256;
    }
  return unfinished;
}

// A hand that goes through all needles: two moves a needle, and each flight looks at every one.
tests::CostlyMesh pierced_needles(std::uint32_t n) {
  tests::CostlyMesh made = tests::needles(n);
  made.positions = {{280.131F, 279.697F, 279.703F}, {-461.192F, -384.264F, -464.904F}, {-461.192F, -384.264F, -464.904F}};
  return made;
}

// The first flight goes between small triangles above and below it, at which the code looks, and which do not count: with them
// the tick would end at another vertex.
tests::CostlyMesh long_valley() {
  tests::CostlyMesh made = tests::valley(257, 36);
  made.positions = {{-100, -0.00436F, 0.44424F}, {230, 0.01F, -1}, {230, 0.01F, -1}};
  for (int i = 0; i < 320; ++i) {
    const double x = -90 + 0.25 * i, z = 0.0055 - 0.0043765 * (x - 0.25) + (i % 2 == 0 ? 0.1 : -0.1);
    const std::uint32_t first = tests::add_vertex(made.mesh, x, -0.006, z);
    tests::add_vertex(made.mesh, x + 0.01, -0.006, z);
    tests::add_vertex(made.mesh, x, 0.002, z);
    made.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

TEST(tick_budget, ends_the_same_ticks_on_both_sides) {
  EXPECT_GT(compare(pierced_needles(30), 1), 0U);
  EXPECT_GT(compare(long_valley(), 1), 0U);
  EXPECT_EQ(compare(pierced_needles(12), 1), 0U);
  EXPECT_EQ(compare(tests::needles(30, {1, 0.5, 0.25}), 1), 0U);
  EXPECT_EQ(compare(tests::needles(is_whole() ? 40 : 20), 1), 0U);
  EXPECT_EQ(compare(tests::valley(20, 30), 1), 0U);
  EXPECT_EQ(compare(tests::pole(is_whole() ? 1000 : 300, 1e-6), 2), 0U);
  EXPECT_EQ(compare(tests::layers(is_whole() ? 2000 : 500, Sides::both), 2), 0U);
  if (!is_whole()) return;
  EXPECT_GT(compare(tests::needles(90), 1), 0U);
  EXPECT_GT(compare(tests::valley(140, 100), 2), 0U);
}

// Sheets of one triangle each, met from behind, below one that is met from in front: each box is looked at once.
TEST(tick_budget, is_two_to_the_fourteenth_triangles) {
  for (const int below : {kMostLooks - 2, kMostLooks - 1}) {
    tests::CostlyMesh one{"", {}, Sides::front, {{1, 1, -5}, {2, 1.5F, 20}, {2, 1.5F, 20}}};
    for (int i = 0; i <= below; ++i) {
      const std::uint32_t k = tests::add_vertex(one.mesh, 0, 0, i / 1024.0);
      tests::add_vertex(one.mesh, 9, 0, i / 1024.0);
      tests::add_vertex(one.mesh, 0, 9, i / 1024.0);
      one.mesh.triangles.push_back(i < below ? mesh::Triangle{k, k + 1, k + 2} : mesh::Triangle{k, k + 2, k + 1});
    }
    tests::BothSides both(tests::unshaded(one.mesh, one.sides));
    std::vector<mesh::Tick> ticks;
    for (const Position& p : one.positions) ticks.push_back(both.step(p));
    const bool is_over = below + 1 == kMostLooks;
    EXPECT_EQ(ticks[1].status, is_over ? Status::unfinished : Status::contact);
    EXPECT_EQ(ticks[1].moves, is_over ? 1 : 2);
    EXPECT_EQ(ticks[2].status, Status::contact) << "the next tick goes on";
  }
}

// Each triangle at a vertex meets a flight through it, and to find how the vertex lies to it looks at each of them.
TEST(tick_budget, a_tick_at_a_vertex_of_many_triangles_decides_on_each_of_them_but_a_few_times) {
  constexpr std::uint32_t kTriangles = 200;
  const tests::CostlyMesh one = tests::pole(kTriangles, 5);
  for (const Sides sides : {Sides::front, Sides::both})
    for (const float from : {3.0F, -3.0F}) {
      tests::BothSides both(tests::unshaded(one.mesh, sides));
      for (const Position& p : {Position{0, 0, from}, {0, 0, -from}, {0, 0, 0}, {0.3F, 0.1F, from}, {0.1F, -0.2F, -from}}) {
        both.step(p);
        EXPECT_LE(both.decisions()[0] + both.decisions()[1], 12 * kTriangles);
      }
    }
}

// The work of one tick: looks and moves, each of which looks at a triangle or two more.
struct Cost {
  int looks = 0, moves = 0;
  double microseconds = 0;

  int operations() const { return looks + moves; }
};

Cost cost_of(const fast::Mesh& mesh, fast::Arrival& at, const Position& p) {
  mesh::Tick tick;
  const auto start = std::chrono::steady_clock::now();
  fast::arrive(mesh, at, fast::quantised(p), 1, mesh::Shading::none, fast::FilteredStages(), tick);
  return {at.looks, at.moves, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count()};
}

// From where a path has led, whatever position costs more operations, then from there on.
TEST(tick_budget, holds_for_the_worst_ticks_that_a_search_finds) {
  std::vector<tests::CostlyMesh> meshes{tests::needles(20),
                                        pierced_needles(30),
                                        tests::needles(30, {1, 0.5, 0.25}),
                                        tests::valley(257, 14),
                                        long_valley(),
                                        tests::layers(8200, Sides::front),
                                        tests::layers(1000, Sides::both),
                                        tests::jacks(300),
                                        tests::pole(1000, 1e-6)};
  if (is_whole()) {
    for (const std::uint32_t n : {50U, 150U}) meshes.push_back(tests::needles(n));
    meshes.push_back(tests::needles(150, {1, 0.5, 0.25}));
    for (const std::uint32_t hubs : {20U, 257U}) meshes.push_back(tests::valley(hubs, 490));
    for (const Sides sides : {Sides::front, Sides::both}) meshes.push_back(tests::layers(10000, sides));
    for (const std::uint32_t n : {1000U, 4000U}) meshes.push_back(tests::pole(n, 5));
    meshes.push_back(tests::jacks(3000));
  }
  const std::size_t steps = tests::drawn(400);
  for (const tests::CostlyMesh& one : meshes) {
    const fast::Mesh mesh = tests::fast_mesh(tests::unshaded(one.mesh, one.sides));
    std::mt19937_64 random(3);
    fast::Arrival at, before_worst;
    Position worst_position{};
    Cost worst;
    for (std::size_t step = 0; step < steps; ++step) {
      const Position p = drawn_position(one, step, worst_position, random);
      const bool is_from_worst = step >= 2 * one.positions.size() && random() % 2 == 0;
      fast::Arrival next = is_from_worst ? before_worst : at;
      const fast::Arrival before = next;
      const Cost cost = cost_of(mesh, next, p);
      at = next;
      EXPECT_LE(cost.looks, kMostLooks - 1 + static_cast<int>(one.mesh.triangles.size())) << one.family;
      EXPECT_LE(cost.moves, 256);
      if (cost.operations() <= worst.operations()) continue;
      worst = cost;
      before_worst = before;
      worst_position = p;
    }
    for (int pass = 0; pass < 20; ++pass) {  // other programs interrupt some
      fast::Arrival again = before_worst;
      worst.microseconds = std::min(worst.microseconds, cost_of(mesh, again, worst_position).microseconds);
    }
    std::printf("  | %s | %zu | %d | %d | %.0f |\n", one.family, one.mesh.triangles.size(), worst.looks, worst.moves,
                worst.microseconds);
    std::fflush(stdout);  // a long search shows what it has found so far
    EXPECT_GT(worst.looks, 0) << one.family;
  }
}

}  // namespace
}  // namespace forceshade
