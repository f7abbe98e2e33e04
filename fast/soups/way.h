// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The direction in which the surface leads nearest to the hand, and how it presses there.

#include <array>
#include <optional>

#include "fast/soups/star.h"

namespace forceshade::fast::soups {

// A point of the surface and a cell there.
struct At {
  Point x;
  const Star* star = nullptr;
  Star::Cell cell = 0;
};

// v, along a ray or inside a piece, beside a wall; q: the point nearest to the hand p on the ray's line or in the piece's
// plane.
struct Way {
  Star::Side wall{};
  std::uint32_t ray = kNone;
  Point q;
  float static_friction = 0, dynamic_friction = 0;  // the largest of the walls that it goes along

  bool is_along_ray() const noexcept { return ray != kNone; }
};

// Nothing where no direction leads nearer to p. u: p less the point.
std::optional<Way> steepest(const Soup& soup, const At& g, const Point& p, const Direction& u);

// factor·|q - g| <= mu·|p - q|, where infinity times 0 is 0.
bool is_within(const Way& way, const At& g, const Point& p, float mu, int factor = 1);
// The share of the way to q, in units of 1/kGrid, that friction lets it slip: the least j with
// (kGrid - j)|q - g| <= kGrid mu |p - q|.
std::int64_t share_of(const Way& way, const At& g, const Point& p);

}  // namespace forceshade::fast::soups
