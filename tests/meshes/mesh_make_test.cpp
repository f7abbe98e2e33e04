// SPDX-License-Identifier: BSD-3-Clause
// Meshes of simple shapes: that they are meshes, and of what they are.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"
#include "rendering/meshes/save.h"
#include "tests/meshes/loaded.h"

namespace forceshade::mesh {
namespace {

CheckedMesh checked(TriangleMesh mesh) {
  auto result = check(std::move(mesh));
  if (const auto* findings = std::get_if<Findings>(&result)) throw std::logic_error(findings->words());
  return std::get<CheckedMesh>(std::move(result));
}

TEST(made_meshes, are_meshes_with_their_fronts_outside) {
  struct Case {
    TriangleMesh mesh;
    std::uint64_t triangles;
    long euler;  // vertices - edges + triangles
    double volume;
  };
  std::vector<Case> cases;
  for (const std::uint32_t f : {1U, 2U, 3U, 4U, 7U, 22U}) cases.push_back({icosphere(f, 50), 20 * f * f, 2, 5.2e5});
  cases.push_back({cube(3), 12, 2, 27});
  cases.push_back({box(1, 2, 3), 12, 2, 6});
  cases.push_back({torus(20, 5, 24, 12), 576, 0, 2 * std::numbers::pi * std::numbers::pi * 20 * 25});
  cases.push_back({torus(20, 5, 3, 3), 18, 0, 0});
  cases.push_back({thin_wall(10, 20, 1, 1), 2, 1, 0});
  cases.push_back({thin_wall(10, 20, 4, 3), 24, 1, 0});
  cases.push_back({bump(15.24, 25.4, 100, 22), 968, 1, 0});
  cases.push_back({cylinder_bump(15.24, 25.4, 100, 22), 968, 1, 0});
  for (const Case& of : cases) {
    const Facts facts = facts_of(checked(of.mesh));
    EXPECT_EQ(facts.triangles, of.triangles);
    EXPECT_EQ(static_cast<long>(facts.vertices - facts.edges + facts.triangles), of.euler) << of.triangles;
    EXPECT_EQ(facts.parts, 1U);
    EXPECT_EQ(facts.unused_vertices, 0U);
    EXPECT_EQ(facts.is_closed(), of.euler != 1);
    if (of.volume > 0 && of.triangles > 20) {
      EXPECT_NEAR(facts.volume / of.volume, 1, 0.35) << of.triangles;
    }
    if (facts.is_closed()) {
      EXPECT_GT(facts.volume, 0);
    } else {
      EXPECT_EQ(facts.volume, 0);
    }
  }
}

TEST(made_meshes, have_their_largest_fan_where_most_triangles_meet) {
  TriangleMesh tip;
  tip.vertices.resize(5);
  tip.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_EQ(largest_fan(tip).vertex, 3U);
  EXPECT_EQ(largest_fan(tip).triangles, 3U);
  EXPECT_EQ(largest_fan(icosphere(7, 50)).triangles, 6U);
  EXPECT_EQ(largest_fan({}).triangles, 0U);
}

TEST(made_meshes, have_their_vertices_where_they_belong) {
  for (const auto& [x, y, z] : icosphere(9, 50).vertices) EXPECT_NEAR(std::hypot(x, y, z), 50, 1e-5);
  for (const auto& [x, y, z] : torus(20, 5, 30, 20).vertices) EXPECT_NEAR(std::hypot(std::hypot(x, y) - 20, z), 5, 1e-5);
  const double d = std::sqrt(15.24 * 15.24 - 12.7 * 12.7);
  int on_top = 0;
  for (const auto& [x, y, z] : bump(15.24, 25.4, 100, 50).vertices) {
    const double r = std::hypot(x, y);
    EXPECT_NEAR(z, r < 12.7 ? std::sqrt(15.24 * 15.24 - r * r) - d : 0, 1e-5);
    on_top += z > 0 ? 1 : 0;
  }
  EXPECT_GT(on_top, 50);
  for (const auto& [x, y, z] : cylinder_bump(15.24, 25.4, 100, 50).vertices)
    EXPECT_NEAR(z, std::fabs(x) < 12.7 ? std::sqrt(15.24 * 15.24 - x * x) - d : 0, 1e-5);
  const TriangleMesh map = height_map(4, 2, 2, 1, [](double x, double y) { return 10 * x + y; });
  EXPECT_EQ(map.vertices, (std::vector<Vertex>{{-2, -1, -21}, {0, -1, -1}, {2, -1, 19}, {-2, 1, -19}, {0, 1, 1}, {2, 1, 21}}));
  EXPECT_EQ(map.triangles, (std::vector<Triangle>{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}));
}

TEST(made_meshes, are_refused_beyond_their_ranges) {
  const auto flat = [](double, double) { return 0.0; };
  EXPECT_THROW(icosphere(0, 1), std::invalid_argument);
  EXPECT_THROW(icosphere(4000, 1), std::invalid_argument);
  EXPECT_THROW(icosphere(1, 0), std::invalid_argument);
  EXPECT_THROW(icosphere(1, std::nan("")), std::invalid_argument);
  EXPECT_THROW(icosphere(2, 20000), std::invalid_argument);
  EXPECT_THROW(cube(-1), std::invalid_argument);
  EXPECT_THROW(torus(5, 5, 10, 10), std::invalid_argument);
  EXPECT_THROW(torus(5, 1, 2, 10), std::invalid_argument);
  EXPECT_THROW(thin_wall(5, 1, 0, 10), std::invalid_argument);
  EXPECT_THROW(height_map(5, 1, 1, 1, [](double, double) { return std::nan(""); }), std::invalid_argument);
  EXPECT_THROW(height_map(5, 5, 16384, 16384, flat), std::invalid_argument);
  EXPECT_THROW(bump(10, 20.1, 100, 10), std::invalid_argument);
  EXPECT_THROW(cylinder_bump(10, 20.1, 100, 10), std::invalid_argument);
}

TEST(made_meshes, are_read_from_what_is_written_of_them) {
  for (const TriangleMesh& mesh : {icosphere(5, 1.0 / 3), torus(20, 5, 24, 12), cube(0.1)}) {
    std::ostringstream text;
    write_off(text, mesh);
    const Loaded got = of_text("a.off", text.str());
    EXPECT_EQ(got.refusal, "");
    EXPECT_EQ(got.mesh.mesh.vertices, mesh.vertices);
    EXPECT_EQ(got.mesh.mesh.triangles, mesh.triangles);
  }
  std::ostringstream text;
  write_off(text, thin_wall(1, 3, 1, 1));
  EXPECT_EQ(text.str(), "OFF\n4 2 0\n-0.5 -1.5 0\n0.5 -1.5 0\n-0.5 1.5 0\n0.5 1.5 0\n3 0 1 3\n3 0 3 2\n");
}

}  // namespace
}  // namespace forceshade::mesh
