// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/places.h"

#include <algorithm>
#include <utility>

namespace forceshade::reference::soups {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;

struct Edge {
  Pair names;  // the lower first
  Vector along;
};

// The edges that hold x, their ends included, by their names.
std::vector<Edge> edges_at(const Soup& soup, const Star& star, const Vector& x) {
  std::vector<Edge> all;
  for (const Triangle* triangle : star.triangles())
    for (std::size_t i = 0; i < 3; ++i) {
      if (!triangle->inside(i, x).is_zero()) continue;
      const auto [a, b] = std::minmax(triangle->name[i], triangle->name[(i + 1) % 3]);
      all.push_back({{a, b}, soup.vertex(b) - soup.vertex(a)});
    }
  std::ranges::sort(all, {}, &Edge::names);
  all.erase(std::ranges::unique(all, {}, &Edge::names).begin(), all.end());
  return all;
}

// Weight i of the corners at a point of the triangle's plane.
Rational weight(const Triangle& triangle, std::size_t i, const Vector& x) {
  const auto [beta, gamma] = triangle.weights(x);
  return i == 0 ? 1 - beta - gamma : i == 1 ? beta : gamma;
}

Line line_along(const Triangle& f, std::size_t other, std::size_t i, const Vector& x, const Vector& along) {
  const Rational here = weight(f, i, x), grows = weight(f, i, x + along) - here;
  const Vector step = 1 / grows * along;
  return {{}, f.number, other, i, x - here * step, step};
}

Line line_of_edge(const Soup& soup, std::size_t a, std::size_t b) {
  const Vector &from = soup.vertex(static_cast<std::uint32_t>(a)), &to = soup.vertex(static_cast<std::uint32_t>(b));
  return {{a, b}, 0, 0, 0, from, to - from};
}

// A point of the line in which two triangles' planes meet, and its direction.
std::pair<Vector, Vector> planes_meeting(const Triangle& f, const Triangle& h) {
  const Vector along = cross(f.normal, h.normal), inward = cross(along, f.normal);
  return {f.corner[0] + dot(h.normal, h.corner[0] - f.corner[0]) / dot(h.normal, inward) * inward, along};
}

Line crossing_line(const Soup& soup, std::size_t first, std::size_t second, std::size_t i) {
  const auto [on, along] = planes_meeting(soup.numbered(first), soup.numbered(second));
  return line_along(soup.numbered(first), second, i, on, along);
}

Vector foot_on(const Line& line, const Vector& p) {
  return line.at(line.parameter(p));
}

// The point of a line, given by a point of it and a direction, in a plane.
Vector meeting(const Vector& on, const Vector& along, const Triangle& plane) {
  return on + dot(plane.normal, plane.corner[0] - on) / dot(plane.normal, along) * along;
}

}  // namespace

Line line_of(const Soup& soup, const Star& star, const Vector& x) {
  const Vector& along = star.rays()[0].along;
  for (const Edge& edge : edges_at(soup, star, x))
    if (are_parallel(edge.along, along)) return line_of_edge(soup, edge.names.first, edge.names.second);
  const Triangle& f = *star.triangles()[0];
  const Triangle& h =
      **std::ranges::find_if(star.triangles(), [&](const Triangle* each) { return !are_parallel(each->normal, f.normal); });
  std::size_t fastest = 0;
  Rational most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational grows = abs(weight(f, i, x + along) - weight(f, i, x));
    if (grows > most) most = grows, fastest = i;
  }
  return line_along(f, h.number, fastest, x, along);
}

Vector point_of(const Soup& soup, const Place& place) {
  const auto& n = place.numbers;
  const auto vertex = [&](std::size_t i) { return soup.vertex(static_cast<std::uint32_t>(n[i])); };
  const auto foot = [&](PlaceKind kind) {
    const Vector p = exact_point(place.position);
    if (kind == PlaceKind::edge) return foot_on(line_of_edge(soup, n[0], n[1]), p);
    if (kind == PlaceKind::crossing) return foot_on(crossing_line(soup, n[0], n[1], n[2]), p);
    const Triangle& f = soup.numbered(n[0]);
    return p - dot(f.normal, p - f.corner[0]) / squared(f.normal) * f.normal;
  };
  switch (place.kind) {
    case PlaceKind::free: return exact_point(place.position);
    case PlaceKind::vertex: return vertex(0);
    case PlaceKind::edge: return line_of_edge(soup, n[0], n[1]).at(Rational(n[2]));
    case PlaceKind::triangle: return soup.numbered(n[0]).at(Rational(n[1], kGrid), Rational(n[2], kGrid));
    case PlaceKind::crossing: return crossing_line(soup, n[0], n[1], n[2]).at(Rational(n[3]));
    case PlaceKind::edges: {
      const Vector a = vertex(0), along = vertex(1) - a, c = vertex(2), other = vertex(3) - c;
      const Vector turn = cross(along, other);
      return a + dot(cross(c - a, other), turn) / squared(turn) * along;
    }
    case PlaceKind::edge_and_triangle: return meeting(vertex(0), vertex(1) - vertex(0), soup.numbered(n[2]));
    case PlaceKind::triangles: {
      const auto [on, along] = planes_meeting(soup.numbered(n[0]), soup.numbered(n[1]));
      return meeting(on, along, soup.numbered(n[2]));
    }
    case PlaceKind::foot: return foot(place.of_foot);
  }
  return {};
}

Place point_place(const Soup& soup, const Star& star, const Vector& x) {
  for (const Triangle* triangle : star.triangles())
    for (std::size_t i = 0; i < 3; ++i)
      if (triangle->corner[i] == x) return {PlaceKind::vertex, {}, {triangle->name[i]}};
  const std::vector<Edge> edges = edges_at(soup, star, x);
  if (!edges.empty()) {
    const Edge& first = edges.front();
    const auto second = std::ranges::find_if(edges, [&](const Edge& each) { return !are_parallel(each.along, first.along); });
    if (second != edges.end())
      return {PlaceKind::edges, {}, {first.names.first, first.names.second, second->names.first, second->names.second}};
    const auto f =
        std::ranges::find_if(star.triangles(), [&](const Triangle* each) { return !dot(each->normal, first.along).is_zero(); });
    return {PlaceKind::edge_and_triangle, {}, {first.names.first, first.names.second, (*f)->number}};
  }
  const Triangle& f = *star.triangles()[0];
  const Triangle& g =
      **std::ranges::find_if(star.triangles(), [&](const Triangle* each) { return !are_parallel(each->normal, f.normal); });
  const Vector along = cross(f.normal, g.normal);
  const Triangle& h =
      **std::ranges::find_if(star.triangles(), [&](const Triangle* each) { return !dot(each->normal, along).is_zero(); });
  return {PlaceKind::triangles, {}, {f.number, g.number, h.number}};
}

Place line_place(const Line& line, const Whole& m) {
  const std::size_t k = m.convert_to<std::size_t>();
  if (!line.edge.empty()) return {PlaceKind::edge, {}, {line.edge[0], line.edge[1], k}};
  return {PlaceKind::crossing, {}, {line.triangle, line.other, line.corner, k}};
}

Place line_foot(const Line& line, const std::array<float, 3>& position) {
  if (!line.edge.empty()) return {PlaceKind::foot, PlaceKind::edge, line.edge, position};
  return {PlaceKind::foot, PlaceKind::crossing, {line.triangle, line.other, line.corner}, position};
}

}  // namespace forceshade::reference::soups
