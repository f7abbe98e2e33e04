// SPDX-License-Identifier: BSD-3-Clause
// Meshes that others have made, read by CGAL's polygon-soup readers (LGPL): the same triangles with the same coordinates.

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "forceshade/meshes.h"
#include "tests/meshes/real_meshes.h"

namespace forceshade::mesh {
namespace {

using Points = std::vector<CGAL::Simple_cartesian<double>::Point_3>;
using Corners = std::vector<std::array<Vertex, 3>>;

// Three vertices for each triangle. STL readers number vertices as they like.
Corners corners_of(const TriangleMesh& mesh) {
  Corners corners;
  for (const auto& [a, b, c] : mesh.triangles) corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  return corners;
}

Corners by_cgal(const std::string& file) {
  Points points;
  std::vector<std::vector<std::size_t>> polygons;
  EXPECT_TRUE(CGAL::IO::read_polygon_soup(file, points, polygons)) << file;
  Corners corners;
  // As the definition reads a coordinate.
  const auto read = [](double x) { return std::fabs(x) < 0x1p-30 ? 0.0F : static_cast<float>(x); };
  const auto vertex = [&](std::size_t i) { return Vertex{read(points[i].x()), read(points[i].y()), read(points[i].z())}; };
  for (const auto& polygon : polygons)
    for (std::size_t i = 2; i < polygon.size(); ++i)
      corners.push_back({vertex(polygon[0]), vertex(polygon[i - 1]), vertex(polygon[i])});
  return corners;
}

TEST(mesh_files, that_others_have_made_are_read_as_by_another_program) {
  const tests::RealMeshes real;
  if (real.files().empty()) GTEST_SKIP() << "Debian's libcgal-demo is not installed";
  int compared = 0, refused = 0;
  for (const std::string& file : real.files()) {
    TriangleMesh ours;
    try {
      ours = load(file, Unit::mm);
    } catch (const Error&) {
      ++refused;
      continue;
    }
    EXPECT_EQ(corners_of(ours), by_cgal(file)) << file;
    ++compared;
  }
  std::printf("%d files compared, %d refused\n", compared, refused);
  EXPECT_GT(compared, 10 * refused);
}

}  // namespace
}  // namespace forceshade::mesh
