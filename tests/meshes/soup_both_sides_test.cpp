// SPDX-License-Identifier: BSD-3-Clause
// The real-time side on drawn sets of triangles, in every column against the exact side. Most sets lie on a lattice and most
// positions, too, so that triangles meet in all ways and ties are common.

#include "tests/meshes/soup_both_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>

#include "tests/meshes/costly_meshes.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

using tests::last_place;
using tests::Position;

struct Drawn {
  mesh::TriangleMesh mesh;
  std::vector<mesh::Sides> sides;
  std::vector<mesh::Material> materials;
  mesh::CornerNormals normals;
  float step = 1;
  int span = 1;
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool one_in(int count) { return below(count) == 0; }
  float unit() { return static_cast<float>(random_() >> 40) * 0x1p-24F; }
  float around(float size) { return size * (2 * unit() - 1); }
  template <class T>
  const T& pick(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  Position node(const Drawn& set, int most) {
    Position node;
    for (float& c : node) c = set.step * static_cast<float>(below(2 * most + 1) - most);
    return node;
  }

  // large: of 40 vertices and up to 120 triangles.
  Drawn set(bool large) {
    Drawn set;
    set.step = pick<float>({4, 3, 1, 0x1p-22F, 1000, 0.1F});
    set.span = pick<int>({1, 1, 2});
    const bool is_flat = one_in(3), is_general = one_in(4), is_tall = one_in(8);
    for (int i = large ? 40 : pick<int>({5, 6, 9, 14}); i > 0; --i) {
      Position v = node(set, set.span);
      if (is_general)
        for (float& c : v) c = set.step * around(static_cast<float>(set.span));
      if (is_flat && !one_in(3)) v[2] = 0;
      if (is_tall) v[0] *= 0x1p-10F;
      set.mesh.vertices.push_back(v);
    }
    const std::size_t vertices = set.mesh.vertices.size();
    const auto vertex = [&] { return static_cast<std::uint32_t>(below(static_cast<int>(vertices))); };
    const int kind = below(4);  // of sides: front, both, mixed, both
    const bool is_rough = one_in(3);
    for (int i = large ? 120 : pick<int>({2, 4, 6, 9, 14, 20}); i > 0; --i) {
      mesh::Triangle t{vertex(), vertex(), vertex()};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      set.mesh.triangles.push_back(t);
      set.sides.push_back(kind == 0 || (kind == 2 && one_in(2)) ? mesh::Sides::front : mesh::Sides::both);
      if (is_rough) {
        const float mu = pick<float>({0, 0x1p-10F, 0.3F, 1, 4, HUGE_VALF});
        set.materials.push_back({{}, mu, one_in(2) ? mu : std::isinf(mu) ? 0.5F : mu > 0.01F ? mu / 2 : 0});
      }
      std::array<mesh::Normal, 3> corners{};
      for (mesh::Normal& n : corners) n = one_in(3) ? mesh::Normal{0, 0, 1} : mesh::Normal{around(1), around(1), around(1)};
      set.normals.push_back(one_in(2) || set.normals.empty() ? corners : set.normals.back());
    }
    return set;
  }

  Position position(const Drawn& set, const Position& last) {
    Position at = last;
    switch (below(10)) {
      case 0:
      case 1:
      case 2: return node(set, one_in(3) ? 2 * set.span : set.span);
      case 3:
        at = node(set, 4 * set.span);
        for (float& c : at) c /= 2;
        return at;
      case 4: {
        const Position &a = pick(set.mesh.vertices), &b = pick(set.mesh.vertices);
        for (std::size_t i = 0; i < 3; ++i) at[i] = (a[i] + b[i]) / 2;
        return at;
      }
      case 5:
        for (float& c : at) c += around(0.3F * set.step);
        return at;
      case 6:
      case 8:
      case 9:
        if (!one_in(3)) {
          for (float& c : at) c += around(0.1F * set.step);
          return at;
        }
        for (float& c : at) c += around(0x1p-22F * set.step);
        return at;
      default:
        for (float& c : at) c = around(1.5F * set.step * static_cast<float>(set.span));
        return at;
    }
  }

 private:
  std::mt19937_64 random_;
};

TEST(soups_on_both_sides, every_column_of_drawn_paths_is_the_same) {
  constexpr float kStiffness = 0.3F;
  constexpr int kTicks = 40;
  // Each was found by a mistake, or by a mutant that few sets find: a point of a triangle's grid on another sheet, a first cell
  // that is not the least, a corner before the next point of a line's grid, pieces that lead to the hand alike, a rounding that
  // is stopped, a place on the grid of another edge of the same line, a vertex whose first wall and cell are named after
  // triangles that are turned against each other.
  constexpr std::uint64_t kFirst[]{103263, 99, 249, 660, 296, 34002949, 34006154};
  std::size_t ticks = 0, sets = 0, touching = 0;
  std::map<std::string, std::size_t> places;
  const std::uint64_t first = tests::first_drawn();
  for (; sets < tests::drawn(250); ++sets) {
    const std::uint64_t number = first + sets < std::size(kFirst) ? kFirst[first + sets] : first + sets;
    Draw draw(number);
    const Drawn set = draw.set(number % 50 == 49);
    tests::ExactSoup exact(set.mesh, set.sides, set.materials, set.normals, kStiffness);
    tests::FastSoup fast(set.mesh, set.sides, set.materials, set.normals, kStiffness);
    Position last{};
    for (int i = 0; i < kTicks; ++i) {
      if (!draw.one_in(12)) last = draw.position(set, last);
      if (!std::ranges::all_of(last, [](float c) { return std::abs(c) <= 1e4F; })) last = {};
      fast::soups::Session other(fast.soup, kStiffness, false);  // goes on from the state alone
      const bool is_resumed = draw.one_in(8);
      if (is_resumed) other.resume(fast.plain.state());
      const tests::SoupTick made = fast.tick(last);
      ASSERT_EQ(made.text(), exact.tick(last).text()) << "set " << number << ", tick " << i;
      if (is_resumed) {
        const fast::soups::Tick resumed = other.tick(last);
        ASSERT_TRUE(resumed.after == fast.plain.state() && resumed.force == made.force) << "set " << number << ", tick " << i;
      }
      ++ticks;
      if (!made.is_free()) {
        ++touching;
        ++places[made.place.substr(0, made.place.find(' '))];
      }
    }
  }
  std::printf("  %zu ticks on %zu sets, %zu touching\n", ticks, sets, touching);
  for (const auto& [place, count] : places) std::printf("  %7zu %s\n", count, place.c_str());
  EXPECT_GT(touching, ticks / 8);
}

// Along the bottom of a valley each move ends at a vertex, until too much was looked at. The vertex has the numbers of the
// file, however many moves led there: made from the one before it, and so on, its numbers become longer than an integer may be.
TEST(soups_on_both_sides, a_tick_leads_from_vertex_to_vertex) {
  const tests::CostlyMesh valley = tests::valley(40, 14);
  std::vector<Position> path{{0.25F, 0, 2}, {0.25F, 0, -1}, {35.0938606F, 0.01F, -1}};
  EXPECT_EQ(last_place(valley.mesh, path, {valley.sides}), "v 20");
  path.push_back({35.0999985F, -2.47103453F, 1.20601344F});
  EXPECT_EQ(last_place(valley.mesh, path, {valley.sides}).substr(0, 8), "e 26 974");
}

// A hand leads it from vertex to vertex, and it rests at each. A rest at p has p's numbers, not those of the way that led
// there.
TEST(soups_on_both_sides, ticks_lead_from_vertex_to_vertex) {
  const tests::CostlyMesh valley = tests::valley(40, 3);
  std::vector<Position> path{{0.25F, 0, 2}};
  for (int k = 0; k < 39; ++k) path.push_back({static_cast<float>(k), 0, 0});
  path.push_back({0.7F, 0.01F, 0});
  EXPECT_EQ(last_place(valley.mesh, path, {valley.sides}), "t 3 11732866 16777");
}

// Down a strip of triangles, each way of which ends at a point of an edge's grid. The end has the numbers of its place, not
// those of the way.
TEST(soups_on_both_sides, a_tick_leads_from_edge_to_edge) {
  mesh::TriangleMesh strip;
  for (std::uint32_t k = 0; k < 24; ++k) {
    const auto x = static_cast<float>(k);
    strip.vertices.push_back({x, -8, -x * x / 64});
    strip.vertices.push_back({x, 8, -x * x / 64});
    if (k == 0) continue;
    strip.triangles.push_back({2 * k - 2, 2 * k, 2 * k - 1});
    strip.triangles.push_back({2 * k - 1, 2 * k, 2 * k + 1});
  }
  EXPECT_EQ(last_place(strip, {{0.25F, 0, 1}, {0.25F, 0, -1}, {7.5F, 0, -26}}), "t 39 8388608 2701619");
}

// From one sheet to the other and back, where each flight lands at a point of a triangle's grid and nothing moves it from
// there. It has the numbers of its place, not those of the flights.
TEST(soups_on_both_sides, ticks_lead_from_sheet_to_sheet) {
  const mesh::TriangleMesh sheets{{{-16, -16, 0}, {48, -16, 0}, {-16, 48, 0}, {-16, -16, 8}, {48, -16, 8}, {-16, 48, 8}},
                                  {{0, 1, 2}, {3, 4, 5}}};
  std::vector<Position> path{{1, 2, 4}};
  for (int k = 0; k < 40; ++k) path.push_back({1, 2, k % 2 == 0 ? -1.0F : 9.0F});
  path.push_back({3, 2.3F, -1});
  EXPECT_EQ(last_place(sheets, path), "t 0 4980736 4797235");
}

}  // namespace
}  // namespace forceshade
