// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/invariants/trial.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "files/csv.h"
#include "properties/binary32.h"

namespace forceshade::conformance {
namespace {

using properties::Aim;

constexpr float kAbove = 2, kBelow = 1;  // mm
constexpr std::size_t kMostApproaches = 20;
constexpr int kMostDrawn = 4000;  // positions in which to look for some in contact
constexpr float kHighest = 5000;  // mm: no approach begins higher

// The status of the exact side at the last position of a path.
Status exact_status(const Trial& trial, const Path& path) {
  const auto session = trial.subject.open_reference();
  Status status = Status::invalid;
  for (const Eigen::Vector3f& position : path) status = finished(session->step(position).status);
  return status;
}

bool is_approach(const Trial& trial, const Approach& approach) {
  const SceneRenderer& renderer = trial.renderer;
  return renderer.is_in_domain(approach.air) && exact_status(trial, {approach.air}) == Status::free &&
         exact_status(trial, {approach.air, approach.contact}) == Status::contact;
}

// From above, as laws and height maps lie.
std::optional<Approach> from_above(const Trial& trial, const Eigen::Vector3f& contact) {
  if (exact_status(trial, {contact}) != Status::contact) return std::nullopt;
  for (float height = kAbove; height < kHighest; height *= 2) {
    const Eigen::Vector3f air = trial.renderer.writable(contact + Eigen::Vector3f(0, 0, height));
    // Free a little below, too: a renderer that rounds has no contact there either.
    const Eigen::Vector3f below = trial.renderer.writable(air - Eigen::Vector3f(0, 0, kBelow));
    if (exact_status(trial, {below}) == Status::free && is_approach(trial, {air, contact})) return Approach{air, contact};
  }
  return std::nullopt;
}

Eigen::Vector3d vector_of(const mesh::Vertex& vertex) {
  return Eigen::Vector3f(vertex.data()).cast<double>();
}

struct Facing {
  Eigen::Vector3d middle, normal;  // mm; of length 1
};

Facing facing(const mesh::TriangleMesh& mesh, const mesh::Triangle& triangle) {
  const Eigen::Vector3d a = vector_of(mesh.vertices[triangle[0]]), b = vector_of(mesh.vertices[triangle[1]]),
                        c = vector_of(mesh.vertices[triangle[2]]);
  return {(a + b + c) / 3, (b - a).cross(c - a).normalized()};
}

// Along a triangle's normal, from outside the box around the mesh to a point behind the triangle.
std::optional<Approach> from_outside(const Trial& trial, const mesh::TriangleMesh& mesh, const mesh::Triangle& triangle) {
  const auto [middle, normal] = facing(mesh, triangle);
  Eigen::Vector3d low = middle, high = middle;
  for (const mesh::Vertex& vertex : mesh.vertices) {
    low = low.cwiseMin(vector_of(vertex));
    high = high.cwiseMax(vector_of(vertex));
  }
  double far = 1e300;  // to where the normal leaves the box
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (normal[axis] != 0) far = std::min(far, ((normal[axis] > 0 ? high : low)[axis] - middle[axis]) / normal[axis]);
  const Approach approach{
      trial.renderer.writable((middle + (std::max(far, 0.0) + static_cast<double>(kAbove)) * normal).cast<float>()),
      trial.renderer.writable((middle - static_cast<double>(kBelow) * normal).cast<float>())};
  if (!is_approach(trial, approach)) return std::nullopt;
  return approach;
}

}  // namespace

Path drawn_path(const Trial& trial, std::size_t size, std::uint64_t seed) {
  const auto positions = trial.subject.positions(seed);
  Path path;
  while (path.size() < size) {
    const Eigen::Vector3f position = trial.renderer.writable(positions->next().position);
    if (trial.renderer.is_in_domain(position)) path.push_back(position);
  }
  return path;
}

Path Approach::line(const SceneRenderer& renderer, int steps) const {
  Path path;
  for (int i = 0; i <= steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(steps);
    path.push_back(i == steps ? contact : renderer.writable(air + share * (contact - air)));
  }
  return path;
}

std::vector<Approach> approaches_to(const Trial& trial) {
  std::vector<Approach> all;
  if (trial.moves()) return all;
  const auto positions = trial.subject.positions(trial.seed + 2);
  const auto* mesh = std::get_if<MeshRendering>(&trial.description.what);
  for (int drawn = 0; drawn < kMostDrawn && all.size() < kMostApproaches; ++drawn) {
    if (drawn % 64 == 0) trial.monitor.at(0.92);
    const properties::Aimed aimed = positions->next();
    std::optional<Approach> approach;
    if (mesh != nullptr) {
      const auto& triangles = mesh->mesh().triangles;
      approach = from_outside(trial, mesh->mesh(), triangles[static_cast<std::size_t>(drawn) * 7919 % triangles.size()]);
    } else if (const Eigen::Vector3f contact = trial.renderer.writable(aimed.position);
               aimed.aim == Aim::volume && trial.renderer.is_in_domain(contact)) {
      approach = from_above(trial, contact);
    }
    if (approach) all.push_back(*approach);
  }
  return all;
}

Path through_triangle(const mesh::TriangleMesh& mesh, std::size_t triangle, const SceneRenderer& renderer) {
  const auto [middle, normal] = facing(mesh, mesh.triangles[triangle]);
  return {renderer.writable((middle + normal).cast<float>()), renderer.writable((middle - 0.5 * normal).cast<float>())};
}

bool differ(const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
  constexpr float kShare = 1e-3F, kLeast = 1e-4F;
  return !((one - other).norm() <= std::max(kLeast, kShare * std::max(one.norm(), other.norm())));
}

bool same_bits(const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
  return std::equal(one.begin(), one.end(), other.begin(), properties::same_bits);
}

std::string newtons(const Eigen::Vector3f& force) {
  return shortest(force.cast<double>().norm()) + " N";
}

}  // namespace forceshade::conformance
