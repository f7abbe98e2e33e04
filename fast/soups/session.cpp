// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/session.h"

#include <algorithm>
#include <utility>

#include "fast/domain.h"
#include "fast/soups/force.h"
#include "fast/soups/looks.h"

namespace forceshade::fast::soups {
namespace {

using Cell = Star::Cell;
using Side = Star::Side;

// The cell after a flight along u that ends at `at`, coming from its cell. Where u lies on the surface: that of a wall there.
Cell cell_after_flight(const At& at, const Direction& u, bool is_at_p, bool u_is_off) {
  const Star& star = *at.star;
  if (!is_at_p && u_is_off) return at.cell;
  std::optional<Side> least;
  const auto offer = [&](const Side& side, bool prefers_own) {
    const auto rank = [&](const Side& one) { return std::pair(prefers_own && star.cell(one) != at.cell, star.name(one)); };
    if (!least || rank(side) < rank(*least)) least = side;
  };
  const auto leads_along = [&](std::uint32_t ray) {
    if (ray == kNone) return false;
    const Direction& along = star.rays()[ray].along;
    return sign_of([&]<class N>() { return dot(along.get<N>(), u.get<N>()); }) > 0 && are_parallel(along, u);
  };
  if (!is_at_p) {
    star.for_walls(at.cell, [&](const Side& side) {
      const Star::Piece& piece = star.pieces()[side.piece];
      if ((star.across(piece.plane, u) == 0 && star.is_inside(piece, u)) || leads_along(piece.from) || leads_along(piece.to))
        offer(side, true);
    });
    if (least) return star.cell(*least);
  }
  bool has_wall = false;
  star.for_sides(at.cell, [&](const Side& side) { has_wall = has_wall || star.is_wall(side); });
  if (has_wall) return at.cell;
  star.for_walls(at.cell, [&](const Side& side) { offer(side, false); });
  return least ? star.cell(*least) : at.cell;
}

}  // namespace

Session::Session(std::shared_ptr<const Soup> soup, float stiffness, bool is_shaded)
    : soup_(std::move(soup)), stiffness_(stiffness), is_shaded_(is_shaded) {
  for (KeptStar& each : stars_) each.star.reserve(kUsual);
  held_.reserve(kUsual);
  near_.reserve(kUsual);
  near_end_.reserve(kUsual);
  along_.reserve(kUsual);
  near_at_.reserve(2 * kUsual);
  times_.reserve(kUsual);
}

void Session::find_near(const Point& a, const Point& b, Near& near) {
  const Surroundings around(a.about(), b.about());
  near.clear();
  soup_->tree().along(a.about(), b.about(), [&](std::uint32_t f) {
    ++boxes_;
    if (around.is_at(soup_->faces()[f])) near.push_back(&soup_->faces()[f]);
  });
}

// Those whose boxes the way from a to b meets: all that hold a point of it are among them.
void Session::look_along(const Point& a, const Point& b, Near& near) {
  const Looks looks(a, b);
  near.clear();
  soup_->tree().along(a.about(), b.about(), [&](std::uint32_t f) {
    ++boxes_;
    if (looks.is_at(soup_->faces()[f])) near.push_back(&soup_->faces()[f]);
  });
  looks_ += near.size();
}

const Star& Session::star_at(const Point& x, const Near& near) {
  find_held(x, near, held_);
  KeptStar* oldest = nullptr;
  for (KeptStar& each : stars_) {
    if (each.star.is_of(held_)) {
      each.last_use = ++uses_;
      return each.star;
    }
    const bool is_in_use = std::ranges::any_of(ats_, [&](const At& at) { return at.star == &each.star; });
    if (!is_in_use && (oldest == nullptr || each.last_use < oldest->last_use)) oldest = &each;
  }
  oldest->last_use = ++uses_;
  oldest->star.make(*soup_, held_);
  return oldest->star;
}

// In the cell of back + εw, which is off the surface.
void Session::make_end(At& at, const Point& x, const Near& near, const Direction& back, const Direction& w) {
  at.x = x;
  at.star = &star_at(x, near);
  look_at(*at.star);
  if (!is_exhausted()) at.cell = at.star->cell(back, &w).value_or(0);
}

bool Session::make_on_surface(At& at, const Point& x) {
  find_near(x, x, near_end_);
  at.x = x;
  at.star = &star_at(x, near_end_);
  points_ = 0;
  look_at(*at.star);
  return !at.star->is_empty();
}

bool Session::make_in_cell(At& at, Point x, const Star::Name& name) {
  x.forget();
  if (!make_on_surface(at, x) || is_exhausted()) return false;
  const std::optional<Cell> cell = at.star->cell(name);
  if (cell) at.cell = *cell;
  return cell.has_value();
}

const Session::Near& Session::near_at(const Segment& segment, std::size_t& time) {
  near_at_ = along_;
  const Time& t = times_[time];
  do near_at_.push_back(times_[time].f);
  while (++time < times_.size() && segment.compare(t, times_[time]) == 0);
  return near_at_;
}

bool Session::is_stopped(const Segment& segment, const Time& most, const Direction& w, const Near& near) {
  segment.find_changes(near, most, false, times_, along_);
  for (std::size_t i = 0; i < times_.size();) {
    const Time& t = times_[i];
    make_end(*stop_, segment.point(t), near_at(segment, i), -segment.along(), w);
    if (is_exhausted()) return true;
    const std::optional<Cell> ahead = stop_->star->cell(segment.along(), &w);
    if (!ahead || !stop_->star->is_reached(stop_->cell, *ahead)) return true;
  }
  return false;
}

Session::End Session::flight(const Point& g) {
  const Vector3<Whole> way = way_between(g, p_);
  const Direction u = Direction::of(way, about_way(way, g, p_));
  look_along(g, p_, near_);
  const Segment segment(g, is_on_ ? on_->star : nullptr, u);
  const Time most = segment.at_target(p_);
  segment.find_changes(near_, most, true, times_, along_);
  for (std::size_t i = 0; i < times_.size();) {
    const Time& t = times_[i];
    const bool is_at_p = segment.compare(t, most) == 0;
    Point x = segment.point(t);
    if (is_at_p) x.take_numbers(p_);
    At& at = *end_;
    at.x = x;
    at.star = &star_at(x, near_at(segment, i));
    look_at(*at.star);
    if (is_exhausted()) return {&at, false};
    at.cell = at.star->cell(-u).value_or(0);
    const std::optional<Cell> ahead = at.star->cell(u);
    if (!is_at_p && ahead && at.star->is_reached(at.cell, *ahead)) continue;
    at.cell = cell_after_flight(at, u, is_at_p, ahead.has_value());
    return {&at, is_at_p};
  }
  return {};
}

Session::End Session::along_piece(const Way& way) {
  const At& g = *on_;
  const Face& f = *g.star->blocking(way.wall).face;
  const Direction w = g.star->up(way.wall);
  const std::int64_t share = share_of(way, g, p_);
  const Vector3<Whole> to_q = way_between(g.x, way.q);
  Direction along = Direction::of(to_q, about_way(to_q, g.x, way.q));
  along.in_plane = &f;
  Segment segment(g.x, g.star, along);
  segment.within(&f);
  const Time slip = segment.at_target(way.q, share);
  Time most = slip;
  bool is_strictly_inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = sign_inside(f, i, way.q);
    is_strictly_inside = is_strictly_inside && side > 0;
    if (side > 0) continue;
    // The distance from this side falls along the way, but if all of it is on the side's line.
    const Time t = segment.at_side(f, i);
    if (segment.compare(t, most) <= 0) most = t;
  }
  look_along(g.x, way.q, near_);
  if (share == kGrid && is_strictly_inside && g.star->kind() == Star::Kind::plane && !g.star->is_rough()) {
    segment.find_first(near_, most, true, times_);
    if (times_.empty()) {  // the same triangles hold q
      look_at(*on_->star);
      on_->x = way.q;
      on_->x.faces[0] = &f;
      on_->cell = on_->star->cell(way.wall);
      return {on_, true};
    }
  }
  if (is_stopped(segment, most, w, near_)) {
    std::swap(stop_, end_);
    return {end_, is_same(end_->x, p_)};
  }
  Point x = segment.point(most);
  if (most.kind == Time::Kind::target && share == kGrid) {
    x = way.q;
    x.faces[0] = &f;
  }
  make_end(*end_, x, near_, -along, w);
  return {end_, (share == kGrid && is_strictly_inside) || is_same(x, p_)};
}

Session::End Session::along_ray(const Way& way) {
  const At& g = *on_;
  const Star::Ray& ray = g.star->rays()[way.ray];
  const Direction along = ray.along;
  const Direction w = g.star->wedge(way.ray, way.wall).inner;
  const std::int64_t share = share_of(way, g, p_);
  Segment segment(g.x, g.star, along);
  if (ray.is_edge()) segment.within(along.line.names);
  const Time most = segment.at_foot(p_, share);
  look_along(g.x, way.q, near_);
  segment.find_first(near_, most, true, times_);
  const bool is_free = times_.empty();
  Point x = segment.point(is_free ? most : times_.front());
  if (is_free && share == kGrid) {
    const Point known = x;
    x = way.q;
    x.edge = known.edge;
  }
  make_end(*end_, x, near_, -along, w);
  return {end_, (share == kGrid && is_free) || is_same(x, p_)};
}

Tick Session::free(unsigned moves) {
  is_on_ = false;
  kept_.reset();
  state_ = {{PlaceKind::free, PlaceKind::nowhere, {}, hand_}, {}, false};
  return {Status::free, static_cast<std::uint16_t>(moves), {}, state_};
}

// Keeps the state.
Tick Session::unfinished(unsigned moves, bool is_slipping) {
  if (is_on_) return resting(moves, is_slipping, Status::unfinished);
  return {Status::unfinished, static_cast<std::uint16_t>(moves), {}, state_};
}

// r is where the state stays.
Tick Session::resting(unsigned moves, bool is_slipping, Status status) {
  const bool is_new = !kept_;
  if (is_new) kept_ = grid_place(*on_);
  state_ = {*kept_, on_->star->name(on_->cell), is_slipping};
  const Tick tick = ended(*on_, moves, is_slipping, is_same(on_->x, p_), status);
  if (is_new && on_->star->kind() == Star::Kind::line) go_to_place();
  return tick;
}

// Edges that lie on each other in part have other grids, and the state's place may be on another one than that which the last
// way was rounded on.
void Session::go_to_place() {
  const Point x = *point_of(*soup_, *kept_);
  if (is_same(x, on_->x)) return;
  const std::size_t looks = looks_;  // these count in no tick, as where the state comes from outside
  if (make_in_cell(*next_, x, state_.cell)) std::swap(on_, next_);
  looks_ = looks;
}

Tick Session::ended(const At& r, unsigned moves, bool is_slipping, bool is_at_goal, Status status) {
  Tick tick{status, static_cast<std::uint16_t>(moves), {}, {}};
  std::optional<Way> way;
  if (r.star->is_rough()) {
    const Vector3<Whole> u = way_between(r.x, p_);
    way = steepest(*soup_, r, p_, Direction::of(u, about_way(u, r.x, p_)));
    if (way && way->static_friction == 0) way.reset();
  }
  if (status != Status::unfinished &&
      ((is_at_goal && !r.star->is_rough()) || !way || is_within(*way, r, p_, way->dynamic_friction, 2)))
    is_slipping = false;
  state_.is_slipping = is_slipping;
  tick.force = force_at(*soup_, r, p_, way ? &way->q : nullptr, stiffness_, is_shaded_);
  if (soup_->has_damping()) tick.damping = damping_at(*soup_, r);
  tick.after = state_;
  return tick;
}

// r is an end where it rests; *on_ becomes where the state is.
Tick Session::resting_at_end(At& end, unsigned moves, bool is_slipping) {
  At* r = &end;
  if (is_same(r->x, p_)) r->x.take_numbers(p_);
  points_ = 0;
  // The force and the bit are those of r, before the state is rounded.
  const Tick tick = ended(*r, moves, is_slipping, true, Status::contact);
  Place place;
  switch (r->star->kind()) {
    case Star::Kind::point: place = point_place(*r->star); break;
    case Star::Kind::line: place = rest_on_line(r); break;
    case Star::Kind::plane: place = rest_in_plane(r); break;
  }
  if (r == end_) std::swap(on_, end_);
  if (r == next_) std::swap(on_, next_);
  is_on_ = true;
  state_ = {place, on_->star->name(on_->cell), state_.is_slipping};
  kept_ = place;
  Tick result = tick;
  result.after = state_;
  return result;
}

void Session::resume(const State& state) {
  state_ = {};
  is_on_ = false;
  kept_.reset();
  const std::uint64_t cuts = Whole::cuts;
  if (!in_domain(state.place.position)) return;
  const std::optional<Point> x = point_of(*soup_, state.place);
  if (!x) return;
  if (state.place.kind != PlaceKind::free) {
    if (!make_in_cell(*on_, *x, state.cell)) return;
    if (Whole::cuts != cuts) return;
    is_on_ = true;
    kept_ = state.place;
  }
  state_ = state;
}

Tick Session::tick(const std::array<float, 3>& position) {
  if (!in_domain(position)) return {Status::invalid, 0, {}, state_};
  hand_ = quantised(position);
  p_ = Point::of(hand_);
  looks_ = boxes_ = 0;
  const State before = state_;
  const std::uint64_t cuts = Whole::cuts;
  const Tick tick = run();
  if (Whole::cuts == cuts) [[likely]]
    return tick;
  resume(before);
  return {Status::unfinished, 0, {}, state_};
}

Tick Session::run() {
  bool is_slipping = state_.is_slipping;
  Point g = p_;
  if (state_.place.kind == PlaceKind::nowhere) {
    if (!make_on_surface(*on_, p_)) return free(0);
    if (is_exhausted()) return unfinished(0, false);
    on_->cell = on_->star->least_cell();
    if (!on_->star->is_rough()) {
      is_on_ = true;
      return resting_at_end(*on_, 0, false);
    }
    At* const first = rounded(on_);
    if (is_exhausted()) return unfinished(0, false);
    is_on_ = true;
    if (first == next_) std::swap(on_, next_);
    kept_ = rounded_place_;
  } else if (!is_on_) {
    g = Point::of(state_.place.position);
  }
  for (unsigned moves = 0;; ++moves) {
    if (is_on_) g = on_->x;
    if (is_same(g, p_)) return is_on_ ? resting(moves, is_slipping, Status::contact) : free(moves);
    std::optional<Way> way;
    bool flies = !is_on_;
    if (is_on_) {
      const Vector3<Whole> to_p = way_between(g, p_);
      const Direction u = Direction::of(to_p, about_way(to_p, g, p_));
      const std::optional<Cell> towards = on_->star->cell(u);
      flies = towards && on_->star->is_reached(on_->cell, *towards);
      if (!flies) {
        way = steepest(*soup_, *on_, p_, u);
        if (!way ||
            (on_->star->is_rough() && is_within(*way, *on_, p_, is_slipping ? way->dynamic_friction : way->static_friction)))
          return resting(moves, is_slipping, Status::contact);
      }
    }
    if (moves == kMostMoves || looks_ >= kMostLooks) return resting(moves, is_slipping, Status::unfinished);
    points_ = 0;
    const End end = flies ? flight(g) : way->is_along_ray() ? along_ray(*way) : along_piece(*way);
    if (is_exhausted()) return unfinished(moves, is_slipping);
    if (end.at == nullptr) return free(moves + 1);
    if (end.is_rest && !end.at->star->is_rough()) return resting_at_end(*end.at, moves + 1, is_slipping || !flies);
    At* const next = rounded(end.at);
    if (is_exhausted()) return unfinished(moves, is_slipping);
    if (is_on_ && !is_nearer(p_, next->x, g)) return resting(moves, is_slipping, Status::contact);
    is_slipping = is_slipping || !flies;
    if (next == end_)
      std::swap(on_, end_);
    else if (next == next_)
      std::swap(on_, next_);
    else if (next == stop_)
      std::swap(on_, stop_);
    is_on_ = true;
    kept_ = rounded_place_;
  }
}

}  // namespace forceshade::fast::soups
