// SPDX-License-Identifier: BSD-3-Clause
// The real-time god-object against paths that other programs have computed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

#include "fast/meshes/session.h"
#include "files/csv.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "properties/mesh_source.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/steps.h"
#include "tests/support/drawn.h"

namespace forceshade::fast {
namespace {

Mesh built(const mesh::TriangleMesh& triangles, mesh::Sides sides) {
  return tests::fast_mesh(tests::unshaded(triangles, sides));
}

template <class Stages>
int differences(const tests::GodObjectPath& path, const Stages& stages) {
  const Mesh mesh = tests::fast_mesh(tests::shaded(path.mesh, path.normals, path.sides));
  mesh::GodObject plain, shaded;
  int found = 0;
  for (const tests::PathTick& row : path.ticks) {
    const mesh::Tick tick = step(mesh, plain, row.position, path.stiffness, mesh::Shading::none, stages);
    const mesh::Tick other = step(mesh, shaded, row.position, path.stiffness, mesh::Shading::vertex_scheme, stages);
    plain = tick.after;
    shaded = other.after;
    mesh::Tick expected_shaded = row.tick;
    expected_shaded.force = row.shaded;
    if (tests::is_same(tick, row.tick) && tests::is_same(other, expected_shaded)) continue;
    if (++found <= 3)
      ADD_FAILURE() << row.place << "\n  expected " << tests::show(row.tick) << "\n  found    " << tests::show(tick)
                    << "\n  expected shaded " << tests::show(expected_shaded) << "\n  found    " << tests::show(other);
    plain = shaded = row.tick.after;
  }
  return found;
}

void expect_same_as_all_in(const std::string& folder) {
  std::size_t ticks = 0;
  const auto names = tests::god_object_paths_in(folder);
  for (const std::string& name : names) {
    const tests::GodObjectPath path = tests::read_god_object_path(folder, name);
    ticks += path.ticks.size();
    EXPECT_EQ(differences(path, ExactStages()), 0) << name << ", in integers";
    EXPECT_EQ(differences(path, FilteredStages()), 0) << name << ", in binary64 first";
  }
  std::printf("  %zu paths, %zu ticks, each with and without a filter\n", names.size(), ticks);
  EXPECT_GT(ticks, 0U);
}

TEST(god_object, equals_the_golden_paths_in_every_column) {
  expect_same_as_all_in(std::string(FORCESHADE_SOURCE_DIR "/tests/golden/god_object"));
}

TEST(god_object, equals_the_paths_in_a_given_folder_in_every_column) {
  const char* const folder = std::getenv("FORCESHADE_GOD_OBJECT_PATHS");
  if (folder == nullptr) GTEST_SKIP() << "FORCESHADE_GOD_OBJECT_PATHS names no folder of paths";
  expect_same_as_all_in(folder);
}

struct Reached {
  std::map<std::string, std::size_t> counts;

  void note(const mesh::Tick& tick) {
    ++counts[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)])];
    if (tick.status == Status::invalid) return;
    ++counts["at " + std::string(mesh::kPlaceNames[static_cast<std::size_t>(tick.after.place)])];
    ++counts[std::string(mesh::kSideNames[static_cast<std::size_t>(tick.after.side)])];
    counts["more than one move"] += tick.moves > 1;
    counts["a force"] += tick.force != std::array<float, 3>{};
  }
  void expect_all(const std::vector<const char*>& names) {
    for (const char* name : names) {
      std::printf("  %9zu %s\n", counts[name], name);
      EXPECT_GT(counts[name], 0U) << name;
    }
  }
};

const std::vector<const char*> kReached{"free",        "touching", "invalid", "at free", "at vertex",         "at edge",
                                        "at triangle", "front",    "back",    "a force", "more than one move"};

constexpr float kStiffness = 0.3F;  // N/mm

constexpr std::array<mesh::Shading, 3> kShadings{mesh::Shading::none, mesh::Shading::vertex_scheme, mesh::Shading::edge_scheme};

// A random mesh with one path on it.
struct Scene {
  properties::RandomMesh made;
  MeshRendering rendering;
  mesh::Shading shading;
  Mesh mesh;
  properties::MeshPath path;

  Scene(properties::MeshSource& source, std::uint64_t seed)
      : made(source.next()),
        rendering(tests::shaded(made.mesh, source.normals_of(made.mesh), made.sides, kStiffness)),
        shading(rendering.shading = kShadings[seed % kShadings.size()]),
        mesh(tests::fast_mesh(rendering)),
        path(made.mesh, seed) {}

  std::string place(std::size_t tick, const std::array<float, 3>& p) const {
    return std::string(properties::kMeshFamilies[made.family]) + ", tick " + std::to_string(tick) + " at " + shortest(p[0]) +
           " " + shortest(p[1]) + " " + shortest(p[2]);
  }
};

constexpr std::size_t kTicksOfAMesh = 500;

TEST(god_object, is_the_reference_in_every_bit_on_random_meshes_and_paths) {
  Reached reached;
  const std::size_t ticks = tests::drawn(36000);
  properties::MeshSource source(31);
  for (std::uint64_t seed = 0; seed * kTicksOfAMesh < ticks; ++seed) {
    Scene scene(source, seed);
    reference::GodObjectSession session(tests::built(reference::GodObject::build(scene.rendering)));
    mesh::GodObject state;
    for (std::size_t i = 0; i < kTicksOfAMesh; ++i) {
      const std::array<float, 3> p = scene.path.next();
      const mesh::Tick expected = session.step(p), found = step(scene.mesh, state, p, kStiffness, scene.shading);
      ASSERT_TRUE(tests::is_same(found, expected)) << "mesh " << seed << ", " << scene.place(i, p) << ": expected "
                                                   << tests::show(expected) << ", found " << tests::show(found);
      state = found.after;
      reached.note(found);
    }
  }
  reached.expect_all(kReached);
}

TEST(god_object, is_the_same_with_and_without_a_filter_and_from_tick_to_tick_in_a_session) {
  Reached reached;
  std::size_t in_binary64 = 0, in_integers = 0;
  const std::size_t ticks = tests::drawn(54000);
  properties::MeshSource source(32);
  for (std::uint64_t seed = 0; seed * kTicksOfAMesh < ticks; ++seed) {
    Scene scene(source, seed);
    const auto mesh = std::make_shared<const Mesh>(scene.mesh);
    mesh::GodObject state;
    MeshSession session(mesh, kStiffness, scene.shading);
    // Held as a session holds it: a state names an edge, and which of its two halves is held decides what is computed.
    Arrival arrival;
    for (std::size_t i = 0; i < kTicksOfAMesh; ++i) {
      const std::array<float, 3> p = scene.path.next();
      const mesh::Tick exact = step(*mesh, state, p, kStiffness, scene.shading, ExactStages());
      if (i % 50 == 49) {
        session.resume(state);
        arrival.spot = spot_of(*mesh, state);
      }
      const std::size_t before = in_integers;
      mesh::Tick filtered;
      if (in_domain(p))
        arrive(*mesh, arrival, quantised(p), kStiffness, scene.shading, CountedStages{&in_binary64, &in_integers}, filtered);
      filtered.after = object_of(*mesh, arrival.spot);
      if (i % 3 != 0) session.look_ahead();  // without any trace in what follows
      const mesh::Tick in_session = session.tick(p);
      for (const mesh::Tick& tick : {filtered, in_session})
        ASSERT_TRUE(tests::is_same(tick, exact)) << "mesh " << seed << ", " << scene.place(i, p) << ": in integers "
                                                 << tests::show(exact) << ", found " << tests::show(tick);
      // A free one may have a ball, in which nothing is decided.
      const bool is_in_doubt = in_integers > before;
      if (exact.status != Status::free) {
        EXPECT_EQ(session.stage() == Stage::binary64, !is_in_doubt) << "mesh " << seed << ", " << scene.place(i, p);
        ++reached.counts[is_in_doubt ? "a tick not in binary64" : "a tick in binary64"];
      }
      state = exact.after;
      reached.note(exact);
    }
  }
  reached.counts["decided in binary64"] = in_binary64;
  reached.counts["decided in integers"] = in_integers;
  std::vector<const char*> names = kReached;
  names.insert(names.end(), {"decided in binary64", "decided in integers", "a tick in binary64", "a tick not in binary64"});
  reached.expect_all(names);
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
  Reached reached;
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
      reached.counts["more than five moves"] += exact.moves > 5;
      reached.counts["moved, then left"] += was_in_contact && exact.moves > 2 && state.place == mesh::Place::free;
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
  Reached reached;
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

// A long strip of narrow cells, so that one jump along it takes more moves than a tick has.
TEST(god_object, goes_on_where_it_has_used_up_its_moves_as_the_reference_does) {
  mesh::TriangleMesh strip;
  constexpr std::uint32_t kColumns = 400;
  for (std::uint32_t i = 0; i <= kColumns; ++i)
    for (const float y : {-8.0F, 8.0F}) strip.vertices.push_back({0.25F * static_cast<float>(i), y, 0.0F});
  for (std::uint32_t i = 0; i < kColumns; ++i) {
    strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    strip.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  const Mesh mesh = built(strip, mesh::Sides::both);
  MeshRendering rendering = tests::unshaded(strip, mesh::Sides::both);
  rendering.stiffness = kStiffness;
  reference::GodObjectSession session(tests::built(reference::GodObject::build(rendering)));
  const auto driven = tests::built(GodObject::build(rendering)).open();
  mesh::GodObject state;
  int unfinished = 0;
  for (const std::array<float, 3>& p : {std::array{1.0F, 0.1F, 1.0F},
                                        {1.0F, 0.1F, -0.7F},
                                        {99.1F, 0.3F, -0.7F},
                                        {99.1F, 0.3F, -0.7F},
                                        {99.1F, 0.3F, -0.7F},
                                        {99.1F, 0.3F, -0.7F},
                                        {99.1F, 0.3F, -0.7F}}) {
    const mesh::Tick expected = session.step(p), found = step(mesh, state, p, kStiffness, mesh::Shading::none);
    EXPECT_TRUE(tests::is_same(found, expected)) << tests::show(expected) << ", found " << tests::show(found);
    state = found.after;
    const Evaluation evaluation = driven->step({p[0], p[1], p[2]});
    EXPECT_EQ(evaluation.status, found.status) << "what a supervisor is given";
    if (found.status == Status::unfinished) {
      ++unfinished;
      EXPECT_EQ(found.moves, 256);
    }
  }
  EXPECT_EQ(unfinished, 3);
  EXPECT_EQ(state.place, mesh::Place::triangle);
}

}  // namespace
}  // namespace forceshade::fast
