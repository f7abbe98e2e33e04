// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/meshes/crossings.h"

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
std::optional<Crossing> with_edge(const Edge& edge, const Vector& a, std::size_t index, const Vector& g, const Vector& u) {
  const Vector across = cross(u, edge.along), w = a - g;
  if (is_zero(across) || !dot(w, across).is_zero()) return std::nullopt;
  const Integer under = dot(across, across);
  Fraction s{dot(cross(w, edge.along), across), under}, t{dot(cross(w, u), across), under};
  if (!is_between(s) || !is_between(t)) return std::nullopt;
  return Crossing{std::move(s), {{Place::edge, index}, {std::move(t), {}}}};
}

// Where the line passes through the plane inside the triangle. The weights of the corners a, b, c at that point are in the
// ratio of the determinants of u with the sides opposite to them, as they are seen from g; these add up to normal·u.
std::optional<Crossing> with_triangle(const Surface& surface, std::size_t index, const Vector& g, const Vector& u) {
  const Triangle& triangle = surface.triangles()[index];
  const Integer descent = dot(triangle.normal, u);
  if (descent.is_zero()) return std::nullopt;
  const auto& [a, b, c] = triangle.vertices;
  const Vector A = surface.vertices()[a] - g, B = surface.vertices()[b] - g, C = surface.vertices()[c] - g;
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

std::vector<Crossing> Crossings::between(const Vector& g, const Vector& p) const {
  const Vector u = p - g;
  const Box flight = Box(g).join(Box(p));
  std::vector<Crossing> found;
  const auto keep = [&](std::optional<Crossing> crossing) {
    if (crossing) found.push_back(std::move(*crossing));
  };
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (!triangles_[i].is_apart(flight)) keep(with_triangle(surface_, i, g, u));
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].is_apart(flight)) continue;
    const Edge& edge = surface_.edges()[i];
    keep(with_edge(edge, surface_.vertices()[edge.vertices[0]], i, g, u));
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (!surface_.fan(i).triangles.empty() && !vertices_[i].is_apart(flight))
      keep(with_vertex(surface_.vertices()[i], i, g, u));
  std::ranges::sort(found, {}, &Crossing::s);
  return found;
}

std::optional<SurfacePoint> Crossings::at(const Vector& p) const {
  const Box here(p);
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (!surface_.fan(i).triangles.empty() && surface_.vertices()[i] == p) return SurfacePoint{{Place::vertex, i}, {}};
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].is_apart(here)) continue;
    const Edge& edge = surface_.edges()[i];
    const Vector w = p - surface_.vertices()[edge.vertices[0]];
    Fraction t{dot(w, edge.along), edge.length_squared};
    if (is_zero(cross(w, edge.along)) && is_between(t)) return SurfacePoint{{Place::edge, i}, {std::move(t), {}}};
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (triangles_[i].is_apart(here)) continue;
    const Triangle& triangle = surface_.triangles()[i];
    if (!dot(triangle.normal, p - surface_.vertices()[triangle.vertices[0]]).is_zero()) continue;
    SurfacePoint point = foot(surface_, {Place::triangle, i}, p);
    if (is_inside(point)) return point;
  }
  return std::nullopt;
}

}  // namespace forceshade::reference::meshes
