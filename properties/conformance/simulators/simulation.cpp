// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/simulation.h"

#include <Eigen/LU>
#include <algorithm>
#include <iterator>
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

}  // namespace forceshade::conformance::simulators
