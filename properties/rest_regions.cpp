// SPDX-License-Identifier: BSD-3-Clause
#include "properties/rest_regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "properties/mesh_properties.h"
#include "rendering/half_edges.h"

namespace forceshade::properties {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using mesh::end_of, mesh::next_in_triangle, mesh::previous_in_triangle, mesh::start_of;

constexpr std::size_t kMostRays = 64;     // of a vertex whose directions are tried by pairs
constexpr double kOutside = 1e-9;         // of a sine: a direction that is outside by less counts as inside
constexpr double kIllConditioned = 1e-4;  // the volume of three unit vectors from which on their common point is less sure

class Regions {
 public:
  Regions(const MeshRendering& rendering, double depth)
      : rendering_(rendering),
        mesh_(rendering.mesh()),
        depth_(depth),
        sides_(rendering.sides == mesh::Sides::both ? 2 : 1),
        opposite_(opposite_half_edges(mesh_)),
        vertices_(mesh_.vertices.size()) {}

  RestRegions all() {
    found_.has_two_sides = sides_ == 2;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) add_faces(t);
    for_each_edge(mesh_, [&](std::span<const std::uint32_t> half_edges) { add_edge(half_edges); });
    for (const Around& around : vertices_)
      for (std::uint32_t behind = 0; behind < sides_; ++behind) add_vertex(around, behind);
    return std::move(found_);
  }

 private:
  struct Around {
    std::vector<std::uint32_t> half_edges;  // that start at this vertex
    bool is_at_rim = false;
  };

  Vector3d vertex(std::uint32_t v) const { return vector_of(mesh_.vertices[v]); }
  std::uint32_t face(std::uint32_t half_edge, std::uint32_t behind) const { return half_edge / 3 * sides_ + behind; }
  const Vector3d& out_of(std::uint32_t half_edge, std::uint32_t behind) const {
    return found_.faces[face(half_edge, behind)].out;
  }
  // The corner's where the half-edge starts.
  const mesh::Normal& corner_normal(std::uint32_t half_edge) const { return rendering_.normals[half_edge / 3][half_edge % 3]; }
  // The unit vector along it, for the side.
  Vector3d normal(std::uint32_t half_edge, std::uint32_t behind) const {
    const Vector3d N = vector_of(corner_normal(half_edge)).normalized();
    return behind == 1 ? Vector3d(-N) : N;
  }
  bool is_shaded() const { return rendering_.shading == mesh::Shading::vertex_scheme; }

  // of_D: D is along a sum of these. A normal counts only where N·D > 0, so that else nothing is known of the direction.
  // about: a point of the mesh where the god-object rests; size: mm, of the region.
  std::uint32_t add(RestRegion region, const std::vector<Vector3d>& of_D, const Vector3d& about, double size) {
    const bool has_all = !is_shaded() || std::ranges::all_of(of_D, [&](const Vector3d& n) {
      return std::ranges::all_of(region.directions, [&](const Vector3d& N) { return N.dot(n) > kOutside; });
    });
    if (!has_all) {
      region.normal.reset();
      region.directions.clear();
    }
    for_each_corner(region.borders, about, kOutside * size, [&](const Vector3d& p) { region.corners.push_back(p); });
    region.low = region.high = about;
    for (const Vector3d& corner : region.corners) {
      region.low = region.low.cwiseMin(corner);
      region.high = region.high.cwiseMax(corner);
    }
    found_.all.push_back(std::move(region));
    return static_cast<std::uint32_t>(found_.all.size() - 1);
  }

  void put_on(std::uint32_t region, std::uint32_t face) {
    found_.faces[face].regions.push_back(region);
    if (found_.face_of.size() == region) found_.face_of.push_back(face);
  }

  // D is along n: inside of three planes, and between the triangle and the depth.
  void add_faces(std::uint32_t t) {
    const mesh::Triangle& triangle = mesh_.triangles[t];
    const std::array<Vector3d, 3> corners{vertex(triangle[0]), vertex(triangle[1]), vertex(triangle[2])};
    const Vector3d n = unit_normal(mesh_, t).direction;
    const double size = depth_ + (corners[1] - corners[0]).norm() + (corners[2] - corners[0]).norm();
    for (std::uint32_t behind = 0; behind < sides_; ++behind) {
      const Vector3d out = behind == 1 ? Vector3d(-n) : n;
      found_.faces.push_back({corners, out, {}, {}});
      RestRegion region{.D = {-out * out.transpose(), out * out.dot(corners[0])}, .out = out};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d in = n.cross(corners[(i + 1) % 3] - corners[i]).normalized();
        region.borders.push_back({in, in.dot(corners[i]), true});
      }
      region.borders.push_back({-out, -out.dot(corners[0]), true});
      region.borders.push_back({out, out.dot(corners[0]) - depth_});
      if (is_shaded())
        interpolate(region, t, corners, n, behind);
      else
        region.directions = {out};
      put_on(add(std::move(region), {out}, corners[0], size), face(3 * t, behind));
    }
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) vertices_[start_of(mesh_, h)].half_edges.push_back(h);
  }

  // N is the sum of the corners' normals with the barycentric coordinates as weights: with the edges a, b and the normal as a
  // basis, each is linear in the position.
  void interpolate(RestRegion& region, std::uint32_t t, const std::array<Vector3d, 3>& corners, const Vector3d& n,
                   std::uint32_t behind) const {
    Matrix3d edges, changes;
    edges << corners[1] - corners[0], corners[2] - corners[0], n;
    std::array<Vector3d, 3> normals;
    for (std::size_t i = 0; i < 3; ++i) {
      normals[i] = vector_of(rendering_.normals[t][i]) * (behind == 1 ? -1 : 1);
      region.directions.push_back(normals[i].normalized());
    }
    changes << normals[1] - normals[0], normals[2] - normals[0], Vector3d::Zero();
    const Matrix3d factor = changes * edges.inverse();
    const Vector3d mean = (region.directions[0] + region.directions[1] + region.directions[2]).normalized();
    region.least_normal = std::min({mean.dot(normals[0]), mean.dot(normals[1]), mean.dot(normals[2])});
    if (region.least_normal > kOutside) region.normal = Affine{factor, normals[0] - factor * corners[0]};
  }

  void add_edge(std::span<const std::uint32_t> half_edges) {
    const std::uint32_t one = half_edges.front(), other = half_edges.back();
    if (half_edges.size() == 1) {
      const std::uint32_t v = start_of(mesh_, one), w = end_of(mesh_, one);
      vertices_[v].is_at_rim = vertices_[w].is_at_rim = true;
      found_.rim.push_back({vertex(v), vertex(w)});
      return;
    }
    for (std::uint32_t behind = 0; behind < sides_; ++behind) {
      found_.faces[face(one, behind)].beside.push_back(face(other, behind));
      found_.faces[face(other, behind)].beside.push_back(face(one, behind));
      if (!is_flat(half_edges)) add_valley(one, other, behind);
    }
  }

  // True if D has the one direction that it has inside the triangles around.
  bool is_flat(std::span<const std::uint32_t> around) const {
    return std::ranges::all_of(around,
                               [&](std::uint32_t h) { return (out_of(around[0], 0) - out_of(h, 0)).norm() <= kOutside; });
  }

  // D = a n + b m with a, b >= 0, n and m the normals of both faces, where these rise from each other. It is no longer than the
  // depth, neither along n or m nor between them.
  void add_valley(std::uint32_t one, std::uint32_t other, std::uint32_t behind) {
    const Vector3d begin = vertex(start_of(mesh_, one)), end = vertex(end_of(mesh_, one)), along = (end - begin).normalized();
    const Vector3d n = out_of(one, behind), m = out_of(other, behind);
    if (rise_beside(mesh_, n, one, other) < -kOutside) return;
    RestRegion region{.D = {along * along.transpose() - Matrix3d::Identity(), begin - along * along.dot(begin)}};
    region.borders = {{along, along.dot(begin), true}, {-along, -along.dot(end), true}};
    // At a right angle to n or m, and towards the other one. Where n and m are nearly the same, so are these.
    const Vector3d to_m = behind == 1 ? m.cross(along) : along.cross(m), to_n = behind == 1 ? along.cross(n) : n.cross(along);
    for (const Vector3d& side : {to_m, to_n}) {
      const Vector3d inner = side.dot(n + m) < 0 ? Vector3d(-side) : side;
      region.borders.push_back({-inner, -inner.dot(begin) - kOutside * depth_, true});
    }
    const Vector3d between = (n + m).normalized();
    for (const Vector3d& far : {n, m, between}) region.borders.push_back({far, far.dot(begin) - depth_});
    region.borders.push_back({-between, -between.dot(begin)});
    // These follow, but not where all borders are moved outwards: a thin wedge then grows by much more than they move.
    const Vector3d aside = along.cross(between);
    const double most = depth_ * (n - m).norm() / 2;  // the sine of half the angle between n and m
    for (const Vector3d& far : {aside, Vector3d(-aside)})
      region.borders.push_back({far, far.dot(begin) - most - kOutside * depth_});
    if (is_shaded())
      for (const std::uint32_t h : {one, next_in_triangle(one), other, next_in_triangle(other)})
        region.directions.push_back(normal(h, behind));
    else
      region.directions = {n, m};
    const std::uint32_t index = add(std::move(region), {n, m}, begin, depth_ + (end - begin).norm());
    put_on(index, face(one, behind));
    put_on(index, face(other, behind));
  }

  // D·e >= 0 for each edge e from the vertex.
  void add_vertex(const Around& around, std::uint32_t behind) {
    if (around.is_at_rim || is_flat(around.half_edges)) return;
    const std::vector<Vector3d> edges = edges_from(mesh_, around.half_edges);
    std::optional<std::vector<Vector3d>> rays = extreme_rays(edges);
    if (rays && !is_on_side(around.half_edges, edges, behind, *rays)) return;
    const std::uint32_t first = around.half_edges.front();
    const Vector3d tip = vertex(start_of(mesh_, first));
    RestRegion region{.D = {-Matrix3d::Identity(), tip}};
    for (const Vector3d& e : edges) region.borders.push_back({-e, -e.dot(tip) - kOutside * depth_, true});
    for (const double sign : {1.0, -1.0})
      for (const int axis : {0, 1, 2}) {
        const Vector3d far = sign * Vector3d::Unit(axis);
        region.borders.push_back({far, far.dot(tip) - depth_});
      }
    const bool has_normal = is_shaded() && std::ranges::all_of(around.half_edges, [&](std::uint32_t h) {
                              return corner_normal(h) == corner_normal(first);
                            });
    if (rays) region.directions = has_normal ? std::vector{normal(first, behind)} : *rays;
    const std::vector<Vector3d> of_D = has_normal && rays ? *rays : std::vector<Vector3d>();
    const std::uint32_t index = add(std::move(region), of_D, tip, depth_);
    for (const std::uint32_t h : around.half_edges) put_on(index, face(h, behind));
  }

  // True if D is on this side of the surface: inside of the cone it is everywhere or nowhere, so the middle of the rays
  // decides. The direction along the surface that is nearest to u = -D is there along an edge (docs/god-object.md).
  bool is_on_side(const std::vector<std::uint32_t>& half_edges, const std::vector<Vector3d>& edges, std::uint32_t behind,
                  const std::vector<Vector3d>& rays) const {
    Vector3d D = Vector3d::Zero();
    for (const Vector3d& ray : rays) D += ray;
    if (D.norm() <= kOutside) return !rays.empty();
    D.normalize();
    double least = 1;
    for (const Vector3d& edge : edges) least = std::min(least, D.dot(edge));
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (D.dot(edges[i]) > least + kOutside) continue;
      const std::uint32_t one = half_edges[i], other = opposite_[one];
      const Vector3d &n = out_of(one, behind), &m = out_of(other, behind);
      const bool is_narrow = rise_beside(mesh_, n, one, other) > -kOutside;
      const bool is_above_n = D.dot(n) > -kOutside, is_above_m = D.dot(m) > -kOutside;
      if (is_narrow ? is_above_n || is_above_m : is_above_n && is_above_m) return true;
    }
    return false;
  }

  const MeshRendering& rendering_;
  const mesh::TriangleMesh& mesh_;
  double depth_;
  std::uint32_t sides_;  // of a triangle that block motion
  RestRegions found_;
  std::vector<std::uint32_t> opposite_;  // half-edges
  std::vector<Around> vertices_;
};

}  // namespace

RestRegions rest_regions(const MeshRendering& rendering, double depth) {
  return Regions(rendering, depth).all();
}

double rise_beside(const mesh::TriangleMesh& mesh, const Eigen::Vector3d& n, std::uint32_t one, std::uint32_t other) {
  const Vector3d begin = vector_of(mesh.vertices[start_of(mesh, one)]);
  return n.dot((vector_of(mesh.vertices[start_of(mesh, previous_in_triangle(other))]) - begin).normalized());
}

std::vector<Eigen::Vector3d> edges_from(const mesh::TriangleMesh& mesh, const std::vector<std::uint32_t>& half_edges) {
  std::vector<Vector3d> edges;
  for (const std::uint32_t h : half_edges)
    edges.push_back((vector_of(mesh.vertices[end_of(mesh, h)]) - vector_of(mesh.vertices[start_of(mesh, h)])).normalized());
  return edges;
}

std::optional<std::vector<Eigen::Vector3d>> extreme_rays(const std::vector<Eigen::Vector3d>& edges) {
  if (edges.size() > kMostRays) return std::nullopt;
  std::vector<Vector3d> rays;
  for (const Vector3d& e : edges)
    for (const Vector3d& f : edges) {
      const Vector3d ray = e.cross(f);
      if (ray.norm() <= kOutside) continue;
      const Vector3d D = ray.normalized();
      if (std::ranges::none_of(edges, [&](const Vector3d& edge) { return D.dot(edge) < -kOutside; })) rays.push_back(D);
    }
  return rays;
}

void for_each_corner(std::vector<HalfSpace> borders, const Eigen::Vector3d& about, double slack,
                     const std::function<void(const Eigen::Vector3d&)>& take) {
  for (HalfSpace& border : borders) border.least -= border.direction.dot(about);
  const std::size_t count = borders.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vector3d line = borders[i].direction.cross(borders[j].direction);
      if (line.squaredNorm() <= kOutside * kOutside) continue;
      for (std::size_t k = j + 1; k < count; ++k) {
        const double volume = line.dot(borders[k].direction);
        if (std::fabs(volume) <= kOutside) continue;
        const Vector3d corner =
            (borders[i].least * borders[j].direction.cross(borders[k].direction) +
             borders[j].least * borders[k].direction.cross(borders[i].direction) + borders[k].least * line) /
            volume;
        const double off = slack * (1 + kIllConditioned / std::fabs(volume));
        if (std::ranges::all_of(borders, [&](const HalfSpace& one) { return one.direction.dot(corner) >= one.least - off; }))
          take(corner + about);
      }
    }
}

}  // namespace forceshade::properties
