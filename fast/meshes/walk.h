// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of the god-object: the descent of docs/god-object.md, rule by rule.

#include "fast/meshes/glide.h"
#include "fast/meshes/slips.h"

namespace forceshade::fast {

// kHasFriction: whether slides may be held.
template <class Stages, bool kHasFriction = false>
class Walk : Slips<Stages> {
 public:
  // Moves `at`, from where its grid point is, towards p: the hand's position, or what a contact rule puts in its place. p: mm,
  // in the domain and quantised. Both have to outlive the walk.
  FORCESHADE_INLINE Walk(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, const Stages& stages = {}) noexcept
      : Slips<Stages>(mesh, at, p, stages) {}

  FORCESHADE_INLINE void run() noexcept {
    // A god-object that went through triangles in the last tick goes on through their neighbours, two or more of them.
    if (at_.moves > 1 && grid_point_.place == mesh::Place::triangle)
      for (const HalfEdge other : mesh_.face(face_of(grid_point_.half)).twin)
        if (other != kRim) mesh_.fetch_neighbours(face_of(other));
    at_.moves = 0;
    at_.looks = 0;
    at_.is_finished = true;
    if constexpr (kHasFriction) {
      at_.pull = {};
      at_.to_hand = {};
    }
    if (grid_point_.place == mesh::Place::nowhere && start() == Step::rest) return;
    Step step = move();
    if (step == Step::onward) step = go_on();
    if (step == Step::exhausted && at_.looks >= kMostLooks && fly_again() != Step::exhausted) return;
    if (step == Step::rest) return;
    at_.rest = grid_point_.place == mesh::Place::free ? RestKind::none : RestKind::at_grid_point;
    at_.is_finished = false;
  }

 private:
  using typename Slips<Stages>::Facing, typename Slips<Stages>::Beginning;
  using Slips<Stages>::at_, Slips<Stages>::kMostLooks, Slips<Stages>::most_moves, Slips<Stages>::inward, Slips<Stages>::times,
      Slips<Stages>::integer, Slips<Stages>::landed_, Slips<Stages>::landed_at_;
  using Slips<Stages>::beginning, Slips<Stages>::begin_again, Slips<Stages>::count_looks, Slips<Stages>::note_landing,
      Slips<Stages>::first_flight_, Slips<Stages>::has_doubt_, Slips<Stages>::counts_exactly_;
  using Slips<Stages>::slip_in, Slips<Stages>::slip_quickly_in, Slips<Stages>::slip_along, Slips<Stages>::stay,
      Slips<Stages>::exhausted, Slips<Stages>::steepest;
  using Slips<Stages>::is_second_nearer, Slips<Stages>::is_own;
  using Rests<Stages>::mesh_, Rests<Stages>::grid_point_, Rests<Stages>::p_, Rests<Stages>::stages_;
  using Rests<Stages>::put, Rests<Stages>::grid_point_at_position, Rests<Stages>::rest_on_edge, Rests<Stages>::rest_in_triangle;
  using Rests<Stages>::is_nearest_already, Rests<Stages>::rounded_on_edge, Rests<Stages>::is_nearer,
      Rests<Stages>::rounded_landing;
  using Rests<Stages>::is_at_position, Rests<Stages>::exact_foot, Rests<Stages>::is_position;
  using Rests<Stages>::rounded_in_triangle, Rests<Stages>::rounded_position;

  // Friction does not hold it there, so that it slips no more.
  FORCESHADE_INLINE Step rest(RestKind how) noexcept {
    if constexpr (kHasFriction) {
      at_.is_slipping = false;
      at_.to_hand = {};
    }
    at_.rest = how;
    return Step::rest;
  }
  FORCESHADE_INLINE Step rest(RestKind how, const GridPoint& at) noexcept {
    put(at);
    return rest(how);
  }
  FORCESHADE_INLINE Step onward(const GridPoint& to) noexcept {
    put(to);
    return Step::onward;
  }
  FORCESHADE_INLINE Step slid_onward(const GridPoint& to) noexcept {
    if constexpr (kHasFriction) at_.is_slipping = true;
    return onward(to);
  }
  FORCESHADE_INLINE Step be_free() noexcept {
    grid_point_.place = mesh::Place::free;
    grid_point_.side = mesh::Side::front;
    grid_point_.position = p_;
    return rest(RestKind::none);
  }

  [[gnu::noinline]] Step start() noexcept {
    Hit hit;
    const Vector3<double> place{static_cast<double>(p_[0]), static_cast<double>(p_[1]), static_cast<double>(p_[2])};
    mesh_.tree().along(place, place, [&](std::uint32_t f) {
      if (side_of(mesh_.face(f), p_.data(), stages_) != 0) return;
      const Hit found = Flight<Stages>::part_at(mesh_, f, p_.data(), stages_);
      if (found.part == Hit::Part::none) return;
      if (hit.part == Hit::Part::none) hit = found;
    });
    if (hit.part == Hit::Part::none) return be_free();
    if (is_rough(hit)) return onward(rounded_position(hit));
    return rest(RestKind::at_goal, grid_point_at_position(hit));
  }

  // ---- Moves.

  FORCESHADE_INLINE Step move_in_triangle() noexcept {
    const std::uint32_t f = face_of(grid_point_.half);
    const Facing facing(mesh_.face(f), p_.data(), stages_);
    const int side = facing.side;
    if (side == 0 && is_at_position()) return rest(RestKind::at_grid_point);
    if (is_own(side > 0 ? DirectionKind::front : side < 0 ? DirectionKind::back : DirectionKind::on)) return fly();
    return slide_in(f, facing);
  }

  // All that is decided beside an edge is the same from each of its points.
  FORCESHADE_INLINE Step move_on_edge() noexcept {
    const HalfEdge h = grid_point_.half, other = mesh_.twin(h);
    // The triangle that a slide has just left does not lead back.
    const bool is_left = left_.half == h && left_.beside.inward < 0;
    if (is_left && other != kRim) {
      const Facing second(mesh_.face(face_of(other)), p_.data(), stages_);
      return move_beside(h, left_.beside, {second.side, inward(second, other)}, second, second);
    }
    return move_on_any_edge(h, other);
  }
  [[gnu::noinline]] Step move_on_any_edge(HalfEdge h, HalfEdge other) noexcept {
    const Facing first(mesh_.face(face_of(h)), p_.data(), stages_);
    if (other == kRim) return move_beside(h, {first.side, inward(first, h)}, {0, -1}, first, first);
    const Facing second(mesh_.face(face_of(other)), p_.data(), stages_);
    return move_beside(h, {first.side, inward(first, h)}, {second.side, inward(second, other)}, first, second);
  }
  // facing_first, facing_second: of the triangles on either side of h; any, where that triangle is not led into.
  FORCESHADE_INLINE Step move_beside(HalfEdge h, const Beside& first, const Beside& second, const Facing& facing_first,
                                     const Facing& facing_second) noexcept {
    const DirectionKind kind = kind_beside(mesh_, h, first, second);
    const bool into_first = first.inward > 0, into_second = second.inward > 0;
    if (!into_first && !into_second) {
      if (kind == DirectionKind::on && is_at_position()) return rest(RestKind::at_grid_point);
      if (is_own(kind)) return fly();
      return slide_along({Slide::Along::edge, h, false});
    }
    if (is_own(kind)) return fly();
    const bool is_second = into_second && (!into_first || is_second_nearer(h));
    return is_second ? slide_in(face_of(mesh_.twin(h)), facing_second) : slide_in(face_of(h), facing_first);
  }
  // The moves after the first, which is apart from them: what the compiler prepares for a loop of moves would be a tenth of the
  // usual tick, that has one.
  [[gnu::noinline]] Step go_on() noexcept {
    Step step;
    do step = move();
    while (step == Step::onward);
    return step;
  }
  FORCESHADE_INLINE Step move() noexcept {
    switch (grid_point_.place) {
      case mesh::Place::triangle: return move_in_triangle();
      case mesh::Place::edge: return move_on_edge();
      case mesh::Place::vertex: return move_at_vertex();
      default:
        if (grid_point_.position == p_) return rest(RestKind::none);
        return fly();
    }
  }
  [[gnu::noinline]] Step move_at_vertex() noexcept {
    const Point corner = Point::at(mesh_.start_point(grid_point_.half));
    const Vector3<double> w = difference(p_.data(), corner.corner[0]);
    const Direction direction{w, size_of(w), &corner, p_.data(), false};
    if (direction.size == 0) return rest(RestKind::at_grid_point);
    const std::uint32_t vertex = mesh_.start(grid_point_.half);
    const Heading heading = landed_at_ == vertex ? landed_ : Headings<Stages>(mesh_, direction, stages_).at_vertex(vertex);
    at_.looks += heading.triangles;
    if (is_own(heading.kind)) return fly();
    if (heading.way.along == Slide::Along::nothing) return rest(RestKind::at_grid_point);
    if (heading.way.along == Slide::Along::edge) return slide_along(heading.way);
    const std::uint32_t f = face_of(heading.way.half);
    return slide_in(f, Facing(mesh_.face(f), p_.data(), stages_));
  }

  // True if a move that ends there is no rest. At a vertex it makes no difference: that is a point of the grid.
  FORCESHADE_INLINE bool is_rough(HalfEdge h) const noexcept {
    if constexpr (kHasFriction) return mesh_.friction_on_edge(h).is_rough();
    return false;
  }
  FORCESHADE_INLINE bool is_rough(const Hit& hit) const noexcept {
    if constexpr (kHasFriction) {
      if (hit.part == Hit::Part::triangle) return mesh_.friction_in_triangle(hit.face).is_rough();
      return hit.part == Hit::Part::edge && is_rough(3 * hit.face + hit.corner);
    }
    return false;
  }

  // From the grid point towards p's nearest point q of the edge's line.
  Step slide_along(const Slide& way) noexcept {
    const HalfEdge h = way.half;
    const Foot foot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
    const auto beyond = [&](std::uint32_t weight) {
      return compare_with_halves(foot.along, foot.length, 2 * weight, stages_, [&] {
        const ExactFoot exact = exact_foot(h);
        return exact_compare_with_halves(exact.along, exact.length, 2 * weight);
      });
    };
    bool is_towards_start = way.is_reversed;
    if (grid_point_.place == mesh::Place::edge) {
      const int onward = beyond(grid_point_.weight[0]);
      if (onward == 0) return rest(RestKind::at_grid_point);
      is_towards_start = onward < 0;
    }
    const bool is_foot_inside = is_towards_start ? beyond(0) > 0 : beyond(kGrid) < 0;
    if constexpr (kHasFriction)
      if (const Coefficients of = mesh_.friction_on_edge(h); of.is_rough())
        if (const auto step = slip_along(way, foot, is_towards_start, is_foot_inside, of)) return *step;
    if (at_.moves == most_moves()) return Step::exhausted;
    ++at_.moves;
    if (is_foot_inside) return rest(RestKind::on_edge, rest_on_edge(h, grid_point_.side));
    const HalfEdge end = is_towards_start ? h : next(h);
    const GridPoint vertex = grid_point_at_vertex(mesh_, end, grid_point_.side);
    if (is_position(mesh_.start_point(end))) return rest(RestKind::at_goal, vertex);
    return slid_onward(vertex);
  }
  // From the grid point, through the triangle, towards p's nearest point q of its plane.
  FORCESHADE_INLINE Step slide_in(std::uint32_t f, const Facing& facing) noexcept {
    const Weights& weights = facing.weights;
    if (grid_point_.place != mesh::Place::triangle) mesh_.fetch_neighbours(f);
    if constexpr (kHasFriction)
      if (const Coefficients of = mesh_.friction_in_triangle(f); of.is_rough()) {
        using Outcome = typename QuickSlips<Stages>::Outcome;
        const Outcome outcome = slip_quickly_in(f, facing, of);
        if (outcome == Outcome::rests) return Step::rest;
        if (outcome == Outcome::unsure)
          if (const auto step = slip_in(f, of)) return *step;
      }
    const std::array<int, 3> inside = this->inside(f, facing);
    if (inside[0] <= 0 || inside[1] <= 0 || inside[2] <= 0) return slide_out(f, facing, inside);
    const GridPoint to = rest_in_triangle(f, weights, grid_point_.side);
    if (grid_point_.place == mesh::Place::triangle && to.weight[0] == grid_point_.weight[0] &&
        to.weight[1] == grid_point_.weight[1] && is_nearest_already(f, weights))
      return rest(RestKind::at_grid_point);
    if (at_.moves == most_moves()) return Step::exhausted;
    ++at_.moves;
    at_.plane = {facing.numbers.n, dot(facing.numbers.n, facing.w), weights.all.value, facing.numbers.area, size_of(facing.w)};
    return rest(facing.side == 0 ? RestKind::at_goal : RestKind::in_triangle, to);
  }
  // The same where q is not strictly inside.
  FORCESHADE_INLINE Step slide_out(std::uint32_t f, const Facing& facing, const std::array<int, 3>& inside) noexcept {
    const Weights& weights = facing.weights;
    if (at_.moves == most_moves()) return Step::exhausted;
    ++at_.moves;
    // It leaves through the edge opposite to a corner whose weight falls to 0 on the way from G, the grid point's, to q.
    const std::array<std::uint32_t, 3> G = weights_in(mesh_, grid_point_, f);
    const auto falls = [&](std::uint32_t i) { return inside[i] <= 0 && G[i] > 0; };
    std::uint32_t i = falls(0) ? 0 : falls(1) ? 1 : 2;
    // The weight of corner j where corner i's is 0, as num/den.
    const auto num = [&](std::uint32_t j)
                         FORCESHADE_INLINE_BODY { return times(G[i], weights.corner[j]) - times(G[j], weights.corner[i]); };
    const auto exact_num = [&](const ExactWeights& exact, std::uint32_t j) {
      return exact.corner[j] * integer(G[i]) - exact.corner[i] * integer(G[j]);
    };
    for (std::uint32_t j = i + 1; j < 3; ++j) {
      if (!falls(j)) continue;
      const int first = sign_of(num(j), stages_, [&] { return exact_num(ExactWeights(mesh_.face(f), p_.data()), j).sign(); });
      if (first == 0) {
        const HalfEdge corner = 3 * f + (3 - i - j);
        const GridPoint vertex = grid_point_at_vertex(mesh_, corner, grid_point_.side);
        if (is_position(mesh_.start_point(corner))) return rest(RestKind::at_goal, vertex);
        return slid_onward(vertex);
      }
      if (first < 0) i = j;
    }
    const HalfEdge edge = 3 * f + after(i);
    if (facing.side == 0 && inside[i] == 0 && !is_rough(edge))
      return rest(RestKind::at_goal, rest_on_edge(edge, grid_point_.side));
    const std::uint32_t j = before(i);  // the edge's end
    const DoubleWithError along = num(j), whole = times(G[i], weights.all) - shifted<24>(weights.corner[i]);
    if constexpr (!kHasFriction)  // whose slides have to be tested one by one
      if (inside[i] < 0 && facing.side == (grid_point_.side == mesh::Side::front ? -1 : 1) && at_.moves >= glide_from_ &&
          glide<Stages>(*this, at_, edge, along, whole, static_cast<double>(G[i]), weights.all, most_moves(), glide_from_))
        return Step::rest;
    const Cell cell = GridParameters(whole).cell(along, stages_, [&] {
      const ExactWeights exact(mesh_.face(f), p_.data());
      return exact_cell(exact_num(exact, j), exact.all * integer(G[i]) - exact.corner[i].template shifted<24>());
    });
    const Foot foot(mesh_.start_point(edge), mesh_.start_point(next(edge)), p_.data());
    left_ = {edge, {facing.side, inside[i]}};
    const GridPoint to = grid_point_on_edge(mesh_, edge, rounded_on_edge(edge, cell, foot), grid_point_.side);
    if (stages_.sure(is_surely_nearer(static_cast<double>(G[i]), weights.all.value - weights.all.error,
                                      foot.length.value + foot.length.error)) ||
        is_nearer(to))
      return slid_onward(to);
    return refuse({Slide::Along::triangle, 3 * f, false});
  }
  // A rest at the grid point instead of a move, which is counted already. way: the steepest.
  Step refuse(const Slide& way) noexcept {
    --at_.moves;
    if constexpr (kHasFriction) return stay(way);
    return rest(RestKind::at_grid_point);
  }
  Step refuse_flight() noexcept { return refuse(kHasFriction ? steepest() : Slide{}); }
  [[gnu::noinline]] Step fly() noexcept {
    if (at_.moves == most_moves()) {
      if constexpr (kHasFriction)
        if (is_touching(grid_point_)) return exhausted(steepest());
      return Step::exhausted;
    }
    const Beginning before = beginning();
    ++at_.moves;
    const Point g = point_of(mesh_, grid_point_);
    double largest = this->largest();
    if (grid_point_.place == mesh::Place::free)
      for (const float coordinate : grid_point_.position)
        if (std::fabs(coordinate) > largest) largest = static_cast<double>(std::fabs(coordinate));
    const Offset U = offset_from(g, p_.data(), largest);
    Flight<Stages> flight(mesh_, grid_point_, g, U, p_.data(), stages_);
    flight.run();
    const Hit& landing = flight.landing();
    count_looks(flight, g, before);
    if (landing.part == Hit::Part::none) {
      if (flight.end().part == Hit::Part::none) return be_free();
      if (is_rough(flight.end())) return arrive(rounded_position(flight.end()));
      return rest(RestKind::at_goal, grid_point_at_position(flight.end()));
    }
    const HalfEdge h = 3 * landing.face + landing.corner;
    if (landing.part == Hit::Part::corner) note_landing(mesh_.start(h), flight.onward());
    const GridPoint to = landing.part == Hit::Part::corner ? grid_point_at_vertex(mesh_, h, landing.side)
                         : landing.part == Hit::Part::edge ? rounded_landing(h, flight.cell_on_edge(), landing.side)
                                                           : rounded_in_triangle(landing.face, flight.cells(), landing.side);
    return arrive(to);
  }
  // The moves from the first flight on whose looks are not counted exactly: they may be more than those of the definition, so
  // that it is not known yet that the tick is to end.
  [[gnu::noinline]] Step fly_again() noexcept {
    if (!has_doubt_ || counts_exactly_) return Step::exhausted;
    counts_exactly_ = true;
    begin_again(first_flight_);
    const Step step = fly();
    return step == Step::onward ? go_on() : step;
  }
  FORCESHADE_INLINE Step arrive(const GridPoint& to) noexcept {
    if (grid_point_.place != mesh::Place::free && !is_nearer(to)) return refuse_flight();
    return onward(to);
  }
  // The edge that the last slide went out through, and how p lies to the triangle that it left: that depends on p alone.
  struct {
    HalfEdge half = kRim;
    Beside beside{};
  } left_;
  int glide_from_ = 0;  // with fewer moves, a glide would meet the same doubt again
};

}  // namespace forceshade::fast
