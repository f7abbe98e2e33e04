// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/energy/strips.h"

#include "forceshade/reference/laws/slow_geometry.h"
#include "forceshade/reference/numbers/intervals.h"
#include "forceshade/reference/position.h"

namespace forceshade::reference {
namespace {}  // namespace

Half half_of(const Law& law) {
  Half half{enclosing_geometry(law.parameters()), {}};
  const BumpGeometry<Enclosure>& g = half.g;
  const Enclosure zero = 0, rim = g.w / 2, end = kDomainEnd;
  const auto side = [&](const Enclosure& left, const Enclosure& steepness, bool is_shaded) {
    return Strip{left, rim, zero, -steepness, is_shaded};
  };
  const Strip plane{rim, end, zero, zero, false};
  const Enclosure two = 2 * g.h / g.w, three = 2 * g.h_prime / (g.w - g.w_prime), top = g.w_prime / 2;
  switch (law.id()) {
    case LawId::cylinder:
    case LawId::bump_cylinder: break;
    case LawId::wall:
    case LawId::bump_1p: half.strips = {{zero, end, zero, zero, false}}; break;
    case LawId::bump_2p: half.strips = {side(zero, two, false), plane}; break;
    case LawId::bump_3p: half.strips = {{zero, top, g.h_prime, zero, false}, side(top, three, false), plane}; break;
    case LawId::bump_1p_shaded: half.strips = {{zero, rim, zero, zero, true}, plane}; break;
    case LawId::bump_2p_shaded: half.strips = {side(zero, two, true), plane}; break;
    case LawId::bump_3p_shaded: half.strips = {{zero, top, g.h_prime, zero, true}, side(top, three, true), plane}; break;
  }
  return half;
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
