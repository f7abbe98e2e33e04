// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/way.h"

#include <algorithm>
#include <utility>

namespace forceshade::reference::soups {
namespace {

using Side = Star::Side;

// The place of a ray among equal ones: rays of edges first, by their names.
std::tuple<int, std::size_t, std::size_t> order_of(const At& g, const Vector& along) {
  std::optional<std::pair<std::size_t, std::size_t>> least;
  std::vector<const Triangle*> holding;
  for (const Triangle* triangle : g.star->triangles()) {
    bool holds = dot(triangle->normal, along).is_zero();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!triangle->inside(i, g.x).is_zero()) continue;
      const Vector side = triangle->side(i);
      const std::size_t next = (i + 1) % 3;
      holds = holds && dot(cross(side, along), triangle->normal) >= 0;
      const bool goes_on = same_direction(side, along) && triangle->corner[next] != g.x;
      const bool goes_back = same_direction(-side, along) && triangle->corner[i] != g.x;
      if (!goes_on && !goes_back) continue;
      const std::pair<std::size_t, std::size_t> names = std::minmax(triangle->name[i], triangle->name[next]);
      if (!least || names < *least) least = names;
    }
    if (holds) holding.push_back(triangle);
  }
  if (least) return {0, least->first, least->second};
  const Triangle& f = *holding.front();
  const auto h = std::ranges::find_if(holding, [&](const Triangle* each) { return !are_parallel(each->normal, f.normal); });
  return {1, f.number, (*h)->number};
}

void add_friction(Way& way, const Star& star, const Side& side) {
  for (const Triangle* triangle : star.pieces()[side.piece].triangles) {
    if (!triangle->blocks_from(star.up(side))) continue;
    way.static_friction = std::max(way.static_friction, triangle->static_friction);
    way.dynamic_friction = std::max(way.dynamic_friction, triangle->dynamic_friction);
  }
}

void add_load(Way& way, const At& g, const Vector& p) {
  const Star& star = *g.star;
  const Vector u = p - g.x;
  add_friction(way, star, way.wall);
  if (way.ray) {
    add_friction(way, star, star.wedge(*way.ray, way.wall).next);
    const Vector& along = star.rays()[*way.ray].along;
    way.q = g.x + dot(u, along) / squared(along) * along;
  } else {
    way.q = g.x + across(u, star.pieces()[way.wall.piece].normal);
  }
  way.pull = squared(way.q - g.x);
  way.pressure = squared(p - way.q);
}

}  // namespace

bool At::is_rough() const {
  return std::ranges::any_of(star->triangles(), [](const Triangle* triangle) { return triangle->static_friction > 0; });
}

At at_point(const Soup& soup, const Vector& x) {
  return {x, std::make_shared<Star>(soup, x), 0};
}

At at_end(const Soup& soup, const Vector& x, const Vector& back, const Vector& w) {
  At at = at_point(soup, x);
  at.cell = at.star->cell(back, w).value();
  return at;
}

bool Way::is_before(const Way& other) const {
  if (gain != other.gain) return gain > other.gain;
  return std::tie(order, is_elsewhere, name) < std::tie(other.order, other.is_elsewhere, other.name);
}

bool Way::is_within(float mu, int factor) const {
  if (pressure.is_zero()) return pull.is_zero();
  return std::isinf(mu) || factor * factor * pull <= Rational(mu) * Rational(mu) * pressure;
}

Rational Way::share() const {
  if (pressure.is_zero()) return 1;
  const Rational mu = Rational(kGrid) * Rational(dynamic_friction);
  return Rational(Whole(kGrid) - sqrt(floor(mu * mu * pressure / pull))) / Rational(kGrid);
}

std::optional<Way> steepest(const At& g, const Vector& p) {
  const Star& star = *g.star;
  const Vector u = p - g.x;
  std::optional<Way> best;
  const auto offer = [&](Way way) {
    if (way.gain > 0 && (!best || way.is_before(*best))) best = std::move(way);
  };
  for (const Side& wall : star.walls(g.cell)) {
    const Star::Piece& piece = star.pieces()[wall.piece];
    const bool is_elsewhere = star.cell(wall) != g.cell;
    const Star::Name name = star.name(wall);
    const Vector projection = across(u, piece.normal);
    if (star.is_inside(piece, projection))
      offer({squared(projection), {2, star.blocking(wall).number, 0}, is_elsewhere, name, wall, {}});
    for (const std::optional<std::size_t>& ray : {piece.from, piece.to}) {
      if (!ray) continue;
      const Vector& along = star.rays()[*ray].along;
      offer({signed_square_along(u, along), order_of(g, along), is_elsewhere, name, wall, ray});
    }
  }
  if (best) add_load(*best, g, p);
  return best;
}

}  // namespace forceshade::reference::soups
