// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/descent.h"

#include <utility>
#include <variant>

#include "reference/meshes/directions.h"

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;
using mesh::Side;
using mesh::Sides;

// The end of a flight or a slide.
struct Stopped {  // on the surface, not at rest
  SurfacePoint x;
  Side side;
  Fraction s = {};  // of a flight: where x is on it
};
struct Rested {  // at the point of the feature nearest to p
  Feature feature;
  Side side;
};
struct Freed {};  // at p
using End = std::variant<Stopped, Rested, Freed>;

constexpr std::size_t kMostLooks = 1U << 14;  // with these, no further move of the tick begins

Side side_of(DirectionKind way) {
  return way == DirectionKind::back ? Side::back : Side::front;
}

// In it p is the goal.
class Tick {
 public:
  Tick(const Ground& ground, const std::array<float, 3>& goal, const std::array<float, 3>& position)
      : surface_(ground.surface),
        crossings_(ground.crossings),
        sides_(ground.sides),
        materials_(ground.materials),
        p_(exact_point(goal)),
        hand_(exact_point(position)) {
    for (std::size_t axis = 0; axis < 3; ++axis) quantised_[axis] = p_[axis].is_zero() ? 0.0F : goal[axis];
  }

  Descended start(unsigned most_moves) {
    const auto point = crossings_.at(p_);
    if (!point) return is_free();
    const End end = unless_rough(Rested{point->feature, Side::front});
    if (const auto* rested = std::get_if<Rested>(&end)) return rests_at_foot(*rested);
    return from_surface(rounded_towards(surface_, std::get<Stopped>(end).x, p_), Side::front, most_moves);
  }

  Descended from_free(const std::array<float, 3>& position, unsigned most_moves) {
    const Vector g = exact_point(position);
    if (g == p_) return is_free();
    const End end = unless_rough(fly(g));
    if (std::holds_alternative<Freed>(end)) {
      ++moves_;
      return is_free();
    }
    ++moves_;
    if (const auto* rested = std::get_if<Rested>(&end)) return rests_at_foot(*rested);
    const auto& stopped = std::get<Stopped>(end);
    return from_surface(rounded_towards(surface_, stopped.x, p_), stopped.side, most_moves);
  }

  Descended from_surface(const mesh::GodObject& before, unsigned most_moves) {
    const std::size_t index =
        before.place == Place::edge ? surface_.edge_between(before.index[0], before.index[1]) : before.index[0];
    is_slipping_ = before.is_slipping && materials_.are_rough_somewhere();
    return from_surface({{before.place, index}, before.parameter}, before.side, most_moves);
  }

  Descended from_surface(GridPoint at, Side side, unsigned most_moves) {
    for (;;) {
      side = stored(side, at.feature);
      const Vector g = surface_.position(at);
      const Vector u = p_ - g;
      if (is_zero(u)) return rests_at(at, side, Status::contact);
      const Directions ways = directions(surface_, at.feature, u);
      if (at.feature.place == Place::vertex) looks_ += surface_.fan(at.feature.index).triangles.size();
      const bool is_flight = ways.way == DirectionKind::open || (ways.way != DirectionKind::on && side_of(ways.way) == side);
      if (!is_flight && (!ways.is_nearer || sticks(ways.along, u))) return rests_at(at, side, Status::contact);
      if (moves_ == most_moves || looks_ >= kMostLooks) return rests_at(at, side, Status::unfinished);
      const End end = unless_rough(is_flight ? fly(g) : slide(g, ways.along, side));
      if (std::holds_alternative<Freed>(end)) {
        ++moves_;
        return is_free();
      }
      if (const auto* rested = std::get_if<Rested>(&end)) {
        ++moves_;
        return rests_at_foot(*rested);
      }
      const auto& stopped = std::get<Stopped>(end);
      const GridPoint next = rounded_towards(surface_, stopped.x, p_);
      const Vector rest = p_ - surface_.position(next);
      if (dot(rest, rest) >= dot(u, u)) return rests_at(at, side, Status::contact);  // refused
      ++moves_;
      if (!is_flight) is_slipping_ = materials_.are_rough_somewhere();
      at = next;
      side = stopped.side;
    }
  }

 private:
  // Rule 1. What it has looked at counts only for the moves after it.
  End fly(const Vector& g) {
    const End end = flight(g);
    const auto* stopped = std::get_if<Stopped>(&end);
    looks_ += crossings_.looks(g, p_, stopped != nullptr ? stopped->s : Fraction{1, 1});
    return end;
  }
  End flight(const Vector& g) const {
    const Vector u = p_ - g;
    for (const Crossing& crossing : crossings_.between(g, p_)) {
      const Feature& feature = crossing.point.feature;
      if (is_blocked(feature, u)) return Stopped{crossing.point, side_of(directions(surface_, feature, -u).way), crossing.s};
    }
    if (const auto point = crossings_.at(p_))
      return Rested{point->feature, side_of(directions(surface_, point->feature, -u).way)};
    return Freed{};
  }

  // True if a flight in direction u may not go on at a point of the feature.
  bool is_blocked(const Feature& feature, const Vector& u) const {
    const DirectionKind A = directions(surface_, feature, -u).way, B = directions(surface_, feature, u).way;
    const bool leaves = sides_ == Sides::front && A == DirectionKind::back && B == DirectionKind::front;
    return B != DirectionKind::open && B != A && !leaves;
  }

  // Rule 2a, where u·v > 0: there the pull is not 0, and nothing but friction holds it.
  bool sticks(const Feature& along, const Vector& u) const {
    const mesh::Material its = materials_.of(along);
    const float mu = is_slipping_ ? its.dynamic_friction : its.static_friction;
    return mu > 0 && is_within(load_on(surface_, along, u), mu);
  }

  // Rules 2 and 2b.
  End slide(const Vector& g, const Feature& along, Side side) const {
    const float mu = materials_.of(along).dynamic_friction;
    const Integer of_way = mu > 0 ? share(load_on(surface_, along, p_ - g), mu) : Integer(kGrid);
    SurfacePoint x = foot(surface_, along, p_);
    if (of_way != kGrid) x = part_of_way(foot(surface_, along, g), x, of_way);
    if (is_inside(x)) return of_way == kGrid ? End(Rested{along, side}) : Stopped{x, side};
    return along.place == Place::edge ? slide_to_end(g, along.index, side) : slide_to_side(g, along.index, side);
  }

  End slide_to_end(const Vector& g, std::size_t index, Side side) const {
    const Edge& edge = surface_.edges()[index];
    const Feature end{Place::vertex, edge.vertices[dot(edge.along, p_ - g) > 0 ? 1 : 0]};
    if (surface_.vertices()[end.index] == p_) return Rested{end, side};
    return Stopped{{end, {}}, side};
  }

  // The end of the slide is outside or on the border: the way there meets a side first where g's height over that side, divided
  // by what a whole way would take from it, is least.
  End slide_to_side(const Vector& g, std::size_t index, Side side) const {
    const Triangle& triangle = surface_.triangles()[index];
    const Vector u = p_ - g;
    const auto corner = [&](std::size_t i) -> const Vector& { return surface_.vertices()[triangle.vertices[i]]; };
    std::optional<std::pair<Fraction, std::size_t>> first;
    for (std::size_t i = 0; i < 3; ++i) {
      const Integer loss = -dot(triangle.inward[i], u);
      if (loss <= 0) continue;
      Fraction s{dot(triangle.inward[i], g - corner(i)), loss};
      if (!first || s < first->first) first.emplace(std::move(s), i);
    }
    const auto& [s, i] = first.value();
    const Vector& e = triangle.sides[i];
    const SurfacePoint x =
        on_side(surface_, index, i, {dot(g - corner(i), e) * s.under + s.over * dot(u, e), s.under * dot(e, e)});
    if (s.over == s.under && dot(triangle.normal, u).is_zero()) return Rested{x.feature, side};
    return Stopped{x, side};
  }

  // Rule 2c.
  End unless_rough(const End& end) const {
    const auto* rested = std::get_if<Rested>(&end);
    if (rested == nullptr || !materials_.is_rough(rested->feature)) return end;
    return Stopped{foot(surface_, rested->feature, p_), rested->side};
  }

  Side stored(Side side, const Feature& feature) const {
    return sides_ == Sides::front || surface_.is_at_rim(feature) ? Side::front : side;
  }

  Descended is_free() const {
    mesh::GodObject after;
    after.place = Place::free;
    after.position = quantised_;
    return {Status::free, moves_, after, {}};
  }

  Descended rests_at(const GridPoint& at, Side side, Status status) {
    Rest rest{exactly(at), surface_.position(at) - hand_, 1, side};
    bool may_slip_on = false;  // rule 4a
    if (const auto along = rough_way(at)) {
      const Load load = load_on(surface_, *along, p_ - surface_.position(at));
      rest = {exactly(at), -load.pressure, load.under, side, -load.pull};
      may_slip_on = !is_within(load, materials_.of(*along).dynamic_friction, 2);
    }
    if (status != Status::unfinished) is_slipping_ = is_slipping_ && may_slip_on;
    return {status, moves_, state(at, side), std::move(rest)};
  }

  // That of v, where u·v > 0 and it is rough.
  std::optional<Feature> rough_way(const GridPoint& at) const {
    const Vector u = p_ - surface_.position(at);
    if (!materials_.are_rough_somewhere() || is_zero(u)) return std::nullopt;
    const Directions ways = directions(surface_, at.feature, u);
    return ways.is_nearer && materials_.is_rough(ways.along) ? std::optional(ways.along) : std::nullopt;
  }

  Descended rests_at_foot(const Rested& rested) {
    is_slipping_ = false;
    const Side side = stored(rested.side, rested.feature);
    Rest rest{foot(surface_, rested.feature, p_), {}, 1, side};
    const std::size_t index = rested.feature.index;
    if (rested.feature.place == Place::vertex) {
      rest.D_over = surface_.vertices()[index] - hand_;
    } else if (rested.feature.place == Place::edge) {
      const Edge& edge = surface_.edges()[index];
      rest.D_under = edge.length_squared;
      const Fraction& t = rest.r.parameter[0];
      rest.D_over = rest.D_under * (surface_.vertices()[edge.vertices[0]] - hand_) + t.over * edge.along;
    } else {
      const Triangle& triangle = surface_.triangles()[index];
      rest.D_under = triangle.normal_squared;
      rest.D_over =
          rest.D_under * (p_ - hand_) + dot(triangle.normal, surface_.vertices()[triangle.vertices[0]] - p_) * triangle.normal;
    }
    const mesh::GodObject after = state(rounded_inside(rest.r), side);
    return {Status::contact, moves_, after, std::move(rest)};
  }

  mesh::GodObject state(const GridPoint& at, Side side) const {
    mesh::GodObject after;
    after.place = at.feature.place;
    after.side = side;
    after.is_slipping = is_slipping_;
    after.parameter = at.parameter;
    if (at.feature.place == Place::edge)
      after.index = surface_.edges()[at.feature.index].vertices;
    else
      after.index[0] = static_cast<std::uint32_t>(at.feature.index);
    return after;
  }

  const Surface& surface_;
  const Crossings& crossings_;
  const Sides sides_;
  const SurfaceMaterials& materials_;
  const Vector p_, hand_;
  std::array<float, 3> quantised_{};
  unsigned moves_ = 0;
  std::size_t looks_ = 0;  // at triangles
  bool is_slipping_ = false;
};

}  // namespace

Descended descend(const Ground& ground, const mesh::GodObject& before, const std::array<float, 3>& goal,
                  const std::array<float, 3>& position, unsigned most_moves) {
  Tick tick(ground, goal, position);
  if (before.place == Place::nowhere) return tick.start(most_moves);
  if (before.place == Place::free) return tick.from_free(before.position, most_moves);
  return tick.from_surface(before, most_moves);
}

}  // namespace forceshade::reference::meshes
