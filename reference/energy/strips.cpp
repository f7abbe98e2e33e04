// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy/strips.h"

#include "reference/laws/slow_geometry.h"
#include "reference/laws/with_law.h"
#include "reference/numbers/intervals.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

using Strips = std::vector<Strip>;

Strip plane_of(const BumpGeometry<Enclosure>& g) {
  return {g.w / 2, kDomainEnd, 0, 0, false};
}

Strip side_of(const BumpGeometry<Enclosure>& g, const Enclosure& left, const Enclosure& steepness, bool is_shaded) {
  return {left, g.w / 2, 0, -steepness, is_shaded};
}

// The force of a round surface is not K·(H - z).
Strips strips_of(RoundSurface, const BumpGeometry<Enclosure>&, bool) {
  return {};
}

Strips strips_of(LevelSurface, const BumpGeometry<Enclosure>& g, bool is_shaded) {
  if (!is_shaded) return {{0, kDomainEnd, 0, 0, false}};
  return {{0, g.w / 2, 0, 0, true}, plane_of(g)};
}

Strips strips_of(TwoPolygons, const BumpGeometry<Enclosure>& g, bool is_shaded) {
  return {side_of(g, 0, 2 * g.h / g.w, is_shaded), plane_of(g)};
}

Strips strips_of(ThreePolygons, const BumpGeometry<Enclosure>& g, bool is_shaded) {
  const Enclosure top = g.w_prime / 2;
  return {{0, top, g.h_prime, 0, is_shaded}, side_of(g, top, 2 * g.h_prime / (g.w - g.w_prime), is_shaded), plane_of(g)};
}

}  // namespace

Half half_of(const Law& law) {
  const BumpGeometry<Enclosure> g = enclosing_geometry(law.parameters());
  return {g, with_law(law.id(), [&](auto of) { return strips_of(typename decltype(of)::Surface{}, g, of.kIsShaded); })};
}

Enclosure height_over_axis(const BumpGeometry<Enclosure>& g, const Enclosure& x) {
  return sqrt(larger(0, (g.R - x) * (g.R + x)));
}

Enclosure area_over_axis(const BumpGeometry<Enclosure>& g, const Enclosure& x) {
  return (x * height_over_axis(g, x) + g.R * g.R * asin(smaller(1, x / g.R))) / 2;
}

Enclosure share_upwards(const BumpGeometry<Enclosure>& g, const Strip& strip, const Enclosure& x) {
  if (strip.is_shaded) return height_over_axis(g, x) / g.R;
  return 1 / sqrt(1 + strip.slope * strip.slope);
}

}  // namespace forceshade::reference
