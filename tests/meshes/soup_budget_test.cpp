// SPDX-License-Identifier: BSD-3-Clause
// The work of a tick on any set of triangles is bounded: both sides end the same ticks unfinished, and a search looks for the
// ticks that look at most triangles, of which it prints a table of docs/tables/soups.csv.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <random>
#include <vector>

#include "fast/soups/session.h"
#include "reference/soups/tick.h"
#include "tests/meshes/costly_meshes.h"
#include "tests/meshes/uncut.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

using mesh::Sides;
using tests::CostlyMesh;
using Position = std::array<float, 3>;

constexpr std::uint32_t kMostLooks = 16384;

// A plain run takes smaller sets.
bool is_whole() {
  return tests::drawn(4) >= 4;
}

// Pages of 10 by 16 mm on one spine, each of two triangles.
CostlyMesh book(std::uint32_t pages) {
  CostlyMesh made{
      "a book", {}, Sides::both, {{5, 1, 0}, {0.01F, 0.0001F, 0.5F}, {-5, -1, 0.5F}, {0, 0, 9}, {0, 0, 1}, {1, 0.2F, 9}}};
  const std::uint32_t low = tests::add_vertex(made.mesh, 0, 0, -8), high = tests::add_vertex(made.mesh, 0, 0, 8);
  for (std::uint32_t k = 0; k < pages; ++k) {
    const double angle = 2 * 3.14159265358979 * k / pages;
    const std::uint32_t first = tests::add_vertex(made.mesh, 10 * std::cos(angle), 10 * std::sin(angle), -8);
    tests::add_vertex(made.mesh, 10 * std::cos(angle), 10 * std::sin(angle), 8);
    made.mesh.triangles.push_back({low, first, high});
    made.mesh.triangles.push_back({first, first + 1, high});
  }
  return made;
}

void add_bar(mesh::TriangleMesh& mesh, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i)
    tests::add_vertex(mesh, (i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]);
  constexpr std::uint32_t kFaces[][3]{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& [a, b, c] : kFaces) mesh.triangles.push_back({first + a, first + b, first + c});
}

// n bars along x and as many along y, which go through each other: a hand is led along their tops from one to the next.
CostlyMesh bars(std::uint32_t n) {
  CostlyMesh made{"a grid of crossing bars", {}, Sides::front, {}};
  const double end = n / 4.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double at = i / 4.0;
    add_bar(made.mesh, {at, -1, -0.125}, {at + 0.125, end, 0.125});
    add_bar(made.mesh, {-1, at, -0.0625}, {end, at + 0.125, 0.0625});
  }
  const auto f = [](double x) { return static_cast<float>(x); };
  made.positions = {{f(end / 2), f(end / 2), 1}, {f(end / 2), f(end / 2 + 0.07), 0},      {f(end - 0.3), f(end - 0.7), -0.01F},
                    {0.3F, 0.2F, 0.05F},         {f(end / 2 + 0.07), f(end / 3), -0.06F}, {f(end), 0, -3}};
  return made;
}

// As many coincident triangles as `sheets`, which fins go through: along them a hand meets a fin, twice, with all the sheets.
CostlyMesh fins(std::uint32_t sheets, std::uint32_t count) {
  CostlyMesh made{"coincident sheets with fins below", {}, Sides::front, {}};
  const std::uint32_t a = tests::add_vertex(made.mesh, -1, -40, 0);
  tests::add_vertex(made.mesh, 80, 0, 0);
  tests::add_vertex(made.mesh, -1, 40, 0);
  for (std::uint32_t i = 0; i < sheets; ++i) made.mesh.triangles.push_back({a, a + 1, a + 2});
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = 1 + 30.0 * i / count;
    const std::uint32_t first = tests::add_vertex(made.mesh, x, -1, 0);
    tests::add_vertex(made.mesh, x, 1, 0);
    tests::add_vertex(made.mesh, x, 0, -1);
    made.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  made.positions = {{0.25F, 0, 1},        {0.25F, 0, -0.5F},  {40, 0.125F, -0.25F},
                    {40, 0.125F, -0.25F}, {1.25F, 0, -0.25F}, {1.25F, 0, 3}};
  return made;
}

// Triangles in n planes through one point, in general position.
CostlyMesh planes(std::uint32_t n) {
  CostlyMesh made{"planes through one point", {}, Sides::both, {{20, 21, 22}, {0, 0, 0}, {-20, -19, -22}, {0.01F, 0, 0}}};
  std::mt19937 random(1);
  const auto draw = [&] { return (static_cast<int>(random() % 2001) - 1000) / 64.0; };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::array<double, 3> a{draw(), draw(), draw()}, b{draw(), draw(), draw()};
    const std::uint32_t first = tests::add_vertex(made.mesh, a[0], a[1], a[2]);
    tests::add_vertex(made.mesh, b[0], b[1], b[2]);
    tests::add_vertex(made.mesh, -a[0] - b[0], -a[1] - b[1], -a[2] - b[2]);
    made.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

// The ticks that are unfinished; both sides have the same.
std::vector<Status> statuses(const CostlyMesh& one) {
  const auto soup = std::make_shared<const fast::soups::Soup>(one.mesh, std::vector{one.sides});
  const reference::soups::Soup exact(one.mesh, {one.sides});
  fast::soups::Session session(soup, 1, false);
  reference::soups::State state;
  std::vector<Status> all;
  for (const Position& p : one.positions) {
    const fast::soups::Tick tick = session.tick(p);
    const reference::soups::Tick expected = reference::soups::tick(exact, state, p);
    state = expected.after;
    EXPECT_EQ(tick.status, expected.status) << one.family;
    EXPECT_EQ(tick.moves, expected.moves) << one.family;
    EXPECT_EQ(session.looks(), expected.looks) << one.family;
    all.push_back(tick.status);
  }
  return all;
}
std::size_t unfinished(const CostlyMesh& one) {
  return static_cast<std::size_t>(std::ranges::count(statuses(one), Status::unfinished));
}

TEST(soup_budget, ends_the_same_ticks_on_both_sides) {
  EXPECT_EQ(unfinished(book(20)), 0U);
  EXPECT_EQ(unfinished(bars(10)), 0U);
  EXPECT_EQ(unfinished(fins(20, 20)), 0U);
  EXPECT_GT(unfinished(fins(200, 100)), 0U);
  EXPECT_EQ(unfinished(planes(12)), 0U);
  CostlyMesh needles = tests::needles(30);
  EXPECT_EQ(unfinished(needles), 0U);
  // Through all of them, of which each way looks at every one.
  needles.positions = {{280.131F, 279.697F, 279.703F}, {-461.192F, -384.264F, -464.904F}};
  EXPECT_EQ(unfinished(needles), 1U);
}

// A point in more triangles is not entered, neither by the first position nor by a flight, which also looks at the rounded
// point. A hand that comes back is free again.
TEST(soup_budget, no_point_of_more_than_two_to_the_fourteenth_looks_is_entered) {
  for (const std::uint32_t count : {kMostLooks, kMostLooks + 1}) {
    CostlyMesh one = fins(count, 0);
    one.positions = {{0.25F, 0, 0}, {0.25F, 0, 1}};
    EXPECT_EQ(statuses(one), (std::vector{count > kMostLooks ? Status::unfinished : Status::contact, Status::free}));
  }
  for (const std::uint32_t count : {4000U, kMostLooks / 2 + 1}) {
    CostlyMesh one = fins(count, 0);
    one.positions = {{0.25F, 0, 1}, {0.25F, 0, -0.5F}, {0.25F, 0, 2}};
    EXPECT_EQ(statuses(one), (std::vector{Status::free, count > 4000 ? Status::unfinished : Status::contact, Status::free}));
  }
}

// The way has looked at all of them, and the point that is not entered counts them again.
TEST(soup_budget, a_tick_may_look_at_twice_the_triangles) {
  constexpr std::uint32_t kCount = 5 * kMostLooks + 1;
  CostlyMesh one = fins(kCount, 0);
  one.positions = {{0.25F, 0, 1}, {0.25F, 0, -0.5F}};
  EXPECT_EQ(statuses(one), (std::vector{Status::free, Status::unfinished}));
  fast::soups::Session session(std::make_shared<const fast::soups::Soup>(one.mesh, std::vector{one.sides}), 1, false);
  for (const Position& p : one.positions) session.tick(p);
  EXPECT_EQ(session.looks(), 2 * kCount);
}

struct Cost {
  std::size_t looks = 0, boxes = 0, moves = 0, allocations = 0;
  double microseconds = 0;
  Status status = Status::free;
};

Cost cost_of(fast::soups::Session& session, const Position& p) {
  const std::size_t before = tests::allocations();
  const std::clock_t start = std::clock();  // other programs do not count
  const fast::soups::Tick tick = session.tick(p);
  const double time = 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {session.looks(), session.boxes(), tick.moves, tests::allocations() - before, time, tick.status};
}

// From where a path has led, whatever position costs more, then from there on.
TEST(soup_budget, holds_for_the_worst_ticks_that_a_search_finds) {
  std::vector<CostlyMesh> sets{
      tests::needles(20), tests::valley(40, 14), tests::layers(400, Sides::both), book(100), bars(20), fins(300, 60),
      planes(30)};
  if (is_whole())
    sets = {tests::needles(30),
            tests::needles(150),
            tests::needles(150, {1, 0.5, 0.25}),
            tests::valley(257, 14),
            tests::valley(257, 490),
            tests::layers(10000, Sides::front),
            tests::layers(10000, Sides::both),
            tests::jacks(3000),
            tests::pole(1000, 5),
            tests::pole(4000, 5),
            book(10),
            book(100),
            book(1000),
            bars(50),
            bars(5000),
            fins(300, 60),
            fins(3000, 3000),
            planes(30),
            planes(91)};
  const std::size_t steps = tests::drawn(400);
  for (const CostlyMesh& one : sets) {
    const auto soup = std::make_shared<const fast::soups::Soup>(one.mesh, std::vector{one.sides});
    std::mt19937_64 random(3);
    fast::soups::Session session(soup, 1, false);
    fast::soups::State before_worst;
    Position worst_position{};
    Cost worst;
    std::size_t unfinished = 0;
    for (std::size_t step = 0; step < steps; ++step) {
      const Position p = drawn_position(one, step, worst_position, random);
      if (step >= 2 * one.positions.size() && random() % 2 == 0) session.resume(before_worst);
      const fast::soups::State before = session.state();
      const Cost cost = cost_of(session, p);
      unfinished += cost.status == Status::unfinished;
      // Each move begins with fewer than kMostLooks; it looks at all boxes at most, and at kMostLooks at its points, but the
      // last of these, which counts all triangles where it is not entered; and so does a rest.
      EXPECT_LE(cost.looks, 2 * one.mesh.triangles.size() + 5 * kMostLooks) << one.family;
      EXPECT_LE(cost.moves, 256U);
      // A move goes three times through the boxes at most: for its way, and for the rounding of its end, which may be stopped
      // on a line and be rounded there. A first position, a rest and a move that is not made add to that.
      EXPECT_LE(cost.boxes, 3 * (cost.moves + 2) * one.mesh.triangles.size()) << one.family;
      if (cost.looks <= worst.looks) continue;
      worst = cost;
      before_worst = before;
      worst_position = p;
    }
    for (int pass = 0; pass < 5; ++pass) {  // other programs interrupt some
      fast::soups::Session fresh(soup, 1, false);
      fresh.resume(before_worst);
      const Cost again = cost_of(fresh, worst_position);
      worst.microseconds = std::min(worst.microseconds, again.microseconds);
      worst.allocations = again.allocations;
      EXPECT_EQ(again.looks, worst.looks) << one.family;
    }
    std::printf("  | %s | %zu | %zu | %zu | %zu | %.0f | %zu | %zu |\n", one.family, one.mesh.triangles.size(), worst.looks,
                worst.boxes, worst.moves, worst.microseconds, worst.allocations, unfinished);
    std::fflush(stdout);  // a long search shows what it has found so far
    EXPECT_GT(worst.looks, 0U) << one.family;
  }
}

}  // namespace
}  // namespace forceshade
