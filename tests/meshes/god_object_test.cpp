// SPDX-License-Identifier: BSD-3-Clause
// The real-time god-object by the direct rule: the reference in every bit, with and without a filter, and from tick to tick in
// a session.

#include <algorithm>
#include <cmath>
#include <random>

#include "forceshade/fast.h"
#include "tests/meshes/both_sides.h"

namespace forceshade::fast {
namespace {

Mesh built(const mesh::TriangleMesh& triangles, mesh::Sides sides) {
  return tests::fast_mesh(tests::unshaded(triangles, sides));
}

constexpr float kStiffness = 0.3F;  // N/mm

TEST(god_object, is_the_reference_in_every_bit_on_random_meshes_and_paths_and_gives_the_stage_that_decided) {
  tests::Occasions reached;
  tests::expect_reference(
      96, 500, reached,
      [](tests::MeshSource& source, const tests::RandomMesh& made, mesh::Shading shading) {
        MeshRendering rendering = tests::shaded(made.mesh, source.normals_of(made.mesh), made.sides, kStiffness);
        rendering.shading = shading;
        return rendering;
      },
      [&](const tests::ComparedTick& tick) {
        const auto& [in_binary64, in_integers] = tick.both.decisions();
        reached["a decision in binary64"] += in_binary64;
        reached["a decision in integers"] += in_integers;
        reached["a force"] += tick.expected.force != std::array<float, 3>{};
        if (tick.expected.status == Status::free) return;  // it may have a ball, in which nothing is decided
        EXPECT_EQ(tick.both.session().stage() == Stage::binary64, in_integers == 0);
        ++reached[in_integers > 0 ? "a tick not in binary64" : "a tick in binary64"];
      });
  reached.expect_all(tests::kEverywhere);
  reached.expect_all({"invalid", "a force", "a decision in binary64", "a decision in integers", "a tick in binary64",
                      "a tick not in binary64"});
}

// The stages that a certificate counts: on a floor, a landing is rounded in integers, and so is a position in its plane.
TEST(god_object, in_a_session_gives_the_stage_that_decided_its_tick) {
  const mesh::TriangleMesh floor{{{-8.3F, -9.1F, 0}, {8.7F, -9.4F, 0}, {8.2F, 7.7F, 0}, {-8.6F, 7.9F, 0}},
                                 {{0, 1, 2}, {0, 2, 3}}};
  MeshSession session(std::make_shared<const Mesh>(built(floor, mesh::Sides::front)), kStiffness, mesh::Shading::none);
  const auto stage_at = [&](float x, float y, float z) { return session.step({x, y, z}).stage; };
  EXPECT_EQ(stage_at(-8.55F, -8.9F, 0), Stage::wide) << "in the floor's plane, beside it";
  EXPECT_EQ(stage_at(-8.55F, -8.9F, 0.01F), Stage::binary64) << "in a ball around that place";
  EXPECT_EQ(stage_at(3.1F, 1.3F, 2), Stage::binary64) << "free";
  EXPECT_EQ(stage_at(3.1F, 1.3F, -0.7F), Stage::wide) << "a landing";
  EXPECT_EQ(stage_at(3.2F, 1.3F, -0.7F), Stage::binary64) << "a slide in a triangle";
  EXPECT_EQ(stage_at(1.1F, 3.3F, -0.6F), Stage::binary64) << "a slide over an edge";
  EXPECT_EQ(stage_at(1.2F, 3.4F, 0), Stage::wide) << "in the floor's plane";
  EXPECT_EQ(stage_at(1.2F, 3.4F, -0.5F), Stage::binary64) << "below it again";
  // 0.3F has the 24 bits of 10066330, and five times this number is halfway between two of 24 bits.
  EXPECT_EQ(stage_at(1.2F, 3.4F, -1.25F), Stage::wide) << "a force that is a tie";
  EXPECT_EQ(stage_at(std::nanf(""), 0, 0), Stage::binary64) << "no position";
}

// A sheet of n x n cells of 1 mm with hills and dents; hands that go up to four cells a tick over it, below and above it.
TEST(god_object, slides_over_many_edges_of_a_fine_sheet_as_without_a_filter) {
  constexpr std::uint32_t n = 48;
  std::mt19937_64 random(33);
  const auto within = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  tests::Occasions reached;
  for (int round = 0; round < 12; ++round) {
    const double hills = within(0, 1.5), dents = within(0, 0.5);
    const auto height = [&](double x, double y) { return hills * std::sin(0.5 * x) * std::cos(0.4 * y); };
    mesh::TriangleMesh sheet;
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        sheet.vertices.push_back(
            {static_cast<float>(i), static_cast<float>(j), static_cast<float>(height(i, j) + within(-dents, dents))});
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        sheet.triangles.push_back({a, b, d});
        sheet.triangles.push_back({a, d, c});
      }
    const Mesh mesh = built(sheet, mesh::Sides::both);
    mesh::GodObject state;
    double x = 0.5 * n, y = 0.5 * n, step_x = 1, step_y = 0, depth = -2;
    for (int i = 0; i < 2000; ++i) {
      if (i % 10 == 0) {
        const double way = within(0, 6.3), length = within(0, 4);
        step_x = length * std::cos(way);
        step_y = length * std::sin(way);
        depth = within(-0.5, 2.5);
      }
      x = std::clamp(x + step_x, 2.0, n - 2.0);
      y = std::clamp(y + step_y, 2.0, n - 2.0);
      const std::array<float, 3> p{static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y) - depth)};
      const mesh::Tick exact = step(mesh, state, p, kStiffness, mesh::Shading::none, ExactStages());
      const mesh::Tick filtered = step(mesh, state, p, kStiffness, mesh::Shading::none, FilteredStages());
      ASSERT_TRUE(tests::is_same(filtered, exact)) << "round " << round << ", tick " << i << ": in integers "
                                                   << tests::show(exact) << ", found " << tests::show(filtered);
      const bool was_in_contact = state.place != mesh::Place::free;
      state = exact.after;
      reached.note(exact);
      reached["more than five moves"] += exact.moves > 5;
      reached["moved, then left"] += was_in_contact && exact.moves > 2 && state.place == mesh::Place::free;
    }
  }
  reached.expect_all(
      {"free", "touching", "at edge", "at triangle", "front", "back", "more than five moves", "moved, then left"});
}

// Coordinates below 2^-30 mm are read as 0, so a hand that nears an edge along an axis may be read as on it.
TEST(god_object, in_a_session_meets_an_edge_that_it_is_read_as_being_on) {
  const mesh::TriangleMesh roof{{{0.5F, 0, 0.5F}, {0.5F, 1, 0.5F}, {0, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  const auto mesh = std::make_shared<const Mesh>(built(roof, mesh::Sides::both));
  std::mt19937_64 random(34);
  std::uniform_real_distribution<float> coordinate(0.5F, 4);
  tests::Occasions reached;
  for (int round = 0; round < 2000; ++round) {
    MeshSession session(mesh, kStiffness, mesh::Shading::none);
    mesh::GodObject state;
    for (int i = 0; i < 40; ++i) {
      const float far = i < 30 ? 1.25F : 1;
      const std::array<float, 3> p{far * coordinate(random) * 0x1p-31F, 0.25F, -far * coordinate(random) * 0x1p-31F};
      const mesh::Tick exact = step(*mesh, state, p, kStiffness, mesh::Shading::none, ExactStages()), found = session.tick(p);
      ASSERT_TRUE(tests::is_same(found, exact))
          << "round " << round << ", tick " << i << ": in integers " << tests::show(exact) << ", found " << tests::show(found);
      state = exact.after;
      reached.note(exact);
    }
  }
  reached.expect_all({"free", "touching", "at edge"});
}

}  // namespace
}  // namespace forceshade::fast
