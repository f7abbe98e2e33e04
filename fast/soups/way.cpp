// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/way.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fast/numbers/fixed_integer.h"

namespace forceshade::fast::soups {
namespace {

using Side = Star::Side;

struct Candidate {
  Side wall{};
  std::uint32_t ray = kNone;
  Ball gain{};  // the signed square of u·v, v of unit length
};

// Its numerator and denominator: of a ray r, s|s|/r² with s = u·r; inside a piece, |u x n|²/n².
template <class N>
Quotient<N> gain_of(const Star& star, const Candidate& one, const Direction& u) {
  if (one.ray != kNone) {
    const Vector3<N> r = star.rays()[one.ray].along.get<N>();
    const N s = dot(u.get<N>(), r);
    return {s * size_of(s), squared(r)};
  }
  const Vector3<N> n = star.plane(star.pieces()[one.wall.piece].plane).get<N>();
  return {squared(cross(u.get<N>(), n)), squared(n)};
}

int compare_gains(const Star& star, const Candidate& a, const Candidate& b, const Direction& u) {
  if (a.ray != kNone && a.ray == b.ray) return 0;
  if (a.ray == kNone && b.ray == kNone && a.wall.piece == b.wall.piece) return 0;
  const Ball more = a.gain - b.gain;
  if (more.is_sure()) return more.value > 0 ? 1 : -1;
  note_exact_decision();
  const Quotient<Whole> one = gain_of<Whole>(star, a, u), other = gain_of<Whole>(star, b, u);
  return (one.num * other.den - other.num * one.den).sign();
}

// The place of a candidate among equal ones: rays of edges first, by their names.
std::tuple<int, std::uint32_t, std::uint32_t> order_of(const Star& star, const Candidate& one) {
  if (one.ray == kNone) return {2, star.blocking(one.wall).face->index(), 0};
  const Star::Ray& ray = star.rays()[one.ray];
  if (ray.is_edge()) return {0, ray.edge[0], ray.edge[1]};
  const Star::Held* f = nullptr;
  for (const Star::Held& held : star.triangles()) {
    if (!star.is_in(one.ray, held.plane) || !star.covers(held, ray.along)) continue;
    if (f == nullptr)
      f = &held;
    else if (held.plane != f->plane)
      return {1, f->face->index(), held.face->index()};
  }
  return {1, 0, 0};  // no ray along no edge is in one plane alone
}

bool is_before(const At& g, const Candidate& a, const Candidate& b, const Direction& u) {
  const Star& star = *g.star;
  if (const int sign = compare_gains(star, a, b, u); sign != 0) return sign > 0;
  const auto of_a = order_of(star, a), of_b = order_of(star, b);
  if (of_a != of_b) return of_a < of_b;
  const bool a_is_elsewhere = star.cell(a.wall) != g.cell, b_is_elsewhere = star.cell(b.wall) != g.cell;
  if (a_is_elsewhere != b_is_elsewhere) return b_is_elsewhere;
  return star.name(a.wall) < star.name(b.wall);
}

void add_friction(const Soup& soup, Way& way, const Star& star, const Side& side) {
  for (const std::uint32_t t : star.triangles_of(star.pieces()[side.piece])) {
    const Star::Held& held = star.triangles()[t];
    if (!star.blocks(held, side)) continue;
    way.static_friction = std::max(way.static_friction, soup.static_friction(*held.face));
    way.dynamic_friction = std::max(way.dynamic_friction, soup.dynamic_friction(*held.face));
  }
}

// mu in units of 2^-33, of which it is a whole multiple.
template <class N>
N coefficient(float mu) {
  int exponent = 0;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(static_cast<double>(mu), &exponent), 24));
  if constexpr (std::is_same_v<N, Ball>)
    return Ball::exactly(static_cast<double>(mu) * 0x1p33);
  else
    return Whole::scaled(significand, exponent - 24 + 33);
}

// |q - g|² and |p - q|², times one positive number.
template <class N>
Quotient<N> pull_and_pressure(const Way& way, const At& g, const Point& p) {
  const Scaled<N>&q = way.q.get<N>(), &from = g.x.get<N>(), &hand = p.get<N>();
  return {squared(hand.w * (from.w * q.x - q.w * from.x)), squared(from.w * (q.w * hand.x - hand.w * q.x))};
}

int sign_of_pressure(const Way& way, const At& g, const Point& p) {
  return sign_of([&]<class N>() { return pull_and_pressure<N>(way, g, p).den; });
}

}  // namespace

std::optional<Way> steepest(const Soup& soup, const At& g, const Point& p, const Direction& u) {
  const Star& star = *g.star;
  std::optional<Candidate> best;
  const auto offer = [&](Candidate one) {
    const Quotient<Ball> its = gain_of<Ball>(star, one, u);
    one.gain = its.num / its.den;
    if (!best || is_before(g, one, *best, u)) best = one;
  };
  const auto leads_nearer = [&](std::uint32_t ray) {
    return sign_of([&]<class N>() { return dot(u.get<N>(), star.rays()[ray].along.get<N>()); }) > 0;
  };
  const auto is_aside = [&](const Star::Piece& piece) { return !are_parallel(u, star.plane(piece.plane)); };
  star.for_walls(g.cell, [&](const Side& wall) {
    const Star::Piece& piece = star.pieces()[wall.piece];
    if (star.is_inside(piece, u) && is_aside(piece)) offer({wall, kNone, {}});
    if (piece.is_whole()) return;
    if (leads_nearer(piece.from)) offer({wall, piece.from, {}});
    if (piece.to != piece.from && leads_nearer(piece.to)) offer({wall, piece.to, {}});
  });
  if (!best) return {};
  Way way;
  way.wall = best->wall;
  way.ray = best->ray;
  if (soup.has_friction()) add_friction(soup, way, star, way.wall);
  const Vector3<Whole>& hand = p.get<Whole>().x;
  if (!way.is_along_ray()) {
    way.q = Point(foot_in_plane(corners<Whole>(*star.blocking(way.wall).face), hand));
    return way;
  }
  if (soup.has_friction()) add_friction(soup, way, star, star.wedge(way.ray, way.wall).next);
  const Line& line = star.rays()[way.ray].along.line;
  way.q = Point(line.is_edge() ? foot_on_edge(corner_point<Whole>(line.a), corner_point<Whole>(line.b), hand)
                               : foot_on_crossing(corners<Whole>(*line.f), corners<Whole>(*line.h), hand));
  return way;
}

bool is_within(const Way& way, const At& g, const Point& p, float mu, int factor) {
  if (sign_of_pressure(way, g, p) == 0) return is_same(way.q, g.x);
  if (std::isinf(mu)) return true;
  return sign_of([&]<class N>() {
           const Quotient<N> its = pull_and_pressure<N>(way, g, p);
           const N limit = coefficient<N>(mu);
           return (N::of(factor * factor) * its.num).shifted(66) - limit * limit * its.den;
         }) <= 0;
}

std::int64_t share_of(const Way& way, const At& g, const Point& p) {
  if (way.dynamic_friction == 0 || sign_of_pressure(way, g, p) == 0) return kGrid;
  // The largest i with i² 2^66 |q - g|² <= 2^48 (2^33 mu)² |p - q|².
  const auto is_held = [&](std::int64_t i) {
    return sign_of([&]<class N>() {
             const Quotient<N> its = pull_and_pressure<N>(way, g, p);
             const N limit = coefficient<N>(way.dynamic_friction);
             return (N::of(i) * N::of(i) * its.num).shifted(66) - (limit * limit * its.den).shifted(48);
           }) <= 0;
  };
  const Quotient<Ball> its = pull_and_pressure<Ball>(way, g, p);
  const double guess =
      0x1p24 * static_cast<double>(way.dynamic_friction) * std::sqrt(std::max(its.den.value / its.num.value, 0.0));
  auto i =
      std::clamp(guess >= 0 ? static_cast<std::int64_t>(std::min(guess, 0x1p24)) : std::int64_t{0}, std::int64_t{0}, kGrid - 1);
  std::int64_t low = 0, high = kGrid;  // held; not held, for it slips
  for (const std::int64_t step : {std::int64_t{0}, std::int64_t{1}}) {
    const std::int64_t at = std::min(i + step, kGrid - 1);
    (is_held(at) ? low : high) = at;
  }
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (is_held(middle) ? low : high) = middle;
  }
  return kGrid - low;
}

}  // namespace forceshade::fast::soups
