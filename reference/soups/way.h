// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The direction in which the surface leads nearest to the hand, and how it presses there.

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>

#include "reference/soups/star.h"

namespace forceshade::reference::soups {

inline constexpr std::uint32_t kGrid = std::uint32_t{1} << 24;

// A point of the surface and a cell there.
struct At {
  Vector x;
  std::shared_ptr<const Star> star;
  Star::Cell cell;

  bool is_rough() const;  // a triangle there has friction
};

At at_point(const Soup& soup, const Vector& x);  // in any cell
// A point in the cell of back + εw, for every small ε > 0, which is off the surface.
At at_end(const Soup& soup, const Vector& x, const Vector& back, const Vector& w);

// v, along a ray or inside a piece, beside a wall; q: the point nearest to the hand p on the ray's line or in the piece's
// plane.
struct Way {
  Rational gain;  // the signed square of u·v, above 0
  std::tuple<int, std::size_t, std::size_t> order;
  bool is_elsewhere;  // the wall is not beside the cell of g
  Star::Name name;
  Star::Side wall;
  std::optional<std::size_t> ray;
  Vector q = {};
  Rational pull = {}, pressure = {};                // |q - g|² and |p - q|²
  float static_friction = 0, dynamic_friction = 0;  // the largest of the walls that it goes along

  bool is_before(const Way& other) const;
  // factor·|q - g| <= mu·|p - q|, where infinity times 0 is 0.
  bool is_within(float mu, int factor = 1) const;
  // The share of the way to q that friction lets it slip: the least j/2^24 with (2^24 - j)|q - g| <= 2^24 mu |p - q|.
  Rational share() const;
};

// Nothing where no direction leads nearer to p.
std::optional<Way> steepest(const At& g, const Vector& p);

}  // namespace forceshade::reference::soups
