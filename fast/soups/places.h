// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The places that a god-object's state can name on a soup: grid points of lines and triangles, points where lines meet, and
// feet.

#include <array>
#include <optional>

#include "fast/soups/segment.h"

namespace forceshade::fast::soups {

enum class PlaceKind : std::uint8_t {
  nowhere,
  free,
  vertex,
  edge,
  triangle,
  crossing,
  edges,
  edge_and_triangle,
  triangles,
  foot
};

// The words of docs/soups.md: `v i`, `e i j m`, `t f k l`, `c f h i k`, `ee i j k l`, `ef i j f`, `fff f g h`, and for a foot
// `t f`, `e i j` or `c f h i`.
struct Place {
  PlaceKind kind = PlaceKind::nowhere;
  PlaceKind of_foot = PlaceKind::nowhere;  // triangle, edge or crossing
  std::array<std::uint32_t, 4> numbers{};
  std::array<float, 3> position{};  // free: where it is; foot: of which hand

  bool operator==(const Place&) const = default;
};

inline Place vertex_place(std::uint32_t vertex) noexcept {
  return {PlaceKind::vertex, PlaceKind::nowhere, {vertex, 0, 0, 0}, {}};
}

// Nothing where the soup has no such place.
std::optional<Point> point_of(const Soup& soup, const Place& place);

// The line on which a point of kind `line` lies, with its grid.
struct GridLine {
  Line line;
  std::array<std::uint32_t, 2> edge{kNone, kNone};  // of an edge that lies in it, the lower first; otherwise
  const Face *f = nullptr, *h = nullptr;            // the lowest here, and the lowest of another plane
  std::size_t corner = 0;                           // whose weight in f changes fastest along the line

  bool is_edge() const noexcept { return edge[0] != kNone; }
  Floor parameter(const Point& x) const;       // at or below that of x
  std::int64_t nearest(const Point& x) const;  // to that of x, ties to even
  Place place(std::int64_t m) const;
  Place foot(const std::array<float, 3>& hand) const;
  // The point in which the line meets a triangle that begins or ends there first, from a point of it on.
  Point meeting(const Time& t) const;
  // True if the direction leads to higher parameters along the line.
  bool is_upwards(const Direction& along) const;

 private:
  template <class N>
  Quotient<N> value(const Point& x) const;
};
GridLine line_of(const Star& star);

// The place of a point of kind `point`.
Place point_place(const Star& star);

}  // namespace forceshade::fast::soups
