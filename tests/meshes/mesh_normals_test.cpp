// SPDX-License-Identifier: BSD-3-Clause
// Corner normals at creases; doubtful_normals_test.cpp has their bits.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"

namespace forceshade::mesh {
namespace {

CheckedMesh checked_mesh(TriangleMesh mesh) {
  auto result = check_any(std::move(mesh));
  if (const auto* findings = std::get_if<Findings>(&result)) throw std::logic_error(findings->words());
  return std::get<CheckedMesh>(std::move(result));
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

}  // namespace
}  // namespace forceshade::mesh
