// SPDX-License-Identifier: BSD-3-Clause
// The largest turns of the force by the vertex scheme on one mesh, by the god-object's place. The proofs are in
// properties/mesh_energy.md.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "properties/mesh_energy.h"
#include "rendering/half_edges.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::properties {
namespace {

using mesh::end_of, mesh::previous_in_triangle, mesh::start_of;

constexpr std::size_t kMostRays = 64;  // of a vertex whose directions are tried by pairs
constexpr double kSlack = 1e-9;        // of a sine: a direction that is outside by less counts as inside

// The chord of an angle below 90° with this sine.
double chord_of(double sine) {
  return sine < 1 ? 2 * std::sin(std::asin(sine) / 2) : std::numbers::sqrt2;
}

// The sine by which the second triangle rises in front of the plane of the first, seen from their common edge. n: the unit
// normal of the first. one, other: the half-edges of both along this edge (rendering/half_edges.h).
double rise_beside(const mesh::TriangleMesh& mesh, const Eigen::Vector3d& n, std::uint32_t one, std::uint32_t other) {
  const Eigen::Vector3d begin = vector_of(mesh.vertices[start_of(mesh, one)]);
  return n.dot((vector_of(mesh.vertices[start_of(mesh, previous_in_triangle(other))]) - begin).normalized());
}

// Unit vectors along the half-edges.
std::vector<Eigen::Vector3d> edges_from(const mesh::TriangleMesh& mesh, const std::vector<std::uint32_t>& half_edges) {
  std::vector<Eigen::Vector3d> edges;
  for (const std::uint32_t h : half_edges)
    edges.push_back((vector_of(mesh.vertices[end_of(mesh, h)]) - vector_of(mesh.vertices[start_of(mesh, h)])).normalized());
  return edges;
}

// Unit vectors along the extreme rays of all D with D·e >= 0 for each of these unit vectors: each is at a right angle to two of
// them. Nothing where these are more than 64.
std::optional<std::vector<Eigen::Vector3d>> extreme_rays(const std::vector<Eigen::Vector3d>& edges) {
  if (edges.size() > kMostRays) return std::nullopt;
  std::vector<Eigen::Vector3d> rays;
  for (const Eigen::Vector3d& e : edges)
    for (const Eigen::Vector3d& f : edges) {
      const Eigen::Vector3d ray = e.cross(f);
      if (ray.norm() <= kSlack) continue;
      const Eigen::Vector3d D = ray.normalized();
      if (std::ranges::none_of(edges, [&](const Eigen::Vector3d& edge) { return D.dot(edge) < -kSlack; })) rays.push_back(D);
    }
  return rays;
}

class Turns {
 public:
  explicit Turns(const MeshRendering& rendering) : rendering_(rendering), mesh_(rendering.mesh()) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) faces_.push_back(unit_normal(mesh_, t));
  }

  LargestTurns all() const {
    LargestTurns turns;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      turns.of_triangle.push_back(largest_turn(rendering_, t));
      turns.inside_at_least = std::max(turns.inside_at_least, turns.of_triangle[t] - 2 * faces_[t].error);
    }
    turns.inside = std::ranges::max(turns.of_triangle);
    if (!rendering_.checked.is_regular()) {  // of a triangle others can lie in front, and where they meet nothing is bounded
      turns.inside_at_least = 0;
      turns.edges = turns.vertices = std::numbers::sqrt2;
      return turns;
    }
    for_each_edge(mesh_, [&](std::span<const std::uint32_t> half_edges) {
      if (half_edges.size() == 2) turns.edges = std::max(turns.edges, on_edge(half_edges[0], half_edges[1], turns.of_triangle));
    });
    turns.vertices = at_vertices();
    return turns;
  }

 private:
  // The corner's where the half-edge starts.
  const mesh::Normal& normal(std::uint32_t half_edge) const { return rendering_.normals[half_edge / 3][half_edge % 3]; }
  // Those of the normal of its triangle.
  const Eigen::Vector3d& direction(std::uint32_t half_edge) const { return faces_[half_edge / 3].direction; }
  double error(std::uint32_t half_edge) const { return faces_[half_edge / 3].error; }

  // True if the god-object can rest on the edge, as in a valley.
  bool is_valley(std::uint32_t one, std::uint32_t other) const {
    const double rises = rise_beside(mesh_, direction(one), one, other);
    return rises > -kSlack || (rendering_.sides == mesh::Sides::both && rises < kSlack);
  }

  // D is a n + b m, a and b >= 0, n and m the unit normals of both triangles. Where these have the same normals N at the edge,
  // D is no farther from N than n or m is. Else N = a (1 + ε) N₁ + b (1 + ε') N₂, |ε| <= 2^-24, and the sine of the angle
  // between N and D is at most |N - D|/|D|.
  double on_edge(std::uint32_t one, std::uint32_t other, const std::vector<double>& inside) const {
    if (!is_valley(one, other)) return 0;
    const std::uint32_t end_of_one = mesh::next_in_triangle(one), end_of_other = mesh::next_in_triangle(other);
    if (normal(one) == normal(end_of_other) && normal(end_of_one) == normal(other))
      return std::max(inside[one / 3], inside[other / 3]);
    double off = 0;
    for (const std::uint32_t corner : {one, end_of_one, other, end_of_other}) {
      const Eigen::Vector3d N = vector_of(normal(corner));
      off = std::max(off, (N - direction(corner)).norm() + error(corner) + 0x1p-23 * N.norm());
    }
    const double least = (direction(one) + direction(other)).norm() / 2 - error(one) - error(other);
    return least > 0 ? chord_of(off / least) : std::numbers::sqrt2;
  }

  // Only where all corners have the same normal is one used there, and never at the rim.
  double at_vertices() const {
    const std::vector<std::uint32_t> opposite = opposite_half_edges(mesh_);
    std::vector<std::vector<std::uint32_t>> starting(mesh_.vertices.size());
    for (std::uint32_t h = 0; h < opposite.size(); ++h) starting[start_of(mesh_, h)].push_back(h);
    double turn = 0;
    for (const std::vector<std::uint32_t>& half_edges : starting) {
      const bool is_shaded = std::ranges::all_of(half_edges, [&](std::uint32_t h) {
        return opposite[h] != mesh::kNoEdge && opposite[mesh::previous_in_triangle(h)] != mesh::kNoEdge &&
               normal(h) == normal(half_edges.front());
      });
      if (is_shaded && !half_edges.empty()) turn = std::max(turn, at_vertex(half_edges));
    }
    return turn;
  }

  // At rest D·e >= 0 for every edge e from the vertex, and D is on the god-object's side. No D of that cone is farther from the
  // normal N than the farthest of the cone's extreme rays, each of which is at a right angle to two edges.
  double at_vertex(const std::vector<std::uint32_t>& half_edges) const {
    const Eigen::Vector3d N = vector_of(normal(half_edges.front())).normalized();
    const auto rays = extreme_rays(edges_from(mesh_, half_edges));
    if (!rays) return std::numbers::sqrt2;
    double turn = 0;
    for (const Eigen::Vector3d& D : *rays) {
      const auto points_to = [&](double sign) {
        return std::ranges::any_of(half_edges, [&](std::uint32_t h) { return sign * D.dot(direction(h)) > -kSlack; });
      };
      for (const double sign : {1.0, -1.0})  // from the front; from behind, where N is negated
        if (points_to(sign) && (sign > 0 || rendering_.sides == mesh::Sides::both)) {
          const double cosine = sign * N.dot(D);
          turn = std::max(turn, cosine > kSlack ? std::sqrt(2 - 2 * std::min(cosine, 1.0)) + kSlack : std::numbers::sqrt2);
        }
    }
    return std::min(turn, std::numbers::sqrt2);
  }

  const MeshRendering& rendering_;
  const mesh::TriangleMesh& mesh_;
  std::vector<UnitNormal> faces_;
};

}  // namespace

std::string why_no_energy_bound(const MeshRendering& rendering) {
  if (rendering.shading != mesh::Shading::none && rendering.shading != mesh::Shading::vertex_scheme)
    return "expected the shading none or vertex, got another one";
  if (rendering.contact == mesh::Contact::sub_goal) return "expected the contact rule direct, got sub-goal";
  if (has_friction(rendering.materials)) return "expected a mesh without friction, got coefficients of friction";
  if (has_own_stiffness(rendering.materials)) return "expected one stiffness, got materials with their own";
  return "";
}

double LargestTurns::most() const {
  return std::max({inside, edges, vertices});
}

LargestTurns largest_turns(const MeshRendering& rendering) {
  if (rendering.shading == mesh::Shading::none)
    return {.of_triangle = std::vector<double>(rendering.mesh().triangles.size(), 0.0)};
  return Turns(rendering).all();
}

}  // namespace forceshade::properties
