// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/crossings.h"

#include <algorithm>
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

// The one point that both lines have in common: g + s u = a + t e, with u x e not 0.
std::optional<Crossing> with_edge(const Vector& e, const Vector& a, std::size_t index, const Vector& g, const Vector& u) {
  const Vector across = cross(u, e), w = a - g;
  if (is_zero(across) || !dot(w, across).is_zero()) return std::nullopt;
  const Integer under = dot(across, across);
  Fraction s{dot(cross(w, e), across), under}, t{dot(cross(w, u), across), under};
  if (!is_between(s) || !is_between(t)) return std::nullopt;
  return Crossing{std::move(s), {{Place::edge, index}, {std::move(t), {}}}};
}

// The point where the line passes through the plane inside the triangle. The weights of the corners a, b, c there are in the
// ratio of the determinants of u with the sides opposite to them, as they are seen from g; these add up to normal·u.
std::optional<Crossing> with_triangle(const Surface& surface, std::size_t index, const Vector& g, const Vector& u) {
  const Triangle& triangle = surface.triangles()[index];
  const Integer descent = dot(triangle.normal, u);
  if (descent.is_zero()) return std::nullopt;
  const auto& [a, b, c] = triangle.vertices;
  const auto corner = [&](std::uint32_t v) { return surface.vertices()[v] - g; };
  const Vector A = corner(a);
  Fraction s = fraction(dot(triangle.normal, A), descent);
  if (!is_between(s)) return std::nullopt;
  const Vector B = corner(b), C = corner(c);
  Fraction alpha = fraction(dot(u, cross(B, C)), descent), beta = fraction(dot(u, cross(C, A)), descent),
           gamma = fraction(dot(u, cross(A, B)), descent);
  if (alpha <= kStart || beta <= kStart || gamma <= kStart) return std::nullopt;
  return Crossing{std::move(s), {{Place::triangle, index}, {std::move(beta), std::move(gamma)}}};
}

std::vector<Box> vertex_boxes(const Surface& surface) {
  return {surface.vertices().begin(), surface.vertices().end()};
}
std::vector<Box> edge_boxes(const Surface& surface) {
  std::vector<Box> boxes;
  for (const Edge& edge : surface.edges())
    boxes.push_back(Box(surface.vertices()[edge.vertices[0]]).join(Box(surface.vertices()[edge.vertices[1]])));
  return boxes;
}
std::vector<Box> triangle_boxes(const Surface& surface) {
  std::vector<Box> boxes;
  for (const Triangle& triangle : surface.triangles()) {
    const auto& [a, b, c] = triangle.vertices;
    boxes.push_back(Box(surface.vertices()[a]).join(Box(surface.vertices()[b])).join(Box(surface.vertices()[c])));
  }
  return boxes;
}

}  // namespace

Crossings::Crossings(const Surface& surface)
    : surface_(surface), vertices_(vertex_boxes(surface)), edges_(edge_boxes(surface)), triangles_(triangle_boxes(surface)) {}

// A segment and a box are apart only if one of these shows it: an axis, or what is seen along it.
std::size_t Crossings::looks(const Vector& g, const Vector& p, const Fraction& s) const {
  const Vector u = p - g, stop = s.under * g + s.over * u;
  const auto meets = [&](std::size_t i) {
    const auto& [a, b, c] = surface_.triangles()[i].vertices;
    std::array<std::array<Integer, 2>, 3> ends;  // of the box
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](std::uint32_t v) -> const Integer& { return surface_.vertices()[v][axis]; };
      const auto [low, high] = std::minmax({at(a), at(b), at(c)});
      if ((g[axis] < low && stop[axis] < s.under * low) || (g[axis] > high && stop[axis] > s.under * high)) return false;
      ends[axis] = {low, high};
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
      std::array<std::size_t, 2> sides{};  // how many corners lie on either side of the line
      for (const Integer& at_j : ends[j])
        for (const Integer& at_k : ends[k]) {
          const Integer off = u[j] * (at_k - g[k]) - u[k] * (at_j - g[j]);
          if (!off.is_zero()) ++sides[off < 0 ? 0 : 1];
        }
      if (sides[0] == 4 || sides[1] == 4) return false;
    }
    return true;
  };
  return static_cast<std::size_t>(std::ranges::count_if(triangles_.met_by(Reach(g, p)), meets));
}

std::vector<Crossing> Crossings::between(const Vector& g, const Vector& p) const {
  const Vector u = p - g;
  const Reach reach(g, p);
  std::vector<Crossing> found;
  const auto keep = [&](std::optional<Crossing> crossing) {
    if (crossing) found.push_back(std::move(*crossing));
  };
  for (const std::size_t i : triangles_.met_by(reach)) keep(with_triangle(surface_, i, g, u));
  for (const std::size_t i : edges_.met_by(reach)) {
    const Edge& edge = surface_.edges()[i];
    keep(with_edge(edge.along, surface_.vertices()[edge.vertices[0]], i, g, u));
  }
  for (const std::size_t i : vertices_.met_by(reach))
    if (!surface_.fan(i).triangles.empty()) keep(with_vertex(surface_.vertices()[i], i, g, u));
  std::ranges::sort(found, {}, &Crossing::s);
  return found;
}

std::optional<SurfacePoint> Crossings::at(const Vector& p) const {
  const Reach reach{Box(p)};
  for (const std::size_t i : vertices_.met_by(reach))
    if (!surface_.fan(i).triangles.empty() && surface_.vertices()[i] == p) return foot(surface_, {Place::vertex, i}, p);
  for (const std::size_t i : edges_.met_by(reach)) {
    const Edge& edge = surface_.edges()[i];
    const Vector w = p - surface_.vertices()[edge.vertices[0]];
    if (is_zero(cross(w, edge.along)) && is_between({dot(w, edge.along), edge.length_squared}))
      return foot(surface_, {Place::edge, i}, p);
  }
  for (const std::size_t i : triangles_.met_by(reach)) {
    const Triangle& triangle = surface_.triangles()[i];
    const auto from = [&](std::size_t corner) { return p - surface_.vertices()[triangle.vertices[corner]]; };
    bool is_inside = dot(triangle.normal, from(0)).is_zero();
    for (std::size_t side = 0; side < 3 && is_inside; ++side) is_inside = dot(triangle.inward[side], from(side)) > 0;
    if (is_inside) return foot(surface_, {Place::triangle, i}, p);
  }
  return std::nullopt;
}

}  // namespace forceshade::reference::meshes
