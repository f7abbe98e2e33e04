// SPDX-License-Identifier: BSD-3-Clause
// The ends of moves and rests on the grids of lines and triangles.

#include <algorithm>
#include <utility>

#include "fast/soups/session.h"

namespace forceshade::fast::soups {
namespace {

using Side = Star::Side;

// The wall of a cell's side in a plane, or any side on a line.
Side side_in(const At& at) {
  std::optional<Side> first, wall;
  at.star->for_sides(at.cell, [&](const Side& side) {
    if (!first) first = side;
    if (!wall && at.star->is_wall(side)) wall = side;
  });
  return wall ? *wall : *first;
}

// A direction into the cell of a point on a line, across it.
Direction into_cell(const At& at) {
  return at.star->wedge(0, side_in(at)).inner;
}

// The weights of the corners b and c at a point of the plane, in units of 1/kGrid; with `sum` that of both.
enum class Weight { of_b, of_c, sum };
template <class N>
Quotient<N> weight_of(const Face& f, Weight which, const Point& x) {
  const Vector3<N> n = normal<N>(f);
  const N den = squared(n) * x.get<N>().w;
  N num = which == Weight::of_b ? inside<N>(f, 2, x) : which == Weight::of_c ? inside<N>(f, 0, x) : den - inside<N>(f, 1, x);
  return {num.shifted(24), den};
}
Floor weight_below(const Face& f, Weight which, const Point& x) {
  return floor_of([&]<class N>() { return weight_of<N>(f, which, x); });
}
std::int64_t nearest_weight(const Face& f, Weight which, const Point& x) {
  return nearest_of([&]<class N>() { return weight_of<N>(f, which, x); });
}

Place triangle_place(const Face& f, std::int64_t k, std::int64_t l) {
  return {PlaceKind::triangle,
          PlaceKind::nowhere,
          {f.index(), static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(l), 0},
          {}};
}
// Its borders belong to the grid.
Point triangle_point(const Soup& soup, const Face& f, std::int64_t k, std::int64_t l) {
  Point x = *point_of(soup, triangle_place(f, k, l));
  const std::array<bool, 3> is_on{l == 0, k + l == kGrid, k == 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = i == 2 ? 0 : i + 1;
    if (is_on[i] && is_on[next]) x.vertex = f.vertex[next];
    if (is_on[i]) x.edge = {f.vertex[i], f.vertex[next]};
  }
  return x;
}
Point line_point(const Soup& soup, const GridLine& line, std::int64_t m) {
  if (line.is_edge() && (m == 0 || m == kGrid)) return *point_of(soup, vertex_place(line.edge[m == 0 ? 0 : 1]));
  return *point_of(soup, line.place(m));
}

}  // namespace

At* Session::rounded(At* at) {
  rounded_place_.reset();
  switch (at->star->kind()) {
    case Star::Kind::point: {
      // Takes the numbers of its place, since those of a point that a way led to grow with each move.
      const std::uint32_t vertex = at->x.vertex;
      at->x = *point_of(*soup_, vertex == kNone ? point_place(*at->star) : vertex_place(vertex));
      return at;
    }
    case Star::Kind::line: return rounded_on_line(at);
    case Star::Kind::plane: return rounded_in_plane(at);
  }
  return at;
}

// The next point of a line's grid or of kind `point`, beyond a point between two of the grid.
Point Session::next_point(const At& at, const GridLine& line, const Floor& m, bool is_up, const Near& near) {
  const Point grid = line_point(*soup_, line, is_up ? m.floor + 1 : m.floor);
  const Direction along = Direction::along(line.line);
  const bool turns = is_up != line.is_upwards(along);
  Segment segment(at.x, at.star, turns ? -along : along);
  if (line.is_edge()) segment.within(line.edge);
  segment.find_first(near, segment.at_foot(grid), false, times_);
  return times_.empty() ? grid : line.meeting(times_.front());
}

At* Session::rounded_on_line(At* at) {
  const GridLine line = line_of(*at->star);
  const Floor m = line.parameter(at->x);
  if (m.is_whole) {
    at->x = line_point(*soup_, line, m.floor);
    return at;
  }
  find_near(line_point(*soup_, line, m.floor), line_point(*soup_, line, m.floor + 1), near_end_);
  const Point below = next_point(*at, line, m, false, near_end_), above = next_point(*at, line, m, true, near_end_);
  const bool is_up = is_nearer(p_, above, below);
  Direction back = Direction::along(line.line);
  if (is_up == line.is_upwards(back)) back = -back;
  make_end(*next_, is_up ? above : below, near_end_, back, into_cell(*at));
  return next_;
}

// The corner nearest to p of the grid triangle or grid segment of f that x lies in. is_same: x is one.
Place Session::corner_of_cell(const Face& f, const Point& x, bool& is_same) const {
  const Floor b = weight_below(f, Weight::of_b, x), c = weight_below(f, Weight::of_c, x), sum = weight_below(f, Weight::sum, x);
  is_same = b.is_whole && c.is_whole;
  if (is_same) return triangle_place(f, b.floor, c.floor);
  // Corners of the smallest part of the grid around x are on no other side of a grid line than x.
  const auto is_beyond = [](std::int64_t corner, const Floor& own) {
    return own.is_whole ? corner != own.floor : corner < own.floor || corner > own.floor + 1;
  };
  std::optional<Place> best;
  Point nearest;
  for (const std::int64_t k : {b.floor, b.floor + 1})
    for (const std::int64_t l : {c.floor, c.floor + 1}) {
      if (is_beyond(k, b) || is_beyond(l, c) || is_beyond(k + l, sum)) continue;
      const Place place = triangle_place(f, k, l);
      const Point corner = *point_of(*soup_, place);
      if (best && !is_nearer(p_, corner, nearest)) continue;
      best = place;
      nearest = corner;
    }
  return *best;
}

At* Session::rounded_in_plane(At* at) {
  const Side side = side_in(*at);
  const Face& f = *at->star->blocking(side).face;
  const Direction w = at->star->up(side);
  bool is_same = false;
  const Place place = corner_of_cell(f, at->x, is_same);
  const Point c = triangle_point(*soup_, f, place.numbers[1], place.numbers[2]);
  const auto keep_place = [&] {
    const auto& [number, k, l, unused] = place.numbers;
    if (k > 0 && l > 0 && k + l < kGrid) rounded_place_ = place;
  };
  if (is_same) {
    at->x = c;
    keep_place();
    return at;
  }
  const Vector3<Whole> way = way_between(at->x, c);
  Direction along = Direction::of(way, about_way(way, at->x, c));
  along.in_plane = &f;
  Segment segment(at->x, at->star, along);
  segment.within(&f);
  find_near(at->x, c, near_end_);
  if (is_stopped(segment, segment.at_target(c), w, near_end_)) return is_exhausted() ? stop_ : rounded(stop_);
  make_end(*next_, c, near_end_, -along, w);
  if (!is_exhausted()) keep_place();
  return next_;
}

// The place of a point that rounding gives.
Place Session::grid_place(const At& at) const {
  if (at.star->kind() == Star::Kind::point) return point_place(*at.star);
  if (at.star->kind() == Star::Kind::line) {
    const GridLine line = line_of(*at.star);
    return line.place(line.nearest(at.x));
  }
  const Face& f = *at.star->blocking(side_in(at)).face;
  return triangle_place(f, nearest_weight(f, Weight::of_b, at.x), nearest_weight(f, Weight::of_c, at.x));
}

Place Session::rest_on_line(At*& r) {
  const GridLine line = line_of(*r->star);
  std::int64_t m = line.nearest(r->x);
  if (line.is_edge()) m = std::clamp(m, std::int64_t{1}, kGrid - 1);
  const Point c = line_point(*soup_, line, m);
  if (is_same(c, r->x)) {
    r->x = c;
    return line.place(m);
  }
  Direction along = Direction::along(line.line);
  const Vector3<Whole> way = way_between(r->x, c);
  if (sign_of([&]<class N>() {
        if constexpr (std::is_same_v<N, Ball>)
          return dot(along.get<N>(), about_way(way, r->x, c));
        else
          return dot(along.get<N>(), way);
      }) < 0)
    along = -along;
  Segment segment(r->x, r->star, along);
  if (line.is_edge()) segment.within(line.edge);
  find_near(r->x, c, near_end_);
  segment.find_first(near_end_, segment.at_foot(c), true, times_);
  if (!times_.empty()) return line.foot(hand_);
  r->x = c;  // the same triangles hold it
  return line.place(m);
}

Place Session::rest_in_plane(At*& r) {
  const Side side = side_in(*r);
  const Face& f = *r->star->blocking(side).face;
  std::int64_t k = std::max(nearest_weight(f, Weight::of_b, r->x), std::int64_t{1}),
               l = std::max(nearest_weight(f, Weight::of_c, r->x), std::int64_t{1});
  if (const std::int64_t excess = k + l - (kGrid - 1); excess > 0) (k >= l ? k : l) -= excess;
  const Place place = triangle_place(f, k, l);
  const Point c = triangle_point(*soup_, f, k, l);
  if (is_same(c, r->x)) {
    r->x = c;
    return place;
  }
  const Direction w = r->star->up(side);
  const Vector3<Whole> way = way_between(r->x, c);
  Direction along = Direction::of(way, about_way(way, r->x, c));
  along.in_plane = &f;
  Segment segment(r->x, r->star, along);
  segment.within(&f);
  find_near(r->x, c, near_end_);
  const Time most = segment.at_target(c);
  segment.find_first(near_end_, most, true, times_);
  if (times_.empty()) {  // the same triangles hold it
    look_at(*r->star);
    r->x = c;
    return place;
  }
  const Place foot{PlaceKind::foot, PlaceKind::triangle, {f.index(), 0, 0, 0}, hand_};
  if (is_stopped(segment, most, w, near_end_)) return foot;
  const Vector3<Whole> way_back = way_between(c, r->x);
  Direction back = Direction::of(way_back, about_way(way_back, c, r->x));
  back.in_plane = &f;
  make_end(*next_, c, near_end_, back, w);
  if (is_exhausted()) return foot;
  Segment returning(c, next_->star, back);
  returning.within(&f);
  if (is_stopped(returning, returning.at_target(r->x), w, near_end_)) return foot;
  r = next_;
  return place;
}

}  // namespace forceshade::fast::soups
