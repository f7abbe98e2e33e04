// SPDX-License-Identifier: BSD-3-Clause
#include "properties/rest_regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "properties/mesh_properties.h"

namespace forceshade::properties {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMostRays = 64;     // of a vertex whose directions are tried by pairs
constexpr double kOutside = 1e-9;         // of a sine: a direction that is outside by less counts as inside
constexpr double kIllConditioned = 1e-4;  // the volume of three unit vectors from which on their common point is less sure

class Regions {
 public:
  Regions(const MeshRendering& rendering, double depth)
      : rendering_(rendering), mesh_(rendering.mesh()), depth_(depth), sides_(rendering.sides == mesh::Sides::both ? 2 : 1) {}

  RestRegions all() {
    found_.has_two_sides = sides_ == 2;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) add_faces(t);
    for (const auto& [ends, halves] : edges_) add_edge(halves);
    for (const auto& [v, around] : vertices_)
      for (std::uint32_t behind = 0; behind < sides_; ++behind) add_vertex(v, around, behind);
    return std::move(found_);
  }

 private:
  struct Half {
    std::uint32_t triangle;
    std::size_t corner;  // at which it begins
  };
  struct Around {
    std::set<std::uint32_t> vertices;
    std::vector<Half> triangles;  // with the corner that is this vertex
    bool is_at_rim = false;
  };

  Vector3d vertex(std::uint32_t v) const { return vector_of(mesh_.vertices[v]); }
  std::uint32_t face(std::uint32_t triangle, std::uint32_t behind) const { return triangle * sides_ + behind; }
  // The unit vector of a corner's normal, for the side.
  Vector3d normal(const Half& at, std::uint32_t behind) const {
    const Vector3d N = vector_of(rendering_.normals[at.triangle][at.corner % 3]).normalized();
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
      put_on(add(std::move(region), {out}, corners[0], size), face(t, behind));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle[i], w = triangle[(i + 1) % 3];
      edges_[std::minmax(v, w)].push_back({t, i});
      vertices_[v].triangles.push_back({t, i});
      vertices_[v].vertices.insert({w, triangle[(i + 2) % 3]});
    }
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

  void add_edge(const std::vector<Half>& halves) {
    if (halves.size() == 1) {
      const mesh::Triangle& triangle = mesh_.triangles[halves[0].triangle];
      const std::uint32_t v = triangle[halves[0].corner], w = triangle[(halves[0].corner + 1) % 3];
      vertices_[v].is_at_rim = vertices_[w].is_at_rim = true;
      found_.rim.push_back({vertex(v), vertex(w)});
      return;
    }
    for (std::uint32_t behind = 0; behind < sides_; ++behind) {
      const std::uint32_t one = face(halves[0].triangle, behind), other = face(halves[1].triangle, behind);
      found_.faces[one].beside.push_back(other);
      found_.faces[other].beside.push_back(one);
      if (!is_flat({halves[0], halves[1]})) add_valley(halves[0], halves[1], behind);
    }
  }

  // Whether D has the one direction that it has inside the triangles around.
  bool is_flat(const std::vector<Half>& around) const {
    return std::ranges::all_of(around, [&](const Half& at) {
      const Vector3d &n = found_.faces[face(around[0].triangle, 0)].out, &m = found_.faces[face(at.triangle, 0)].out;
      return (n - m).norm() <= kOutside;
    });
  }

  // D = a n + b m with a, b >= 0, n and m the normals of both faces, where these rise from each other. It is no longer than the
  // depth, neither along n or m nor between them.
  void add_valley(const Half& a, const Half& b, std::uint32_t behind) {
    const mesh::Triangle &one = mesh_.triangles[a.triangle], &other = mesh_.triangles[b.triangle];
    const Vector3d begin = vertex(one[a.corner]), end = vertex(one[(a.corner + 1) % 3]), along = (end - begin).normalized();
    const std::uint32_t face_a = face(a.triangle, behind), face_b = face(b.triangle, behind);
    const Vector3d n = found_.faces[face_a].out, m = found_.faces[face_b].out;
    const Vector3d off = (vertex(other[(b.corner + 2) % 3]) - begin).normalized();
    if (n.dot(off) < -kOutside) return;
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
      for (const Half& half : {a, Half{a.triangle, a.corner + 1}, b, Half{b.triangle, b.corner + 1}})
        region.directions.push_back(normal(half, behind));
    else
      region.directions = {n, m};
    const std::uint32_t index = add(std::move(region), {n, m}, begin, depth_ + (end - begin).norm());
    put_on(index, face_a);
    put_on(index, face_b);
  }

  // D·e >= 0 for each edge e from the vertex.
  void add_vertex(std::uint32_t v, const Around& around, std::uint32_t behind) {
    if (around.is_at_rim || is_flat(around.triangles)) return;
    std::vector<Vector3d> edges;
    for (const std::uint32_t w : around.vertices) edges.push_back((vertex(w) - vertex(v)).normalized());
    std::optional<std::vector<Vector3d>> rays = extreme_rays(edges);
    if (rays && !is_on_side(v, around, behind, *rays)) return;
    RestRegion region{.D = {-Matrix3d::Identity(), vertex(v)}};
    for (const Vector3d& e : edges) region.borders.push_back({-e, -e.dot(vertex(v)) - kOutside * depth_, true});
    for (const double sign : {1.0, -1.0})
      for (const int axis : {0, 1, 2}) {
        const Vector3d far = sign * Vector3d::Unit(axis);
        region.borders.push_back({far, far.dot(vertex(v)) - depth_});
      }
    const Half& first = around.triangles.front();
    const bool has_normal =
        is_shaded() && std::ranges::all_of(around.triangles, [&](const Half& at) {
          return rendering_.normals[at.triangle][at.corner] == rendering_.normals[first.triangle][first.corner];
        });
    if (rays) region.directions = has_normal ? std::vector{normal(first, behind)} : *rays;
    const std::vector<Vector3d> of_D = has_normal && rays ? *rays : std::vector<Vector3d>();
    const std::uint32_t index = add(std::move(region), of_D, vertex(v), depth_);
    for (const Half& at : around.triangles) put_on(index, face(at.triangle, behind));
  }

  // Whether D is on this side of the surface: inside of the cone it is everywhere or nowhere, so the middle of the rays
  // decides. The direction along the surface that is nearest to u = -D is there along an edge (docs/god-object.md).
  bool is_on_side(std::uint32_t v, const Around& around, std::uint32_t behind, const std::vector<Vector3d>& rays) const {
    Vector3d D = Vector3d::Zero();
    for (const Vector3d& ray : rays) D += ray;
    if (D.norm() <= kOutside) return !rays.empty();
    D.normalize();
    const auto off = [&](std::uint32_t w) { return D.dot((vertex(w) - vertex(v)).normalized()); };
    double least = 1;
    for (const std::uint32_t w : around.vertices) least = std::min(least, off(w));
    return std::ranges::any_of(around.vertices, [&](std::uint32_t w) {
      if (off(w) > least + kOutside) return false;
      const std::vector<Half>& halves = edges_.at(std::minmax(v, w));
      const Vector3d &n = out_of(halves[0], behind), &m = out_of(halves[1], behind);
      const Vector3d third = vertex(mesh_.triangles[halves[1].triangle][(halves[1].corner + 2) % 3]);
      const bool is_narrow = n.dot((third - vertex(v)).normalized()) > -kOutside;
      const bool is_above_n = D.dot(n) > -kOutside, is_above_m = D.dot(m) > -kOutside;
      return is_narrow ? is_above_n || is_above_m : is_above_n && is_above_m;
    });
  }
  const Vector3d& out_of(const Half& half, std::uint32_t behind) const { return found_.faces[face(half.triangle, behind)].out; }

  const MeshRendering& rendering_;
  const mesh::TriangleMesh& mesh_;
  double depth_;
  std::uint32_t sides_;  // of a triangle that block motion
  RestRegions found_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Half>> edges_;
  std::map<std::uint32_t, Around> vertices_;
};

}  // namespace

RestRegions rest_regions(const MeshRendering& rendering, double depth) {
  return Regions(rendering, depth).all();
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
