// SPDX-License-Identifier: BSD-3-Clause
// The same files read by CGAL's polygon-soup readers (LGPL): the same triangles with the same coordinates.

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "rendering/meshes/make.h"
#include "rendering/meshes/save.h"
#include "tests/meshes/loaded.h"
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

std::string decimal(float x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(x));
  return text.data();
}

std::string vertices_text(const TriangleMesh& mesh, const std::string& prefix) {
  std::string text;
  for (const auto& [x, y, z] : mesh.vertices) text += prefix + decimal(x) + ' ' + decimal(y) + ' ' + decimal(z) + '\n';
  return text;
}

std::string off_text(const TriangleMesh& mesh) {
  std::ostringstream text;
  write_off(text, mesh);
  return text.str();
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# faces counted from 1\n" + vertices_text(mesh, "v ");
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
  return text;
}

std::string ply_text(const TriangleMesh& mesh, const std::string& format) {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "ascii") {
    text += vertices_text(mesh, "");
    for (const auto& [a, b, c] : mesh.triangles)
      text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
    return text;
  }
  const std::endian order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  for (const Vertex& vertex : mesh.vertices)
    for (const float x : vertex) text += bytes_of(x, order);
  for (const Triangle& triangle : mesh.triangles) {
    text += '\3';
    for (const std::uint32_t v : triangle) text += bytes_of(v, order);
  }
  return text;
}

std::string stl_text(const TriangleMesh& mesh) {
  std::string text = "solid s\n";
  for (const Triangle& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : triangle) {
      const auto& [x, y, z] = mesh.vertices[v];
      text += "vertex " + decimal(x) + ' ' + decimal(y) + ' ' + decimal(z) + '\n';
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

std::string binary_stl_text(const TriangleMesh& mesh) {
  std::string text = std::string(80, ' ') + bytes_of(static_cast<std::uint32_t>(mesh.triangles.size()), std::endian::little);
  for (const Triangle& triangle : mesh.triangles) {
    text += std::string(12, '\0');
    for (const std::uint32_t v : triangle)
      for (const float x : mesh.vertices[v]) text += bytes_of(x, std::endian::little);
    text += std::string(2, '\0');
  }
  return text;
}

TEST(mesh_files, are_read_as_by_another_program) {
  const tests::TemporaryDirectory directory;
  int files = 0;
  const auto expect_same = [&](const std::string& name, const std::string& text) {
    const std::string file = directory.write(name, text);
    const Corners expected = by_cgal(file);
    EXPECT_GT(expected.size(), 0U) << name;
    EXPECT_EQ(corners_of(load(file, Unit::mm)), expected) << name;
    ++files;
  };
  for (const TriangleMesh& mesh : {icosphere(6, 50.0 / 3), torus(20, 5, 24, 12), bump(15.24, 25.4, 100, 20), cube(0.3)}) {
    expect_same("a.off", off_text(mesh));
    expect_same("a.obj", obj_text(mesh));
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
      expect_same("a.ply", ply_text(mesh, format));
    expect_same("a.stl", stl_text(mesh));
    expect_same("b.stl", binary_stl_text(mesh));
  }
  expect_same("polygons.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3\n3 0 4 1\n");
  expect_same("polygons.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 5 2\n");
  expect_same("normals.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\nf 3//1 2//1 1//1\n");
  expect_same("backwards.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n");
  std::printf("%d files\n", files);
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
