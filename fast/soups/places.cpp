// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/places.h"

#include <algorithm>
#include <utility>

namespace forceshade::fast::soups {
namespace {

bool is_across(const Face& f, const Direction& along) {
  if (along.line.is_known_in_plane(f)) return false;
  return sign_of([&]<class N>() { return dot(normal<N>(f), along.get<N>()); }) != 0;
}

// An edge that holds the point, by a triangle's side and the names of its ends, the lower first.
struct EdgeAt {
  const Face* f;
  std::size_t side;
  std::array<std::uint32_t, 2> names;

  Line line() const {
    Line its = Line::of_side(*f, side, 1);
    return its.names == names ? its : its.reversed();
  }
};
// The one with the least names that `allows`.
template <class Allows>
std::optional<EdgeAt> least_edge(const Star& star, const Allows& allows) {
  std::optional<EdgeAt> least;
  for (const Star::Held& held : star.triangles())
    for (std::size_t i = 0; i < 3; ++i) {
      if (!held.has_side(i)) continue;
      const std::uint32_t a = held.face->vertex[i], b = held.face->vertex[i == 2 ? 0 : i + 1];
      const EdgeAt its{held.face, i, {std::min(a, b), std::max(a, b)}};
      if ((!least || its.names < least->names) && allows(its)) least = its;
    }
  return least;
}

// The weight of a corner at a point of the plane.
template <class N>
Quotient<N> weight(const Face& f, std::size_t corner, const Point& x) {
  const Vector3<N> n = normal<N>(f);
  return {inside<N>(f, (corner + 1) % 3, x), squared(n) * x.get<N>().w};
}

}  // namespace

template <class N>
Quotient<N> GridLine::value(const Point& x) const {
  Quotient<N> its;
  if (is_edge()) {
    const Vector3<N> e = line.get<N>();
    its = {dot(from_corner<N>(line.a, x), e), squared(e) * x.get<N>().w};
  } else {
    its = weight<N>(*f, corner, x);
  }
  its.num = its.num.shifted(24);
  return its;
}

Floor GridLine::parameter(const Point& x) const {
  return floor_of([&]<class N>() { return value<N>(x); });
}
std::int64_t GridLine::nearest(const Point& x) const {
  return nearest_of([&]<class N>() { return value<N>(x); });
}

bool GridLine::is_upwards(const Direction& along) const {
  if (is_edge()) return sign_of([&]<class N>() { return dot(line.get<N>(), along.get<N>()); }) > 0;
  return sign_of([&]<class N>() { return dot(cross(side_of_face<N>(*f, (corner + 1) % 3), along.get<N>()), normal<N>(*f)); }) >
         0;
}

Point GridLine::meeting(const Time& t) const {
  const Face& other = *t.f;
  const auto known = [&](Scaled<Whole> exact, const std::array<std::uint32_t, 2>& names) {
    Point x(std::move(exact));
    x.edge = names;
    x.faces = {f, h, &other};
    return x;
  };
  const auto point = [](const float* a) { return corner_point<Whole>(a); };
  if (t.kind == Time::Kind::plane) {
    if (is_edge()) return known(edge_and_plane(point(line.a), point(line.b), corners<Whole>(other)), edge);
    return known(planes_meeting(corners<Whole>(*f), corners<Whole>(*h), corners<Whole>(other)), {kNone, kNone});
  }
  const Line side = Line::of_side(other, t.side, 1);
  if (!is_edge())
    return known(edge_and_plane(point(side.a), point(side.b), corners<Whole>(is_across(*f, Direction::along(side)) ? *f : *h)),
                 side.names);
  for (std::size_t i = 0; i < 2; ++i)
    if (const float* const end = i == 0 ? side.a : side.b; side.names[i] == edge[0] || side.names[i] == edge[1]) {
      Point x(Scaled<Whole>{point(end), Whole(1)});
      x.vertex = side.names[i];
      return x;
    }
  return known(edges_meeting(point(line.a), point(line.b), point(side.a), point(side.b)), edge);
}

Place GridLine::place(std::int64_t m) const {
  const auto k = static_cast<std::uint32_t>(m);
  if (is_edge()) return {PlaceKind::edge, PlaceKind::nowhere, {edge[0], edge[1], k, 0}, {}};
  return {PlaceKind::crossing, PlaceKind::nowhere, {f->index(), h->index(), static_cast<std::uint32_t>(corner), k}, {}};
}
Place GridLine::foot(const std::array<float, 3>& hand) const {
  if (is_edge()) return {PlaceKind::foot, PlaceKind::edge, {edge[0], edge[1], 0, 0}, hand};
  return {PlaceKind::foot, PlaceKind::crossing, {f->index(), h->index(), static_cast<std::uint32_t>(corner), 0}, hand};
}

GridLine line_of(const Star& star) {
  GridLine its;
  // All sides that hold a point of a line lie in it.
  if (const auto edge = least_edge(star, [](const EdgeAt&) { return true; })) {
    its.edge = edge->names;
    its.line = edge->line();
    return its;
  }
  const Star::Held& f = star.triangles().front();
  const auto h = std::ranges::find_if(star.triangles(), [&](const Star::Held& each) { return each.plane != f.plane; });
  its.f = f.face;
  its.h = h->face;
  its.line = Line::of_planes(*its.f, *its.h, 1);
  // Along n_f x n_h the weight of a corner changes as h's height does along the opposite side.
  const auto change = [&]<class N>(std::size_t corner) {
    return size_of(dot(normal<N>(*its.h), side_of_face<N>(*its.f, (corner + 1) % 3)));
  };
  for (std::size_t i = 1; i < 3; ++i)
    if (sign_of([&]<class N>() { return change.template operator()<N>(i) - change.template operator()<N>(its.corner); }) > 0)
      its.corner = i;
  return its;
}

Place point_place(const Star& star) {
  for (const Star::Held& held : star.triangles())
    for (std::size_t i = 0; i < 3; ++i)
      if (held.has_side(i) && held.has_side(i == 0 ? 2 : i - 1)) return vertex_place(held.face->vertex[i]);
  const auto triangles = star.triangles();
  if (const auto first = least_edge(star, [](const EdgeAt&) { return true; })) {
    const Line line = first->line();
    const auto second = least_edge(star, [&](const EdgeAt& each) {
      const Line other = each.line();
      return !other.is_known_as(line) && !are_parallel(other, line);
    });
    if (second)
      return {PlaceKind::edges, PlaceKind::nowhere, {first->names[0], first->names[1], second->names[0], second->names[1]}, {}};
    const Direction along = Direction::along(line);
    const auto f = std::ranges::find_if(triangles, [&](const Star::Held& each) { return is_across(*each.face, along); });
    return {PlaceKind::edge_and_triangle, PlaceKind::nowhere, {first->names[0], first->names[1], f->face->index(), 0}, {}};
  }
  const Star::Held& f = triangles.front();
  const auto g = std::ranges::find_if(triangles, [&](const Star::Held& each) { return each.plane != f.plane; });
  const Direction along = Direction::along(Line::of_planes(*f.face, *g->face, 1));
  const auto h = std::ranges::find_if(triangles, [&](const Star::Held& each) { return is_across(*each.face, along); });
  return {PlaceKind::triangles, PlaceKind::nowhere, {f.face->index(), g->face->index(), h->face->index(), 0}, {}};
}

namespace {

struct PlaceReader {
  const Soup& soup;
  const Place& place;

  const Face* face(std::size_t i) const { return soup.numbered(place.numbers[i]); }
  const float* vertex(std::size_t i) const { return soup.vertex(place.numbers[i]); }
  std::array<std::uint32_t, 2> names() const { return {place.numbers[0], place.numbers[1]}; }
  bool has_edge() const { return vertex(0) != nullptr && vertex(1) != nullptr && place.numbers[0] < place.numbers[1]; }
  // Triangles of different planes, and a corner of the first whose weight changes along their line.
  bool has_crossing() const {
    if (face(0) == nullptr || face(1) == nullptr || place.numbers[2] > 2) return false;
    const Face &f = *face(0), &h = *face(1);
    return sign_of([&]<class N>() { return dot(normal<N>(h), side_of_face<N>(f, (place.numbers[2] + 1) % 3)); }) != 0;
  }

  std::optional<Point> point() const {
    const auto& n = place.numbers;
    const auto at = [&](std::size_t i) { return corner_point<Whole>(vertex(i)); };
    const auto plane = [&](std::size_t i) { return corners<Whole>(*face(i)); };
    const auto known = [](Scaled<Whole> exact, const std::array<std::uint32_t, 2>& edge,
                          const std::array<const Face*, 3>& faces) -> std::optional<Point> {
      if (exact.w.is_zero()) return {};
      Point x(std::move(exact));
      x.edge = edge;
      x.faces = faces;
      return x;
    };
    constexpr std::array<std::uint32_t, 2> kNoEdge{kNone, kNone};
    switch (place.kind) {
      case PlaceKind::nowhere: return {};
      case PlaceKind::free: return Point::of(place.position);
      case PlaceKind::vertex: {
        if (vertex(0) == nullptr) return {};
        Point x(Scaled<Whole>{at(0), Whole(1)});
        x.vertex = n[0];
        return x;
      }
      case PlaceKind::edge:
        if (!has_edge() || n[2] == 0 || n[2] >= kGrid) return {};
        return known(point_on_edge(at(0), at(1), n[2]), names(), {});
      case PlaceKind::triangle:
        if (face(0) == nullptr || n[1] > kGrid || n[2] > kGrid || n[1] + n[2] > kGrid) return {};
        return known(point_in_triangle(plane(0), n[1], n[2]), kNoEdge, {face(0)});
      case PlaceKind::crossing:
        if (!has_crossing() || n[3] > kGrid) return {};
        return known(point_on_crossing(plane(0), plane(1), n[2], n[3]), kNoEdge, {face(0), face(1)});
      case PlaceKind::edges:
        if (!has_edge() || vertex(2) == nullptr || vertex(3) == nullptr) return {};
        return known(edges_meeting(at(0), at(1), at(2), at(3)), names(), {});
      case PlaceKind::edge_and_triangle:
        if (!has_edge() || face(2) == nullptr) return {};
        return known(edge_and_plane(at(0), at(1), plane(2)), names(), {face(2)});
      case PlaceKind::triangles:
        if (face(0) == nullptr || face(1) == nullptr || face(2) == nullptr) return {};
        return known(planes_meeting(plane(0), plane(1), plane(2)), kNoEdge, {face(0), face(1), face(2)});
      case PlaceKind::foot: break;
    }
    const Vector3<Whole> p = corner_point<Whole>(place.position.data());
    if (place.of_foot == PlaceKind::edge) {
      if (!has_edge()) return {};
      return known(foot_on_edge(at(0), at(1), p), names(), {});
    }
    if (place.of_foot == PlaceKind::crossing) {
      if (!has_crossing()) return {};
      return known(foot_on_crossing(plane(0), plane(1), p), kNoEdge, {face(0), face(1)});
    }
    if (face(0) == nullptr) return {};
    return known(foot_in_plane(plane(0), p), kNoEdge, {face(0)});
  }
};

}  // namespace

std::optional<Point> point_of(const Soup& soup, const Place& place) {
  return PlaceReader{soup, place}.point();
}

}  // namespace forceshade::fast::soups
