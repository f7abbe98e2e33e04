// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;

const Fraction kStart{0, 1}, kEnd{1, 1};

bool is_between(const Fraction& value) {
  return kStart < value && value < kEnd;
}

std::optional<Crossing> with_vertex(const Vector& vertex, std::size_t index, const Vector& g, const Vector& u) {
  const Vector w = vertex - g;
  if (!is_zero(cross(w, u))) return std::nullopt;
  Fraction s{dot(w, u), dot(u, u)};
  if (!is_between(s)) return std::nullopt;
  return Crossing{std::move(s), {{Place::vertex, index}, {}}};
}

// Where both lines have one point in common: g + s u = a + t e, with u x e not 0.
std::optional<Crossing> with_edge(const Vector& e, const Vector& a, std::size_t index, const Vector& g, const Vector& u) {
  const Vector across = cross(u, e), w = a - g;
  if (is_zero(across) || !dot(w, across).is_zero()) return std::nullopt;
  const Integer under = dot(across, across);
  Fraction s{dot(cross(w, e), across), under}, t{dot(cross(w, u), across), under};
  if (!is_between(s) || !is_between(t)) return std::nullopt;
  return Crossing{std::move(s), {{Place::edge, index}, {std::move(t), {}}}};
}

// Where the line passes through the plane inside the triangle. The weights of the corners a, b, c at that point are in the
// ratio of the determinants of u with the sides opposite to them, as they are seen from g; these add up to normal·u.
std::optional<Crossing> with_triangle(const Surface& surface, std::size_t index, const Vector& g, const Vector& u,
                                      const Integer& scale) {
  const Triangle& triangle = surface.triangles()[index];
  const Integer descent = dot(triangle.normal, u);
  if (descent.is_zero()) return std::nullopt;
  const auto& [a, b, c] = triangle.vertices;
  const auto corner = [&](std::uint32_t v) { return scale * surface.vertices()[v] - g; };
  const Vector A = corner(a), B = corner(b), C = corner(c);
  Fraction s = fraction(dot(triangle.normal, A), descent);
  if (!is_between(s)) return std::nullopt;
  Fraction alpha = fraction(dot(u, cross(B, C)), descent), beta = fraction(dot(u, cross(C, A)), descent),
           gamma = fraction(dot(u, cross(A, B)), descent);
  if (alpha <= kStart || beta <= kStart || gamma <= kStart) return std::nullopt;
  return Crossing{std::move(s), {{Place::triangle, index}, {std::move(beta), std::move(gamma)}}};
}

// A conversion drops digits: the neighbours enclose the number.
double below(const Integer& value) {
  return std::nextafter(value.convert_to<double>(), -std::numeric_limits<double>::infinity());
}
double above(const Integer& value) {
  return std::nextafter(value.convert_to<double>(), std::numeric_limits<double>::infinity());
}

}  // namespace

Crossings::Box::Box(const Vector& point)
    : low{below(point[0]), below(point[1]), below(point[2])}, high{above(point[0]), above(point[1]), above(point[2])} {}

Crossings::Box Crossings::Box::join(const Box& other) const {
  Box both = *this;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    both.low[axis] = std::min(low[axis], other.low[axis]);
    both.high[axis] = std::max(high[axis], other.high[axis]);
  }
  return both;
}

bool Crossings::Box::is_apart(const Box& other) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (high[axis] < other.low[axis] || other.high[axis] < low[axis]) return true;
  return false;
}

Crossings::Crossings(const Surface& surface) : surface_(surface) {
  for (const Vector& vertex : surface.vertices()) vertices_.emplace_back(vertex);
  for (const Edge& edge : surface.edges()) edges_.push_back(vertices_[edge.vertices[0]].join(vertices_[edge.vertices[1]]));
  for (const Triangle& triangle : surface.triangles())
    triangles_.push_back(
        vertices_[triangle.vertices[0]].join(vertices_[triangle.vertices[1]]).join(vertices_[triangle.vertices[2]]));
}

std::strong_ordering operator<=>(const Crossing& a, const Crossing& b) {
  if (const auto order = a.s <=> b.s; order != 0) return order;
  if (a.point.feature.place != b.point.feature.place) return a.point.feature.place <=> b.point.feature.place;
  return a.point.feature.index <=> b.point.feature.index;
}

std::vector<Crossing> Crossings::between(const Vector& g, const Vector& p) const {
  return between(g, p, 1, Box(g).join(Box(p)));
}

bool Crossings::is_alone(const Vector& over, const Integer& scale, const Vector& e, const std::array<Vector, 2>& ends) const {
  const Box box = Box(ends[0]).join(Box(ends[1])).join(Box(e));
  const Vector end = scale * e;
  return features_at(over, scale, box).size() == 1 && (over == end || between(over, end, scale, box).empty());
}

std::vector<Crossing> Crossings::between(const Vector& g, const Vector& p, const Integer& scale, const Box& box) const {
  const Vector u = p - g;
  std::vector<Crossing> found;
  const auto keep = [&](std::optional<Crossing> crossing) {
    if (crossing) found.push_back(std::move(*crossing));
  };
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (!triangles_[i].is_apart(box)) keep(with_triangle(surface_, i, g, u, scale));
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].is_apart(box)) continue;
    const Edge& edge = surface_.edges()[i];
    keep(with_edge(scale * edge.along, scale * surface_.vertices()[edge.vertices[0]], i, g, u));
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (!surface_.fan(i).triangles.empty() && !vertices_[i].is_apart(box))
      keep(with_vertex(scale * surface_.vertices()[i], i, g, u));
  std::ranges::sort(found);
  return found;
}

std::vector<Feature> Crossings::features_at(const Vector& p) const {
  return features_at(p, 1, Box(p));
}

std::vector<Feature> Crossings::features_at(const Vector& over, const Integer& scale, const Box& box) const {
  std::vector<Feature> found;
  const auto from = [&](std::uint32_t v) { return over - scale * surface_.vertices()[v]; };
  for (std::uint32_t i = 0; i < vertices_.size(); ++i)
    if (!surface_.fan(i).triangles.empty() && !vertices_[i].is_apart(box) && is_zero(from(i)))
      found.push_back({Place::vertex, i});
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].is_apart(box)) continue;
    const Edge& edge = surface_.edges()[i];
    const Vector w = from(edge.vertices[0]);
    const Fraction t{dot(w, edge.along), scale * edge.length_squared};
    if (is_zero(cross(w, edge.along)) && is_between(t)) found.push_back({Place::edge, i});
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (triangles_[i].is_apart(box)) continue;
    const Triangle& triangle = surface_.triangles()[i];
    bool is_inside = dot(triangle.normal, from(triangle.vertices[0])).is_zero();
    for (std::size_t side = 0; side < 3 && is_inside; ++side)
      is_inside = dot(triangle.inward[side], from(triangle.vertices[side])) > 0;
    if (is_inside) found.push_back({Place::triangle, i});
  }
  return found;
}

std::optional<SurfacePoint> Crossings::at(const Vector& p) const {
  const std::vector<Feature> found = features_at(p);
  if (found.empty()) return std::nullopt;
  return foot(surface_, found.front(), p);
}

}  // namespace forceshade::reference::meshes
