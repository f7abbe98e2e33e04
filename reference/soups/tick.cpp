// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/tick.h"

#include <algorithm>
#include <utility>

namespace forceshade::reference::soups {
namespace {

using Cell = Star::Cell;
using Side = Star::Side;

constexpr std::size_t kMostLooks = 1U << 14;

struct TooManyLooks {};

class Descent {
 public:
  Descent(const Soup& soup, const std::array<float, 3>& position)
      : soup_(soup), position_(quantised(position)), p_(exact_point(position)) {}

  Tick run(const State& before, unsigned most_moves);
  std::size_t looks() const { return looks_; }

 private:
  struct End {  // of a move
    At at;
    bool is_rest;
  };

  std::optional<End> flight(const Vector& g);
  End along_piece(const At& g, const Way& way);
  End along_ray(const At& g, const Way& way);
  const At& looked_at(const At& at);
  At on_surface(const Vector& x, const std::optional<Star::Name>& name = {}) const;
  Tick ended(const At& r, unsigned moves, State after, bool is_at_goal, Status status = Status::contact) const;
  std::optional<At> obstacle(const Vector& from, const Vector& along, const Rational& most, const Vector& w);

  struct Rounded {
    At at;
    std::optional<Place> place = {};  // of a triangle's grid that gave it, where it is strictly inside
  };

  Rounded rounded(const At& at);
  At rounded_on_line(const At& at);
  Rounded rounded_in_plane(const At& at);
  struct Corner {
    Vector x;
    Place place;
  };
  Corner corner_of_cell(const Triangle& f, const Vector& x) const;
  Rational next_point(const At& at, const Line& line, bool is_up) const;

  State at_rest(const At& r);
  State on_line(const At& r) const;
  State in_plane(const At& r);
  State named(const Place& place, const At& at) const { return {place, at.star->name(at.cell)}; }
  Place grid_place(const At& at) const;
  bool is_nearer(const Vector& a, const Vector& b) const { return squared(p_ - a) < squared(p_ - b); }

  const Soup& soup_;
  std::array<float, 3> position_;
  Vector p_;
  std::size_t looks_ = 0, points_ = 0;  // of the tick; at the points of a move or a rest
};

// The wall of a cell's side in a plane, or any side on a line.
Side side_in(const At& at) {
  const std::vector<Side> sides = at.star->sides(at.cell);
  const auto wall = std::ranges::find_if(sides, [&](const Side& side) { return at.star->is_wall(side); });
  return wall == sides.end() ? sides.front() : *wall;
}

Place place_in(const Triangle& f, const Whole& k, const Whole& l) {
  return {PlaceKind::triangle, {}, {f.number, k.convert_to<std::size_t>(), l.convert_to<std::size_t>()}};
}

// A direction into the cell of a point on a line or in a plane, across it.
Vector into_cell(const At& at) {
  const Side side = side_in(at);
  return at.star->kind() == Star::Kind::plane ? at.star->up(side) : at.star->wedge(0, side).inner;
}

// The cell after a flight along u that ends at x, coming from cell A. Where u lies on the surface: that of a wall there.
Cell cell_after_flight(const Star& star, Cell A, const Vector& u, bool is_at_p) {
  std::vector<Side> walls = star.walls(A);
  const auto least = [&](bool prefers_A) {
    return star.cell(*std::ranges::min_element(
        walls, {}, [&](const Side& side) { return std::pair(prefers_A && star.cell(side) != A, star.name(side)); }));
  };
  if (!is_at_p && !star.cell(u)) {
    const auto leads_along = [&](const std::optional<std::size_t>& ray) {
      return ray && same_direction(star.rays()[*ray].along, u);
    };
    const auto holds = [&](const Side& side) {
      const Star::Piece& piece = star.pieces()[side.piece];
      return (dot(piece.normal, u).is_zero() && star.is_inside(piece, u)) || leads_along(piece.from) || leads_along(piece.to);
    };
    if (std::ranges::any_of(walls, holds)) {
      std::erase_if(walls, [&](const Side& side) { return !holds(side); });
      return least(true);
    }
  } else if (!is_at_p) {
    return A;
  }
  const std::vector<Side> beside = star.sides(A);
  const bool has_wall = std::ranges::any_of(beside, [&](const Side& side) { return star.is_wall(side); });
  return has_wall || walls.empty() ? A : least(false);
}

// At a point of a move or of a rest.
const At& Descent::looked_at(const At& at) {
  looks_ += at.star->looks();
  points_ += at.star->looks();
  if (points_ > kMostLooks) throw TooManyLooks();
  return at;
}

std::optional<Descent::End> Descent::flight(const Vector& g) {
  const Vector u = p_ - g;
  looks_ += soup_.looks(g, p_);
  for (const Rational& t : soup_.changes(g, u, 1)) {
    At at = looked_at(at_point(soup_, g + t * u));
    const Cell A = at.star->cell(-u).value();
    const std::optional<Cell> ahead = at.star->cell(u);
    const bool is_at_p = t == 1;
    if (!is_at_p && ahead && at.star->reached(A).contains(*ahead)) continue;
    at.cell = cell_after_flight(*at.star, A, u, is_at_p);
    return End{at, is_at_p};
  }
  return {};
}

// The first point of the way where it may not go on, with the cell that it comes from.
std::optional<At> Descent::obstacle(const Vector& from, const Vector& along, const Rational& most, const Vector& w) {
  for (const Rational& t : soup_.changes(from, along, most)) {
    if (t == most) break;
    const At at = looked_at(at_end(soup_, from + t * along, -along, w));
    const std::optional<Cell> ahead = at.star->cell(along, w);
    if (!ahead || !at.star->reached(at.cell).contains(*ahead)) return at;
  }
  return {};
}

Descent::End Descent::along_piece(const At& g, const Way& way) {
  looks_ += soup_.looks(g.x, way.q);
  const Triangle& f = g.star->blocking(way.wall);
  const Vector w = g.star->up(way.wall), e = way.q - g.x;
  const Rational share = way.share();
  Rational end = share;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational grows = dot(cross(f.side(i), e), f.normal);
    if (grows < 0) end = std::min<Rational>(end, -f.inside(i, g.x) / grows);
  }
  if (const std::optional<At> at = obstacle(g.x, e, end, w)) return {*at, at->x == p_};
  const At at = looked_at(at_end(soup_, g.x + end * e, -e, w));
  return {at, (share == 1 && f.holds_strictly(way.q)) || at.x == p_};
}

Descent::End Descent::along_ray(const At& g, const Way& way) {
  looks_ += soup_.looks(g.x, way.q);
  const Vector e = way.q - g.x;
  const Rational share = way.share();
  const std::vector<Rational> changes = soup_.changes(g.x, e, share);
  const Vector end = g.x + (changes.empty() ? share : changes.front()) * e;
  const At at = looked_at(at_end(soup_, end, -e, g.star->wedge(*way.ray, way.wall).inner));
  return {at, (share == 1 && changes.empty()) || at.x == p_};
}

// The parameter of the next point of a line's grid or of kind `point`; from a grid point, this.
Rational Descent::next_point(const At& at, const Line& line, bool is_up) const {
  const Rational m = line.parameter(at.x);
  const Rational grid(floor(m) + (is_up && !is_whole(m) ? 1 : 0));
  const std::vector<Rational> changes = soup_.changes(at.x, line.at(grid) - at.x, 1);
  return changes.empty() ? grid : m + changes.front() * (grid - m);
}

At Descent::rounded_on_line(const At& at) {
  const Line line = line_of(soup_, *at.star, at.x);
  const Rational m = line.parameter(at.x);
  if (is_whole(m)) return at;
  const Vector below = line.at(next_point(at, line, false)), above = line.at(next_point(at, line, true));
  const Vector& nearer = is_nearer(above, below) ? above : below;
  return looked_at(at_end(soup_, nearer, at.x - nearer, into_cell(at)));
}

// The corner nearest to p of the grid triangle or grid segment of f that x lies in.
Descent::Corner Descent::corner_of_cell(const Triangle& f, const Vector& x) const {
  const auto [beta, gamma] = f.weights(x);
  const Rational b = beta * Rational(kGrid), c = gamma * Rational(kGrid), sum = b + c;
  std::optional<Corner> best;
  for (const int i : {0, 1})
    for (const int j : {0, 1}) {
      const Rational k(floor(b) + i), l(floor(c) + j);
      // Corners of the smallest part of the grid around x are on no other side of a grid line than x.
      const auto is_beyond = [](const Rational& corner, const Rational& own) {
        return is_whole(own) ? corner != own : corner < Rational(floor(own)) || corner > Rational(floor(own) + 1);
      };
      if (is_beyond(k, b) || is_beyond(l, c) || is_beyond(k + l, sum)) continue;
      const Vector corner = f.at(k / Rational(kGrid), l / Rational(kGrid));
      if (!best || is_nearer(corner, best->x)) best = {corner, place_in(f, Whole(numerator(k)), Whole(numerator(l)))};
    }
  return *best;
}

Descent::Rounded Descent::rounded_in_plane(const At& at) {
  const Side side = side_in(at);
  const Vector w = at.star->up(side);
  const Triangle& f = at.star->blocking(side);
  const auto [c, corner] = corner_of_cell(f, at.x);
  const std::optional<Place> place = f.holds_strictly(c) ? std::optional(corner) : std::nullopt;
  if (c == at.x) return {at, place};
  const Vector along = c - at.x;
  if (const std::optional<At> stopped = obstacle(at.x, along, 1, w)) return rounded(*stopped);
  return {looked_at(at_end(soup_, c, -along, w)), place};
}

Descent::Rounded Descent::rounded(const At& at) {
  switch (at.star->kind()) {
    case Star::Kind::point: return {at};
    case Star::Kind::line: return {rounded_on_line(at)};
    case Star::Kind::plane: return rounded_in_plane(at);
  }
  return {at};
}

// The place of a point that rounding gives.
Place Descent::grid_place(const At& at) const {
  if (at.star->kind() == Star::Kind::point) return point_place(soup_, *at.star, at.x);
  if (at.star->kind() == Star::Kind::line) {
    const Line line = line_of(soup_, *at.star, at.x);
    return line_place(line, nearest(line.parameter(at.x)));
  }
  const Triangle& f = at.star->blocking(side_in(at));
  const auto [beta, gamma] = f.weights(at.x);
  return place_in(f, nearest(beta * Rational(kGrid)), nearest(gamma * Rational(kGrid)));
}

State Descent::on_line(const At& r) const {
  const Line line = line_of(soup_, *r.star, r.x);
  Whole m = nearest(line.parameter(r.x));
  if (!line.edge.empty()) m = std::clamp(m, Whole(1), Whole(kGrid - 1));
  const Vector c = line.at(Rational(m));
  if (c == r.x) return named(line_place(line, m), r);
  if (!soup_.changes(r.x, c - r.x, 1).empty()) return named(line_foot(line, position_), r);
  return named(line_place(line, m), at_end(soup_, c, r.x - c, into_cell(r)));
}

State Descent::in_plane(const At& r) {
  const Side side = side_in(r);
  const Triangle& f = r.star->blocking(side);
  const auto [beta, gamma] = f.weights(r.x);
  Whole k = std::max(nearest(beta * Rational(kGrid)), Whole(1)), l = std::max(nearest(gamma * Rational(kGrid)), Whole(1));
  if (const Whole excess = k + l - Whole(kGrid - 1); excess > 0) (k >= l ? k : l) -= excess;
  const Vector c = f.at(Rational(k) / Rational(kGrid), Rational(l) / Rational(kGrid)), along = c - r.x, w = r.star->up(side);
  const Place place = place_in(f, k, l);
  if (c == r.x) return named(place, r);
  const State foot = named({PlaceKind::foot, PlaceKind::triangle, {f.number}, position_}, r);
  try {
    if (obstacle(r.x, along, 1, w)) return foot;
    const At at = looked_at(at_end(soup_, c, -along, w));
    return obstacle(c, -along, 1, w) ? foot : named(place, at);
  } catch (const TooManyLooks&) {
    return foot;
  }
}

State Descent::at_rest(const At& r) {
  points_ = 0;
  switch (r.star->kind()) {
    case Star::Kind::point: return named(point_place(soup_, *r.star, r.x), r);
    case Star::Kind::line: return on_line(r);
    case Star::Kind::plane: return in_plane(r);
  }
  return {};
}

// The end of a tick at r. is_at_goal: r is q or p.
Tick Descent::ended(const At& r, unsigned moves, State after, bool is_at_goal, Status status) const {
  Tick tick{status, moves, std::move(after), Rest{r, r.x - p_, {}}};
  const std::optional<Way> way = steepest(r, p_);
  const bool is_held = way && way->static_friction > 0;
  if (is_held) tick.rest->tangential = r.x - way->q;
  if (status == Status::unfinished) return tick;
  if ((is_at_goal && !r.is_rough()) || !is_held || way->is_within(way->dynamic_friction, 2)) tick.after.is_slipping = false;
  return tick;
}

At Descent::on_surface(const Vector& x, const std::optional<Star::Name>& name) const {
  At at = at_point(soup_, x);
  at.cell = name ? at.star->cell(*name).value() : at.star->least_cell();
  return at;
}

Tick Descent::run(const State& before, unsigned most_moves) {
  std::optional<At> on;  // nothing: free at g
  Vector g = p_;
  std::optional<Place> kept = before.place;  // of g, where it is known
  bool is_slipping = before.is_slipping;
  const auto free = [&](unsigned moves) { return Tick{Status::free, moves, {Place{PlaceKind::free, {}, {}, position_}}}; };
  const auto with_bit = [&](State state) {
    state.is_slipping = is_slipping;
    return state;
  };
  const auto resting = [&](unsigned moves, Status status = Status::contact) {
    return ended(*on, moves, with_bit(named(kept ? *kept : grid_place(*on), *on)), on->x == p_, status);
  };
  const auto unfinished = [&](unsigned moves) {
    return on ? resting(moves, Status::unfinished) : Tick{Status::unfinished, moves, before};
  };
  if (!before.place) {
    if (soup_.holding(p_).empty()) return free(0);
    try {
      const At first = looked_at(on_surface(p_));
      if (!first.is_rough()) return ended(first, 0, at_rest(first), true);
      Rounded next = rounded(first);
      on = std::move(next.at);
      kept = std::move(next.place);
    } catch (const TooManyLooks&) {
      return unfinished(0);
    }
    g = on->x;
  } else {
    g = point_of(soup_, *kept);
    if (kept->kind != PlaceKind::free) on = on_surface(g, before.cell);
  }
  for (unsigned moves = 0;; ++moves) {
    const Vector u = p_ - g;
    if (is_zero(u)) return on ? resting(moves) : free(moves);
    const std::optional<Cell> towards = on ? on->star->cell(u) : std::nullopt;
    const bool flies = !on || (towards && on->star->reached(on->cell).contains(*towards));
    std::optional<Way> way;
    if (!flies) {
      way = steepest(*on, p_);
      if (!way || way->is_within(is_slipping ? way->dynamic_friction : way->static_friction)) return resting(moves);
    }
    if (moves == most_moves || looks_ >= kMostLooks) return unfinished(moves);
    points_ = 0;
    Rounded next;
    try {
      const std::optional<End> end = flies ? flight(g) : way->ray ? along_ray(*on, *way) : along_piece(*on, *way);
      if (!end) return free(moves + 1);
      if (end->is_rest && !end->at.is_rough()) {
        is_slipping |= !flies;
        return ended(end->at, moves + 1, with_bit(at_rest(end->at)), true);
      }
      next = rounded(end->at);
    } catch (const TooManyLooks&) {
      return unfinished(moves);
    }
    if (on && !is_nearer(next.at.x, g)) return resting(moves);
    is_slipping |= !flies;
    on = std::move(next.at);
    kept = std::move(next.place);
    g = on->x;
  }
}

}  // namespace

Tick tick(const Soup& soup, const State& before, const std::array<float, 3>& position, unsigned most_moves) {
  Descent descent(soup, position);
  Tick made = descent.run(before, most_moves);
  made.looks = descent.looks();
  return made;
}

}  // namespace forceshade::reference::soups
