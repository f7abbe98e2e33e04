// SPDX-License-Identifier: BSD-3-Clause
// How far the vertex scheme turns a force on one mesh, by where the god-object rests. The proofs are in docs/energy.md.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "properties/mesh_energy.h"
#include "properties/rest_regions.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::properties {
namespace {

constexpr double kSlack = 1e-9;  // of a sine: a direction that is outside by less counts as inside

// The chord of an angle below 90° with this sine.
double chord_of(double sine) {
  return sine < 1 ? 2 * std::sin(std::asin(sine) / 2) : std::numbers::sqrt2;
}

class Turns {
 public:
  explicit Turns(const MeshRendering& rendering) : rendering_(rendering), mesh_(rendering.mesh()) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      faces_.push_back(unit_normal(mesh_, t));
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh_.triangles[t][i], w = mesh_.triangles[t][(i + 1) % 3];
        sides_[std::minmax(v, w)].push_back({t, i});
      }
    }
  }

  LargestTurns all() const {
    LargestTurns turns;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      turns.of_triangle.push_back(largest_turn(rendering_, t));
      turns.inside_at_least = std::max(turns.inside_at_least, turns.of_triangle[t] - 2 * error(t));
    }
    turns.inside = std::ranges::max(turns.of_triangle);
    for (const auto& [ends, sides] : sides_)
      if (sides.size() == 2) turns.edges = std::max(turns.edges, on_edge(sides[0], sides[1], turns.of_triangle));
    turns.vertices = at_vertices();
    return turns;
  }

 private:
  struct Side {
    std::uint32_t triangle;
    std::size_t corner;  // at which it begins
  };

  Eigen::Vector3d vertex(std::uint32_t v) const { return vector_of(mesh_.vertices[v]); }
  Eigen::Vector3d corner(std::uint32_t t, std::size_t i) const { return vertex(mesh_.triangles[t][i % 3]); }
  Eigen::Vector3d normal(std::uint32_t t, std::size_t i) const { return vector_of(rendering_.normals[t][i % 3]); }
  const Eigen::Vector3d& direction(std::uint32_t t) const { return faces_[t].direction; }
  double error(std::uint32_t t) const { return faces_[t].error; }

  // Whether the god-object can rest on the edge, as in a valley.
  bool is_valley(const Side& a, const Side& b) const {
    const Eigen::Vector3d off = (corner(b.triangle, b.corner + 2) - corner(a.triangle, a.corner)).normalized();
    const double rises = direction(a.triangle).dot(off);
    return rises > -kSlack || (rendering_.sides == mesh::Sides::both && rises < kSlack);
  }

  // D is a n + b m, a and b >= 0, n and m the unit normals of both triangles. Where these have the same normals N at the edge,
  // D is no farther from N than n or m is. Else N = a (1 + ε) N₁ + b (1 + ε') N₂, |ε| <= 2^-24, and the sine of the angle
  // between N and D is at most |N - D|/|D|.
  double on_edge(const Side& a, const Side& b, const std::vector<double>& inside) const {
    if (!is_valley(a, b)) return 0;
    const auto is_same = [&](std::size_t i, std::size_t j) {
      return rendering_.normals[a.triangle][i % 3] == rendering_.normals[b.triangle][j % 3];
    };
    if (is_same(a.corner, b.corner + 1) && is_same(a.corner + 1, b.corner))
      return std::max(inside[a.triangle], inside[b.triangle]);
    double off = 0;
    for (const Side& side : {a, b})
      for (const std::size_t i : {side.corner, side.corner + 1}) {
        const Eigen::Vector3d N = normal(side.triangle, i);
        off = std::max(off, (N - direction(side.triangle)).norm() + error(side.triangle) + 0x1p-23 * N.norm());
      }
    const double least = (direction(a.triangle) + direction(b.triangle)).norm() / 2 - error(a.triangle) - error(b.triangle);
    return least > 0 ? chord_of(off / least) : std::numbers::sqrt2;
  }

  struct Around {
    std::set<std::uint32_t> vertices;
    std::vector<std::uint32_t> triangles;
    std::optional<mesh::Normal> normal;  // of all corners, where they have the same
    bool is_shaded = true;               // as it is where they have, but at the rim
  };

  double at_vertices() const {
    std::map<std::uint32_t, Around> all;
    for (const auto& [ends, sides] : sides_)
      for (const auto& [v, w] : {ends, std::pair(ends.second, ends.first)}) {
        all[v].vertices.insert(w);
        all[v].is_shaded &= sides.size() == 2;
      }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        Around& around = all[mesh_.triangles[t][i]];
        around.triangles.push_back(t);
        if (!around.normal) around.normal = rendering_.normals[t][i];
        around.is_shaded &= *around.normal == rendering_.normals[t][i];
      }
    double turn = 0;
    for (const auto& [v, around] : all)
      if (around.is_shaded) turn = std::max(turn, at_vertex(v, around));
    return turn;
  }

  // At rest D·e >= 0 for every edge e from the vertex, and D is on the god-object's side. No D of that cone is farther from the
  // normal N than the farthest of the cone's extreme rays, each of which is at a right angle to two edges.
  double at_vertex(std::uint32_t v, const Around& around) const {
    const Eigen::Vector3d N = vector_of(*around.normal).normalized();
    std::vector<Eigen::Vector3d> edges;
    for (const std::uint32_t w : around.vertices) edges.push_back((vertex(w) - vertex(v)).normalized());
    const auto rays = extreme_rays(edges);
    if (!rays) return std::numbers::sqrt2;
    double turn = 0;
    for (const Eigen::Vector3d& D : *rays) {
      const auto points_to = [&](double sign) {
        return std::ranges::any_of(around.triangles, [&](auto t) { return sign * D.dot(direction(t)) > -kSlack; });
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
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> sides_;
};

}  // namespace

std::string why_no_energy_bound(const MeshRendering& rendering) {
  if (rendering.shading != mesh::Shading::none && rendering.shading != mesh::Shading::vertex_scheme)
    return "expected the shading none or vertex, got another one";
  if (rendering.contact == mesh::Contact::sub_goal) return "expected the contact rule direct, got sub-goal";
  if (has_friction(rendering.materials)) return "expected a mesh without friction, got coefficients of friction";
  if (has_own_stiffness(rendering.materials)) return "expected one stiffness, got materials with their own";
  if (rendering.checked.self_intersections() == mesh::SelfIntersections::allowed)
    return "expected a mesh that does not cross itself, got one that may";
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
