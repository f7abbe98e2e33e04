// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/simulation.h"

#include <Eigen/LU>
#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace forceshade::conformance::simulators {
namespace {

using SceneJson = nlohmann::ordered_json;

SceneJson ground_json(const Simulation& scene) {
  if (const auto* box = std::get_if<GroundBox>(&scene.ground))
    return {{"box",
             {{"half", json_of(scene.units_per_metre * box->half)}, {"centre", json_of(scene.units_per_metre * box->centre)}}}};
  const auto& mesh = std::get<GroundMesh>(scene.ground);
  SceneJson json{{"vertices", SceneJson::array()}, {"triangles", mesh.triangles}, {"sides", "one"}};
  for (const Eigen::Vector3d& vertex : mesh.vertices) json["vertices"].push_back(json_of(scene.units_per_metre * vertex));
  return json;
}

// The numbers below `size` in an order that is the same on every machine.
std::vector<std::uint32_t> shuffled(std::size_t size, std::mt19937_64& random) {
  std::vector<std::uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t left = size; left > 1; --left) std::swap(order[left - 1], order[random() % left]);
  return order;
}

constexpr double kHalfWidth = 1.2;

Profile divided(const Profile& profile, unsigned parts) {
  Profile all{profile.front()};
  for (std::size_t i = 1; i < profile.size(); ++i)
    for (unsigned part = 1; part <= parts; ++part)
      all.push_back(profile[i - 1] + (profile[i] - profile[i - 1]) * (static_cast<double>(part) / parts));
  return all;
}

bool is_rising(Diagonals diagonals, std::size_t cell) {
  return diagonals == Diagonals::rising || (diagonals == Diagonals::alternating && cell % 2 == 0);
}

// In [-1, 1), the same on every machine.
double drawn(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1p-52 - 1;
}

}  // namespace

SceneJson json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

SceneJson json_of(const Simulation& scene) {
  const double units = scene.units_per_metre;
  return {{"kind", "simulation"},
          {"name", scene.name},
          {"units_per_metre", units},
          {"rate_Hz", scene.rate},
          {"gravity", json_of(units * scene.gravity)},
          {"friction", 0},
          {"ground", ground_json(scene)},
          {"sphere",
           {{"radius", units * scene.radius},
            {"mass_kg", scene.mass},
            {"position", json_of(units * scene.position)},
            {"velocity", json_of(units * scene.velocity)},
            {"turns", false}}}};
}

Simulation transformed(Simulation scene, const Eigen::Matrix3d& by) {
  scene.gravity = by * scene.gravity;
  scene.position = by * scene.position;
  scene.velocity = by * scene.velocity;
  if (auto* box = std::get_if<GroundBox>(&scene.ground)) {
    box->half = by.cwiseAbs() * box->half;
    box->centre = by * box->centre;
    return scene;
  }
  auto& mesh = std::get<GroundMesh>(scene.ground);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = by * vertex;
  if (by.determinant() < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return scene;
}

Simulation renumbered(Simulation scene) {
  auto* mesh = std::get_if<GroundMesh>(&scene.ground);
  if (mesh == nullptr) return scene;
  std::mt19937_64 random(1);
  const std::vector<std::uint32_t> new_number = shuffled(mesh->vertices.size(), random),
                                   order = shuffled(mesh->triangles.size(), random);
  GroundMesh other = *mesh;
  for (std::size_t i = 0; i < new_number.size(); ++i) other.vertices[new_number[i]] = mesh->vertices[i];
  for (std::size_t i = 0; i < order.size(); ++i) {
    auto triangle = mesh->triangles[order[i]];
    std::ranges::rotate(triangle, triangle.begin() + static_cast<std::ptrdiff_t>(i % 3));
    for (std::uint32_t& corner : triangle) corner = new_number[corner];
    other.triangles[i] = triangle;
  }
  *mesh = std::move(other);
  return scene;
}

Simulation doubled(Simulation scene) {
  auto& triangles = std::get<GroundMesh>(scene.ground).triangles;
  scene.name += ", each triangle twice";
  triangles.reserve(2 * triangles.size());
  std::copy_n(triangles.begin(), triangles.size(), std::back_inserter(triangles));
  return scene;
}

Simulation split(Simulation scene) {
  auto& [vertices, triangles] = std::get<GroundMesh>(scene.ground);
  scene.name += ", every second triangle in two";
  for (std::size_t i = triangles.size(); i > 0; --i) {
    if (i % 2 == 0) continue;
    const auto [a, b, c] = triangles[i - 1];
    const auto middle = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back((vertices[a] + vertices[c]) / 2);
    triangles[i - 1] = {a, b, middle};
    triangles.push_back({middle, b, c});
  }
  return scene;
}

GroundMesh mesh_of(const Profile& profile, const Tessellation& tessellation) {
  const Profile line = divided(profile, tessellation.along);
  const unsigned across = tessellation.across;
  const double cell = 2 * kHalfWidth / across;
  std::mt19937_64 random(1);
  GroundMesh mesh;
  for (std::size_t i = 0; i < line.size(); ++i)
    for (unsigned j = 0; j <= across; ++j) {
      Eigen::Vector3d vertex(line[i].x(), -kHalfWidth + cell * j, line[i].y());
      if (i > 0 && i + 1 < line.size() && j > 0 && j < across && tessellation.moved > 0)
        vertex += tessellation.moved * cell * Eigen::Vector3d(drawn(random), drawn(random), 0);
      mesh.vertices.push_back(vertex);
    }
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t a = i * (across + 1) + j, d = a + 1, b = a + across + 1, c = b + 1;
      const bool rising = is_rising(tessellation.diagonals, i + j);
      mesh.triangles.push_back({a, b, rising ? c : d});
      mesh.triangles.push_back({rising ? a : b, c, d});
    }
  return mesh;
}

Nearest nearest(const Profile& profile, const Eigen::Vector3d& centre) {
  const Eigen::Vector2d at(centre.x(), centre.z());
  Nearest found{std::numeric_limits<double>::infinity()};
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d from = profile[i - 1], part = profile[i] - from;
    const double share = std::clamp(part.dot(at - from) / part.squaredNorm(), 0.0, 1.0);
    const Eigen::Vector2d way = at - (from + share * part);
    if (way.norm() < found.distance) found = {way.norm(), Eigen::Vector3d(way.x(), 0, way.y()) / way.norm()};
    if (std::min(from.x(), profile[i].x()) <= at.x() && at.x() <= std::max(from.x(), profile[i].x()))
      height = std::max(
          height, part.x() == 0 ? std::max(from.y(), profile[i].y()) : from.y() + part.y() * (at.x() - from.x()) / part.x());
  }
  if (at.y() < height) found = {-found.distance, -found.normal};
  return found;
}

}  // namespace forceshade::conformance::simulators
