// SPDX-License-Identifier: BSD-3-Clause
// Corner normals against the definition written down again in 400 bits, with the angle between two sides by its cosine.

#include <gtest/gtest.h>

#include <boost/multiprecision/mpfr.hpp>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"

namespace forceshade::mesh {
namespace {

using Number = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>, boost::multiprecision::et_off>;
using Vector = std::array<Number, 3>;

Vector difference(const Vertex& a, const Vertex& b) {
  return {Number(a[0]) - Number(b[0]), Number(a[1]) - Number(b[1]), Number(a[2]) - Number(b[2])};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Number dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

CheckedMesh checked_mesh(TriangleMesh mesh) {
  auto result = check(std::move(mesh), SelfIntersections::allowed);
  if (const auto* findings = std::get_if<Findings>(&result)) throw std::logic_error(findings->words());
  return std::get<CheckedMesh>(std::move(result));
}

// Smooth everywhere: one normal for each vertex.
std::vector<Normal> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vector> sum(mesh.vertices.size(), Vector{0, 0, 0});
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vertex &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]], &c = mesh.vertices[t[(k + 2) % 3]];
      const Vector u = difference(b, a), v = difference(c, a), n = cross(u, v);
      const Number angle = acos(dot(u, v) / sqrt(dot(u, u) * dot(v, v))), length = sqrt(dot(n, n));
      for (std::size_t i = 0; i < 3; ++i) sum[t[k]][i] += angle * n[i] / length;
    }
  std::vector<Normal> normals;
  for (const Vector& of : sum) {
    const Number length = sqrt(dot(of, of));
    Normal normal{};
    for (std::size_t i = 0; i < 3; ++i) {
      // 400 bits leave some 10^-115 where the exact component is 0.
      const Number component = of[i] / length;
      normal[i] = abs(component) < Number("1e-100") ? 0.0F : mpfr_get_flt(component.backend().data(), MPFR_RNDN);
    }
    normals.push_back(normal);
  }
  return normals;
}

TEST(corner_normals, are_the_nearest_binary32_numbers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> small(-0.4F, 0.4F);
  TriangleMesh rough = height_map(20, 20, 20, 20, [&](double, double) { return static_cast<double>(10 * small(random)); });
  TriangleMesh thin = height_map(20, 0.001, 20, 20, [&](double, double) { return static_cast<double>(small(random)) * 1e-6; });
  TriangleMesh far = icosphere(6, 0.01);
  for (Vertex& v : far.vertices) v = {v[0] + 9000, v[1] - 9000, v[2] + 9000};
  TriangleMesh needle = torus(5, 4.9, 300, 3);
  NormalStages stages;
  int zeros = 0;
  for (const TriangleMesh& mesh :
       {icosphere(8, 50), bump(15.24, 25.4, 60, 24), torus(20, 5, 24, 12), cube(3), rough, thin, far, needle}) {
    const CheckedMesh of = checked_mesh(mesh);
    const ComputedNormals computed = corner_normals(of);
    stages.binary64 += computed.stages.binary64;
    stages.intervals += computed.stages.intervals;
    const std::vector<Normal> expected = smooth_normals(of.mesh());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float got = computed.normals[i][k][axis];
          ASSERT_EQ(got, expected[mesh.triangles[i][k]][axis]) << i << ' ' << k << ' ' << axis;
          if (got == 0) {
            ++zeros;
            ASSERT_FALSE(std::signbit(got)) << i;
          }
        }
  }
  std::printf("binary64 %llu, intervals %llu, zeros %d\n", static_cast<unsigned long long>(stages.binary64),
              static_cast<unsigned long long>(stages.intervals), zeros);
  EXPECT_GT(stages.binary64, 1000U);
  EXPECT_GT(stages.intervals, 10U);
  EXPECT_GT(zeros, 100);
}

// Each face of a cube turns from the next by 90 degrees, exactly.
TEST(corner_normals, are_of_a_side_alone_behind_a_crease) {
  const CheckedMesh mesh = checked_mesh(cube(2));
  for (const double smooth : {90.0, 90.0000001, 180.0})
    for (const auto& corners : corner_normals(mesh, smooth).normals)
      for (const Normal& normal : corners)
        for (const float x : normal) EXPECT_EQ(std::fabs(x), 0x1.279a74p-1F) << smooth;
  for (const double crease : {0.0, 30.0, 89.9999999})
    for (const auto& corners : corner_normals(mesh, crease).normals)
      for (const Normal& normal : corners) {
        EXPECT_EQ(std::fabs(normal[0]) + std::fabs(normal[1]) + std::fabs(normal[2]), 1) << crease;
        EXPECT_EQ(normal, corners[0]) << crease;
      }
  for (const double wrong : {-0.1, 180.1, std::nan("")}) EXPECT_THROW(corner_normals(mesh, wrong), std::invalid_argument);
}

// A strip that turns by an angle known exactly at its one edge.
TEST(corner_normals, separate_where_the_angle_is_more_than_the_crease) {
  struct Case {
    Vertex corner;  // beyond the edge from (0, 0, 0) to (0, 1, 0); the other face lies in z = 0
    double degrees;
  };
  for (const Case& of : {Case{{-1, 0, 0}, 0}, Case{{-1, 0, 1}, 45}, Case{{0, 0, 1}, 90}, Case{{1, 0, 1}, 135}}) {
    const CheckedMesh mesh = checked_mesh({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, of.corner}, {{0, 2, 1}, {0, 1, 3}}});
    const auto is_smooth = [&](double crease) {
      const CornerNormals normals = corner_normals(mesh, crease).normals;
      EXPECT_EQ(normals[0][0] == normals[1][0], normals[0][2] == normals[1][1]);
      return normals[0][0] == normals[1][0];
    };
    if (of.degrees == 0) {
      EXPECT_TRUE(is_smooth(0));
      continue;
    }
    EXPECT_TRUE(is_smooth(of.degrees)) << of.degrees;
    EXPECT_FALSE(is_smooth(std::nextafter(of.degrees, 0.0))) << of.degrees;
    EXPECT_TRUE(is_smooth(std::nextafter(of.degrees, 180.0))) << of.degrees;
  }
}

// Around a closed fan one edge that separates divides nothing, two do.
TEST(corner_normals, are_shared_around_the_other_way) {
  const auto mesh = [](float z) {
    return checked_mesh(
        {{{0, 0, 0}, {4, 0, z}, {0, 4, 0}, {-4, 0, z}, {0, -4, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}});
  };
  // A roof along y turns by 90 degrees there.
  const CornerNormals roof = corner_normals(mesh(-4), 45).normals;
  EXPECT_EQ(roof[0][0], roof[3][0]);
  EXPECT_EQ(roof[1][0], roof[2][0]);
  EXPECT_NE(roof[0][0], roof[1][0]);
  const CornerNormals smooth = corner_normals(mesh(-4), 90).normals;
  for (const auto& corners : smooth) EXPECT_EQ(corners[0], (Normal{0, 0, 1}));
}

// The corner normals of the independent program, where its folder is given.
TEST(corner_normals, are_those_of_an_independent_program) {
  const char* const folder = std::getenv("FORCESHADE_GOD_OBJECT_PATHS");
  if (folder == nullptr) GTEST_SKIP() << "FORCESHADE_GOD_OBJECT_PATHS names no folder";
  std::uint64_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem();
    if (entry.path().extension() != ".off") continue;
    const double crease = name == "l_prism_creased" ? 30 : name == "rough_field_creased" ? 45 : 180;
    const CornerNormals normals = corner_normals(checked_mesh(load(entry.path(), Unit::mm)), crease).normals;
    std::ifstream rows(std::filesystem::path(folder) / (name + ".normals.csv"));
    std::string line;
    std::getline(rows, line);
    std::size_t count = 0;
    for (; std::getline(rows, line); ++count) {
      std::array<float, 5> numbers{};
      const char* at = line.data();
      for (float& number : numbers) at = std::from_chars(at, line.data() + line.size(), number).ptr + 1;
      const Normal expected{numbers[2], numbers[3], numbers[4]};
      EXPECT_EQ(normals[static_cast<std::size_t>(numbers[0])][static_cast<std::size_t>(numbers[1])], expected)
          << name << ' ' << line;
      compared += 3;
    }
    EXPECT_EQ(count, 3 * normals.size()) << name;
  }
  std::printf("%llu components\n", static_cast<unsigned long long>(compared));
  EXPECT_GT(compared, 0U);
}

}  // namespace
}  // namespace forceshade::mesh
