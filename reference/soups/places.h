// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The places that a god-object's state can name on a soup: grid points of lines and triangles, points where lines meet, and
// feet.

#include <vector>

#include "reference/soups/way.h"

namespace forceshade::reference::soups {

// The line on which a point of kind `line` lies, with its grid.
struct Line {
  std::vector<std::size_t> edge = {};   // two names of vertices, of an edge that lies in it; otherwise empty
  std::size_t triangle = 0, other = 0;  // otherwise the lowest here, and the lowest of another plane
  std::size_t corner = 0;               // whose weight in the triangle changes fastest along the line
  Vector begin, step;                   // its point m is begin + m/2^24 step

  Rational parameter(const Vector& x) const { return dot(x - begin, step) / squared(step) * Rational(kGrid); }
  Vector at(const Rational& m) const { return begin + m / Rational(kGrid) * step; }
};

Line line_of(const Soup& soup, const Star& star, const Vector& x);

enum class PlaceKind { free, vertex, edge, triangle, crossing, edges, edge_and_triangle, triangles, foot };

// The words of docs/soups.md: `v i`, `e i j m`, `t f k l`, `c f h i k`, `ee i j k l`, `ef i j f`, `fff f g h`, and for a foot
// `t f`, `e i j` or `c f h i`.
struct Place {
  PlaceKind kind = PlaceKind::free;
  PlaceKind of_foot = PlaceKind::free;  // triangle, edge or crossing
  std::vector<std::size_t> numbers = {};
  std::array<float, 3> position = {};  // free: where it is; foot: of which hand

  bool operator==(const Place&) const = default;
};

Vector point_of(const Soup& soup, const Place& place);

// The place of a point of kind `point`.
Place point_place(const Soup& soup, const Star& star, const Vector& x);
Place line_place(const Line& line, const Whole& m);
Place line_foot(const Line& line, const std::array<float, 3>& position);

}  // namespace forceshade::reference::soups
