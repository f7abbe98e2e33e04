// SPDX-License-Identifier: BSD-3-Clause
// Properties of the god-object on meshes that are not regular. FORCESHADE_REAL_SOUPS names a folder of mesh files, of which
// docs/tables/real-meshes.csv lists some with their sources; without it, made meshes stand in for them. FORCESHADE_DRAWS=4 goes
// 1920 ticks on each.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "rendering/meshes/make.h"
#include "tests/properties/soup_walks.h"
#include "tests/support/drawn.h"

namespace forceshade::properties {
namespace {

using NamedMesh = std::pair<std::string, mesh::TriangleMesh>;

std::vector<NamedMesh> made_meshes() {
  const auto together = [](mesh::TriangleMesh all, const mesh::TriangleMesh& other, const mesh::Vertex& by) {
    const auto before = static_cast<std::uint32_t>(all.vertices.size());
    for (const auto& [x, y, z] : other.vertices) all.vertices.push_back({x + by[0], y + by[1], z + by[2]});
    for (const auto& [a, b, c] : other.triangles) all.triangles.push_back({before + a, before + b, before + c});
    return all;
  };
  const mesh::TriangleMesh cube = mesh::cube(10), ball = mesh::icosphere(3, 6), torus = mesh::torus(8, 3, 12, 8);
  return {{"two cubes side by side", together(cube, cube, {10, 2, 0})},
          {"a ball in a cube's corner", together(cube, ball, {5, 5, 5})},
          {"a ball twice", together(ball, ball, {})},
          {"a wall in a box", together(cube, mesh::thin_wall(10, 10, 3, 3), {})},
          {"a torus through a torus", together(torus, torus, {8, 0, 0})}};
}

std::vector<NamedMesh> read_meshes(const std::filesystem::path& folder) {
  std::vector<NamedMesh> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) try {
        all.emplace_back(entry.path(), mesh::load(entry.path(), mesh::Unit::mm));
      } catch (const Error& error) {
        std::printf("not read: %s\n", error.what());
      }
  return all;
}

// Strokes, each of eight positions: from in front of a triangle through it and along it, some of them far.
Walk strokes_on(const mesh::CheckedMesh& checked) {
  const mesh::Sides sides = mesh::usual_sides(checked);
  Walk walk{{checked, mesh::corner_normals(checked, 60).normals, sides, mesh::Shading::vertex_scheme, 0.5F, {}},
            sides == mesh::Sides::front,
            {}};
  const std::vector<mesh::TrianglePoints> triangles = walk.triangles();
  Eigen::AlignedBox3f box;
  for (const mesh::TrianglePoints& points : triangles) box.extend(Eigen::Vector3f(points[0].data()));
  const double size = box.diagonal().cast<double>().norm();
  std::mt19937_64 random(1);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  Eigen::Vector3d at, along;
  for (std::size_t i = 0; i < tests::drawn(480); ++i) {
    if (i % 8 == 0) {
      const mesh::TrianglePoints& points = triangles[random() % triangles.size()];
      const auto corner = [&](std::size_t k) -> Eigen::Vector3d { return Eigen::Vector3f(points[k].data()).cast<double>(); };
      const Eigen::Vector3d u = corner(1) - corner(0), v = corner(2) - corner(0), n = u.cross(v).normalized();
      const double a = uniform(0, 1), b = uniform(0, 1 - a);
      at = corner(0) + a * u + b * v + 0.01 * size * n;
      along = -0.03 * n;  // past the surface, then aside
    } else {
      at += size * along;
      if (i % 8 == 1)
        for (double& component : along) component = uniform(-0.04, 0.04);
    }
    const Eigen::Vector3f position = at.cwiseMax(-1e4).cwiseMin(1e4).cast<float>();
    walk.path.push_back({position.x(), position.y(), position.z()});
  }
  walk.beside = walk.path.front();
  return walk;
}

TEST(real_soups, have_every_property) {
  const char* const folder = std::getenv("FORCESHADE_REAL_SOUPS");
  Counts all;
  for (const auto& [name, triangles] : folder == nullptr ? made_meshes() : read_meshes(folder)) {
    const auto checked = mesh::check_any(triangles);
    if (!std::holds_alternative<mesh::CheckedMesh>(checked)) continue;  // no triangle has an area
    const Walk walk = strokes_on(std::get<mesh::CheckedMesh>(checked));
    Counts counts;
    for (const auto& [property, holds] : kProperties) {
      const Violation violation = holds(walk, in_real_time, counts);
      EXPECT_FALSE(violation) << name << ": " << property << ": " << *violation;
    }
    std::printf("%s, %zu triangles, sides %s:", name.c_str(), triangles.triangles.size(),
                std::string(name_of(walk.rendering.sides)).c_str());
    for (const auto& [what, count] : counts) {
      std::printf(" %zu %s,", count, what.c_str());
      all[what] += count;
    }
    std::printf(" %zu ticks\n", walk.path.size());
  }
  for (const char* what : {"irregular", "touching", "flights", "windings", "rests"}) EXPECT_GT(all[what], 0U) << what;
}

}  // namespace
}  // namespace forceshade::properties
