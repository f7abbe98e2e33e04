// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of the god-object: the descent of docs/god-object.md, rule by rule.

#include <optional>

#include "fast/meshes/sheets.h"

namespace forceshade::fast {

// How the exact point r of a rest, which decides the force, follows from the state and from p, the goal of the walk.
enum class Rest {
  none,         // free
  at_spot,      // r = g: the state itself
  in_triangle,  // r = the point of the triangle's plane nearest to p
  on_edge,      // r = the point of the edge's line nearest to p
  at_goal,      // r = p
};

struct Arrival {
  Spot spot;
  Rest rest = Rest::none;
  int moves = 0;
  bool is_finished = true;
  Plane plane{};  // of the rest's triangle: in_triangle alone
  int tries = 0;  // that the tick's detours and landings have taken: where sheets may cross
};

// kHasSheets: whether ways are tested against the whole mesh, whose sheets may cross.
template <class Stages, bool kHasSheets = false>
class Walk {
 public:
  static constexpr int kMostMoves = 256;
  static constexpr int kMostTries = 256;  // with these, no further detour or landing of the tick begins

  // Moves `at`, from where its spot is, towards p: the hand's position, or what a contact rule puts in its place. p: mm, in
  // the domain and quantised. Both have to outlive the walk.
  FORCESHADE_INLINE Walk(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, const Stages& stages = {}) noexcept
      : mesh_(mesh), at_(at), spot_(at.spot), p_(p), stages_(stages) {}

  FORCESHADE_INLINE void run() noexcept {
    // A god-object that went through triangles in the last tick goes on through their neighbours, two or more of them.
    if (at_.moves > 1 && spot_.place == mesh::Place::triangle)
      for (const HalfEdge other : mesh_.face(face_of(spot_.half)).twin)
        if (other != kRim) mesh_.fetch_neighbours(face_of(other));
    at_.moves = 0;
    if constexpr (kHasSheets) at_.tries = 0;
    at_.is_finished = true;
    if (spot_.place == mesh::Place::nowhere) return start();
    Step step;
    do step = spot_.place == mesh::Place::triangle ? move_in_triangle() : move();
    while (step == Step::onward);
    if (step == Step::rest) return;
    at_.rest = spot_.place == mesh::Place::free ? Rest::none : Rest::at_spot;
    at_.is_finished = false;
  }

 private:
  enum class Step { onward, rest, exhausted };

  FORCESHADE_INLINE Step rest(Rest how) noexcept {
    at_.rest = how;
    return Step::rest;
  }
  FORCESHADE_INLINE Step rest(Rest how, const Spot& at) noexcept {
    put(at);
    return rest(how);
  }
  FORCESHADE_INLINE Step onward(const Spot& to) noexcept {
    put(to);
    return Step::onward;
  }
  // The same after a slide in the triangle f, or along an edge of it.
  FORCESHADE_INLINE Step slid(Rest how, const Spot& at, std::uint32_t f) noexcept {
    if constexpr (kHasSheets)
      if (const auto other = diverted(at, f)) return *other;
    return rest(how, at);
  }
  FORCESHADE_INLINE Step slid_onward(const Spot& to, std::uint32_t f) noexcept {
    if constexpr (kHasSheets)
      if (const auto other = diverted(to, f)) return *other;
    return onward(to);
  }
  // Where another sheet is in the way; none where it is clear. The move is counted already.
  [[gnu::noinline]] std::optional<Step> diverted(const Spot& to, std::uint32_t f) noexcept {
    const Sheets<Stages> sheets(mesh_, p_.data(), stages_);
    const auto block = sheets.block(spot_, to, f);
    if (!block) return std::nullopt;
    return arrive_instead([&](Tries& tries) { return sheets.detour(spot_, to, f, *block, tries); });
  }
  // find(tries): a point to go to instead.
  template <class Find>
  Step arrive_instead(const Find& find) noexcept {
    if (at_.tries < kMostTries) {
      Tries tries;
      const std::optional<Spot> other = find(tries);
      at_.tries += tries.taken();
      if (other) return onward(*other);
      --at_.moves;
      return spot_.place == mesh::Place::free ? Step::exhausted : rest(Rest::at_spot);
    }
    --at_.moves;
    return Step::exhausted;
  }
  // One member at a time: a load that spans several recent stores waits for them.
  FORCESHADE_INLINE void put(const Spot& to) noexcept {
    spot_.place = to.place;
    spot_.side = to.side;
    spot_.half = to.half;
    spot_.weight[0] = to.weight[0];
    spot_.weight[1] = to.weight[1];
  }
  FORCESHADE_INLINE Step be_free() noexcept {
    spot_.place = mesh::Place::free;
    spot_.side = mesh::Side::front;
    spot_.position = p_;
    return rest(Rest::none);
  }

  [[gnu::noinline]] void start() noexcept {
    Hit hit;  // the first of the features that are there
    const Vector3<double> place{static_cast<double>(p_[0]), static_cast<double>(p_[1]), static_cast<double>(p_[2])};
    mesh_.tree().along(place, place, [&](std::uint32_t f) {
      if (side_of(mesh_.face(f), p_.data(), stages_) != 0) return;
      const Hit found = Flight<Stages>::part_at(mesh_, f, p_.data(), stages_);
      if (found.part == Hit::Part::none) return;
      if (hit.part == Hit::Part::none || key_of(mesh_, found) < key_of(mesh_, hit)) hit = found;
    });
    if (hit.part == Hit::Part::none)
      be_free();
    else
      rest(Rest::at_goal, spot_at_position(hit));
  }

  // p, which lies on the surface at the hit, with its parameters rounded.
  Spot spot_at_position(const Hit& hit) const noexcept {
    const HalfEdge h = 3 * hit.face + hit.corner;
    if (hit.part == Hit::Part::corner) return spot_at_vertex(mesh_, h, hit.side);
    if (hit.part == Hit::Part::edge) return rest_on_edge(h, hit.side);
    const Face& f = mesh_.face(hit.face);
    return rest_in_triangle(hit.face, Weights(FaceNumbers(f), difference(p_.data(), f.corner[0].data())), hit.side);
  }

  // ---- Rule 4: what the state keeps of a rest.

  Spot rest_on_edge(HalfEdge h, mesh::Side side) const noexcept {
    const Foot foot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
    std::uint32_t m = GridParameters(foot.length).nearest(foot.along, stages_, [&] {
      const ExactFoot exact = exact_foot(h);
      return exact_nearest(exact.along, exact.length);
    });
    m = m < 1 ? 1 : m > kGrid - 1 ? kGrid - 1 : m;
    return spot_on_edge(mesh_, h, m, side);
  }
  FORCESHADE_INLINE std::uint32_t rested(std::uint32_t f, const GridParameters& parameters, const Weights& weights,
                                         std::size_t corner) const noexcept {
    const std::uint32_t nearest = parameters.nearest(weights.corner[corner], stages_, [&] {
      const ExactWeights exact(mesh_.face(f), p_.data());
      return exact_nearest(exact.corner[corner], exact.all);
    });
    return nearest < 1 ? 1 : nearest;
  }
  FORCESHADE_INLINE Spot rest_in_triangle(std::uint32_t f, const Weights& weights, mesh::Side side) const noexcept {
    const GridParameters parameters(weights.all);
    std::uint32_t k = rested(f, parameters, weights, 1), l = rested(f, parameters, weights, 2);
    if (k + l > kGrid - 1) {
      const std::uint32_t excess = k + l - (kGrid - 1);
      (k >= l ? k : l) -= excess;
    }
    return {mesh::Place::triangle, side, 3 * f, {k, l}, {}};
  }

  // ---- Moves.

  // How p lies to a triangle.
  struct Facing {
    FaceNumbers numbers;
    Vector3<double> w;  // p less the first corner
    int side;           // of n·w
    Weights weights;

    FORCESHADE_INLINE Facing(const Face& face, const float* p, const Stages& stages) noexcept
        : numbers(face),
          w(difference(p, face.corner[0].data())),
          side(side_of(numbers, face, p, w, stages)),
          weights(numbers, w) {}
  };
  // On which side of the edge h the foot of p lies: see Headings::inward().
  FORCESHADE_INLINE int inward(const Facing& facing, HalfEdge h) const noexcept {
    const std::uint32_t opposite = before(corner_of(h));
    return sign_of(facing.weights.corner[opposite], stages_,
                   [&] { return ExactWeights(mesh_.face(face_of(h)), p_.data()).corner[opposite].sign(); });
  }

  FORCESHADE_INLINE Step move_in_triangle() noexcept {
    const std::uint32_t f = face_of(spot_.half);
    const Facing facing(mesh_.face(f), p_.data(), stages_);
    const int side = facing.side;
    if (side == 0 && is_at_position()) return rest(Rest::at_spot);
    if (is_own(side > 0 ? Aim::front : side < 0 ? Aim::back : Aim::on)) return fly();
    return slide_in(f, facing);
  }

  // All that is decided beside an edge is the same from each of its points.
  FORCESHADE_INLINE Step move_on_edge() noexcept {
    const HalfEdge h = spot_.half, other = mesh_.twin(h);
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
    const Aim aim = aim_beside(mesh_, h, first, second);
    const bool into_first = first.inward > 0, into_second = second.inward > 0;
    if (!into_first && !into_second) {
      if (aim == Aim::on && is_at_position()) return rest(Rest::at_spot);
      if (is_own(aim)) return fly();
      return slide_along({Slide::Along::edge, h, false});
    }
    if (is_own(aim)) return fly();
    const bool is_second = into_second && (!into_first || is_second_nearer(h));
    return is_second ? slide_in(face_of(mesh_.twin(h)), facing_second) : slide_in(face_of(h), facing_first);
  }
  // Whether the triangle beyond the edge h is the steeper way: both lead inward.
  [[gnu::noinline]] bool is_second_nearer(HalfEdge h) const noexcept {
    const Point corner = Point::at(mesh_.start_point(h));
    const Vector3<double> w = difference(p_.data(), corner.corner[0]);
    const Direction direction{w, size_of(w), &corner, p_.data(), false};
    return Headings<Stages>(mesh_, direction, stages_)
        .is_better({Slide::Along::triangle, mesh_.twin(h), false}, {Slide::Along::triangle, h, false});
  }

  FORCESHADE_INLINE Step move() noexcept {
    switch (spot_.place) {
      case mesh::Place::edge: return move_on_edge();
      case mesh::Place::vertex: return move_at_vertex();
      default:
        if (spot_.position == p_) return rest(Rest::none);
        return fly();
    }
  }
  [[gnu::noinline]] Step move_at_vertex() noexcept {
    const Point corner = Point::at(mesh_.start_point(spot_.half));
    const Vector3<double> w = difference(p_.data(), corner.corner[0]);
    const Direction direction{w, size_of(w), &corner, p_.data(), false};
    if (direction.size == 0) return rest(Rest::at_spot);
    const Heading heading = Headings<Stages>(mesh_, direction, stages_).at_vertex(mesh_.start(spot_.half));
    if (is_own(heading.aim)) return fly();
    if (heading.way.along == Slide::Along::nothing) return rest(Rest::at_spot);
    if (heading.way.along == Slide::Along::edge) return slide_along(heading.way);
    const std::uint32_t f = face_of(heading.way.half);
    return slide_in(f, Facing(mesh_.face(f), p_.data(), stages_));
  }

  // Whether the god-object may leave the surface that way.
  bool is_own(Aim aim) const noexcept {
    return aim == Aim::open || aim == (spot_.side == mesh::Side::front ? Aim::front : Aim::back);
  }

  bool is_at_position() const noexcept {
    const Point g = point_of(mesh_, spot_);
    const Offset U = offset_from(g, p_.data(), largest());
    if (stages_.sure(U.size < HUGE_VAL)) return false;
    stages_.note(Stage::wide);
    return is_zero(exact_offset_from(g, p_.data()));
  }

  // From the spot towards p's nearest point q of the edge's line.
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
    if (spot_.place == mesh::Place::edge) {
      const int onward = beyond(spot_.weight[0]);
      if (onward == 0) return rest(Rest::at_spot);
      is_towards_start = onward < 0;
    }
    if (at_.moves == kMostMoves) return Step::exhausted;
    ++at_.moves;
    if (is_towards_start ? beyond(0) > 0 : beyond(kGrid) < 0)
      return slid(Rest::on_edge, rest_on_edge(h, spot_.side), first_beside(h));
    const HalfEdge end = is_towards_start ? h : next(h);
    const Spot vertex = spot_at_vertex(mesh_, end, spot_.side);
    if (is_position(mesh_.start_point(end))) return slid(Rest::at_goal, vertex, first_beside(h));
    return slid_onward(vertex, first_beside(h));
  }
  // The triangle beside the edge that comes first in the file.
  std::uint32_t first_beside(HalfEdge h) const noexcept {
    const std::uint32_t f = face_of(h), other = mesh_.twin(h) == kRim ? f : face_of(mesh_.twin(h));
    return mesh_.face(other).index() < mesh_.face(f).index() ? other : f;
  }
  ExactFoot exact_foot(HalfEdge h) const noexcept {
    return ExactFoot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
  }
  bool is_position(const float* point) const noexcept { return point[0] == p_[0] && point[1] == p_[1] && point[2] == p_[2]; }

  // From the spot, through the triangle, towards p's nearest point q of its plane.
  FORCESHADE_INLINE Step slide_in(std::uint32_t f, const Facing& facing) noexcept {
    const Weights& weights = facing.weights;
    if (spot_.place != mesh::Place::triangle) mesh_.fetch_neighbours(f);
    std::array<int, 3> inside;
    for (std::size_t i = 0; i < 3; ++i)
      inside[i] = sign_of(weights.corner[i], stages_, [&] { return ExactWeights(mesh_.face(f), p_.data()).corner[i].sign(); });
    if (inside[0] <= 0 || inside[1] <= 0 || inside[2] <= 0) return slide_out(f, facing, inside);
    const Spot to = rest_in_triangle(f, weights, spot_.side);
    if (spot_.place == mesh::Place::triangle && to.weight[0] == spot_.weight[0] && to.weight[1] == spot_.weight[1] &&
        is_nearest_already(f, weights))
      return rest(Rest::at_spot);
    if (at_.moves == kMostMoves) return Step::exhausted;
    ++at_.moves;
    at_.plane = {facing.numbers.n, dot(facing.numbers.n, facing.w), weights.all.value, facing.numbers.area, size_of(facing.w)};
    return slid(facing.side == 0 ? Rest::at_goal : Rest::in_triangle, to, f);
  }
  // The same where q is not strictly inside.
  FORCESHADE_INLINE Step slide_out(std::uint32_t f, const Facing& facing, const std::array<int, 3>& inside) noexcept {
    const Weights& weights = facing.weights;
    if (at_.moves == kMostMoves) return Step::exhausted;
    ++at_.moves;
    // It leaves through the edge opposite to a corner whose weight falls to 0 on the way from G, the spot's, to q.
    const std::array<std::uint32_t, 3> G = weights_in(mesh_, spot_, f);
    const auto falls = [&](std::uint32_t i) { return inside[i] <= 0 && G[i] > 0; };
    std::uint32_t i = falls(0) ? 0 : falls(1) ? 1 : 2;
    // The weight of corner j where corner i's is 0, as num/den.
    const auto num = [&](std::uint32_t j) { return times(G[i], weights.corner[j]) - times(G[j], weights.corner[i]); };
    const auto exact_num = [&](const ExactWeights& exact, std::uint32_t j) {
      return exact.corner[j] * integer(G[i]) - exact.corner[i] * integer(G[j]);
    };
    for (std::uint32_t j = i + 1; j < 3; ++j) {
      if (!falls(j)) continue;
      const int first = sign_of(num(j), stages_, [&] { return exact_num(ExactWeights(mesh_.face(f), p_.data()), j).sign(); });
      if (first == 0) {
        const HalfEdge corner = 3 * f + (3 - i - j);
        const Spot vertex = spot_at_vertex(mesh_, corner, spot_.side);
        if (is_position(mesh_.start_point(corner))) return slid(Rest::at_goal, vertex, f);
        return slid_onward(vertex, f);
      }
      if (first < 0) i = j;
    }
    const HalfEdge edge = 3 * f + after(i);
    if (facing.side == 0 && inside[i] == 0) return slid(Rest::at_goal, rest_on_edge(edge, spot_.side), f);
    const std::uint32_t j = before(i);  // the edge's end
    const DoubleWithError along = num(j), whole = times(G[i], weights.all) - shifted<24>(weights.corner[i]);
    if constexpr (!kHasSheets)  // whose slides have to be tested one by one
      if (inside[i] < 0 && facing.side == (spot_.side == mesh::Side::front ? -1 : 1) && at_.moves >= glide_from_ &&
          glide(edge, along, whole, static_cast<double>(G[i]), weights.all))
        return Step::rest;
    const Cell cell = GridParameters(whole).cell(along, stages_, [&] {
      const ExactWeights exact(mesh_.face(f), p_.data());
      return exact_cell(exact_num(exact, j), exact.all * integer(G[i]) - exact.corner[i].template shifted<24>());
    });
    const Foot foot(mesh_.start_point(edge), mesh_.start_point(next(edge)), p_.data());
    left_ = {edge, {facing.side, inside[i]}};
    const Spot to = spot_on_edge(mesh_, edge, rounded_on_edge(edge, cell, foot), spot_.side);
    if (stages_.sure(is_surely_nearer(static_cast<double>(G[i]), weights.all.value - weights.all.error,
                                      foot.length.value + foot.length.error)) ||
        is_nearer(to))
      return slid_onward(to, f);
    return refuse();
  }
  // The slides that follow one which leaves its triangle over the edge h, until one rests inside a triangle, and that rest. So
  // are the moves of most ticks on fine meshes. Nothing but the rest stays of them, so their ends are not rounded: it suffices
  // where on its edge each rounded end is, about. False, and nothing is done, where binary64 does not prove each of the
  // decisions: that p is behind the triangle, so that no edge leads away from the surface; through which edge the slide leaves
  // it, not at a vertex; and that its rounded end is nearer to p. num/den: where it crosses h; weight, n_n: as in
  // is_surely_nearer().
  //
  // S and E are the ends of the edge, O the corner beyond it. With u the weight at the start of the corner whose weight falls
  // to 0, that of O is then u·at_O/(u·all - falling), which grows with u. So the ends of an interval for u give those of one
  // for it. To each is added a step of the grid for the rounding, and one for all errors, which are less than 2^-24: those of
  // den and of num are below 2^-26 den together, or each of the three numbers has one below 2^-28 den.
  [[gnu::noinline]] bool glide(HalfEdge h, const DoubleWithError& num, const DoubleWithError& den, double weight,
                               const DoubleWithError& n_n) noexcept {
    const auto point = [](const float* at) {
      return Vector3<double>{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    };
    const Vector3<double> p = point(p_.data());
    Vector3<double> S = point(mesh_.start_point(h)), E = point(mesh_.start_point(next(h))), e = E - S, w = p - S;
    double size_e = size_of(e), low = num.value / den.value - kTwoSteps, high = num.value / den.value + kTwoSteps;
    bool is_sure =
        den.value > 0x1p26 * (num.error + den.error) && is_surely_nearer(weight, n_n.value - n_n.error, 3 * size_e * size_e);
    int moves = at_.moves;
    const auto is_going_on = [&] { return stages_.sure(is_sure && low > 0 && high < 1) && moves < kMostMoves; };
    for (HalfEdge other = mesh_.twin(h); other != kRim && is_going_on(); ++moves) {
      const std::uint32_t f = face_of(other), c = corner_of(other);  // the edge from E to S
      const Face& face = mesh_.face(f);
      const HalfEdge over_O_E = face.twin[before(c)], over_S_O = face.twin[after(c)];
      mesh_.fetch_beyond(over_O_E);
      mesh_.fetch_beyond(over_S_O);
      const Vector3<double> O = point(face.corner[before(c)].data()), o = O - S, n = cross(o, e);
      const double size_o = size_of(o), size_w = size_of(w), area = size_e * size_o, across = dot(n, w);
      const double outward = spot_.side == mesh::Side::front ? across : -across;
      if (!stages_.sure(outward < -kAcross.error * area * size_w)) break;
      const double at_O = dot(cross(w, e), n), at_E = dot(cross(o, w), n), all = dot(n, n),
                   at_S = third_weight(all, at_E, at_O);
      const double error = kThird.error * area * (size_w * (size_e + size_o) + area);
      if (!stages_.sure(at_O > error)) break;
      if (stages_.sure(at_S > error && at_E > error)) {
        Weights weights;
        weights.corner[c] = {at_E, error};
        weights.corner[after(c)] = {at_S, error};
        weights.corner[before(c)] = {at_O, error};
        weights.all = {all, error};
        at_.moves = moves + 1;
        at_.plane = {n, across, all, area, size_w};
        rest(Rest::in_triangle, rest_in_triangle(f, weights, spot_.side));
        return true;
      }
      bool is_over_O_E = at_S < 0;  // out over the edge from O to E; else over that from S to O
      if (stages_.sure(at_S < -error && at_E < -error)) {
        // Both fall to 0: this is positive where S's does so first, and grows along the edge.
        is_over_O_E = (1 - low) * at_E - low * at_S > 2 * error;
        if (!stages_.sure(is_over_O_E || (1 - high) * at_E - high * at_S < -2 * error)) break;
      } else if (!stages_.sure(is_over_O_E ? at_S < -error && at_E > error : at_E < -error && at_S > error)) {
        break;
      }
      const double falling = is_over_O_E ? at_S : at_E;
      const double least = is_over_O_E ? 1 - high : low, most = is_over_O_E ? 1 - low : high;
      const double den_low = least * all - falling, den_high = most * all - falling;
      const double x_low = least * at_O / den_low - kTwoSteps, x_high = most * at_O / den_high + kTwoSteps;
      if (is_over_O_E) {
        other = over_O_E;
        low = 1 - x_high;
        high = 1 - x_low;
        S = O;
        e = E - S;
        w = p - S;
        size_e = size_of(e);
      } else {
        other = over_S_O;
        low = x_low;
        high = x_high;
        E = O;
        e = o;
        size_e = size_o;
      }
      is_sure = den_low > 0x1p28 * error && is_surely_nearer(0x1p24 * least, all - error, 3 * size_e * size_e);
    }
    glide_from_ = moves + 1;
    return false;
  }
  // Whether a slide to an edge ends nearer to p by more than the rounding takes away. weight: of the corner opposite to the
  // edge, at the slide's start; n_n, e_e: the squares of the triangle's normal and of the edge. The slide's length d is at
  // least the start's distance from the edge, weight/2^24·|n|/|e|. It brings the square of the distance to p down by d² at
  // least, and the rounding up by (|e|/2^24)²/4 at most (docs/speed.md, "Why a tick on a mesh is fast").
  FORCESHADE_INLINE static bool is_surely_nearer(double weight, double n_n, double e_e) noexcept {
    return 4 * weight * weight * n_n > (1 + 0x1p-40) * (e_e * e_e);
  }
  FORCESHADE_INLINE static DoubleWithError times(std::uint32_t weight, const DoubleWithError& a) noexcept {
    return fast::times(static_cast<double>(weight), a);
  }
  static FixedInteger<25> integer(std::uint32_t weight) noexcept { return FixedInteger<25>(static_cast<std::int64_t>(weight)); }

  // Whether the spot, whose parameters are those of q rounded, is q.
  bool is_nearest_already(std::uint32_t f, const Weights& weights) const noexcept {
    for (std::size_t i = 0; i < 2; ++i) {
      const int sign = compare_with_halves(weights.corner[i + 1], weights.all, 2 * spot_.weight[i], stages_, [&] {
        const ExactWeights exact(mesh_.face(f), p_.data());
        return exact_compare_with_halves(exact.corner[i + 1], exact.all, 2 * spot_.weight[i]);
      });
      if (sign != 0) return false;
    }
    return true;
  }

  // ---- Rule 3.

  // The end of the cell that is nearer to p; equally near: the one nearer to the edge's lower vertex.
  FORCESHADE_INLINE std::uint32_t rounded_on_edge(HalfEdge h, const Cell& cell, const Foot& foot) const noexcept {
    if (cell.is_whole) return cell.floor;
    const int beyond = compare_with_halves(foot.along, foot.length, 2 * cell.floor + 1, stages_, [&] {
      const ExactFoot exact = exact_foot(h);
      return exact_compare_with_halves(exact.along, exact.length, 2 * cell.floor + 1);
    });
    const bool is_upper = beyond > 0 || (beyond == 0 && mesh_.start(h) > mesh_.start(next(h)));
    return cell.floor + (is_upper ? 1 : 0);
  }

  // Whether the rounded point is nearer to p.
  [[gnu::noinline]] bool is_nearer(const Spot& to) const noexcept {
    const Point here = point_of(mesh_, spot_), there = point_of(mesh_, to);
    const auto length = [&](const Point& point) -> DoubleWithError {
      const Offset U = offset_from(point, p_.data(), largest());
      return {square(U.U), kOffsetLength.error * U.size * U.size};
    };
    return sign_of(length(here) - length(there), stages_, [&] {
             return square(exact_offset_from(here, p_.data())).compare(square(exact_offset_from(there, p_.data())));
           }) > 0;
  }
  // The move is counted already.
  Step refuse() noexcept {
    --at_.moves;
    return rest(Rest::at_spot);
  }

  [[gnu::noinline]] Step fly() noexcept {
    if (at_.moves == kMostMoves) return Step::exhausted;
    ++at_.moves;
    const Point g = point_of(mesh_, spot_);
    double largest = this->largest();
    if (spot_.place == mesh::Place::free)
      for (const float coordinate : spot_.position)
        if (std::fabs(coordinate) > largest) largest = static_cast<double>(std::fabs(coordinate));
    const Offset U = offset_from(g, p_.data(), largest);
    Flight<Stages> flight(mesh_, spot_, g, U, p_.data(), stages_);
    flight.run();
    const Hit& landing = flight.landing();
    if (landing.part == Hit::Part::none) {
      if (flight.end().part == Hit::Part::none) return be_free();
      const Spot to = spot_at_position(flight.end());
      if constexpr (kHasSheets) {
        const Sheets<Stages> sheets(mesh_, p_.data(), stages_);
        if (!sheets.is_apart(g, flight.end(), {}, FixedInteger<304>(1), to))
          return arrive_instead([&](Tries& tries) {
            return sheets.landing(g, spot_if_touching(), sheets.bases(flight.end(), flight.cells_at_end()), tries);
          });
      }
      return rest(Rest::at_goal, to);
    }
    const HalfEdge h = 3 * landing.face + landing.corner;
    const Spot to = landing.part == Hit::Part::corner ? spot_at_vertex(mesh_, h, landing.side)
                    : landing.part == Hit::Part::edge ? rounded_landing(h, flight.cell_on_edge(), landing.side)
                                                      : flight.rounded_in_triangle();
    if (spot_.place != mesh::Place::free && !is_nearer(to)) return refuse();
    if constexpr (kHasSheets) {
      const Sheets<Stages> sheets(mesh_, p_.data(), stages_);
      const auto left = flight.left_at_landing();
      if (!sheets.is_apart(g, landing, left.num, left.den, to))
        return arrive_instead(
            [&](Tries& tries) { return sheets.landing(g, spot_if_touching(), sheets.bases(landing, flight.cells()), tries); });
    }
    return onward(to);
  }
  const Spot* spot_if_touching() const noexcept { return spot_.place == mesh::Place::free ? nullptr : &spot_; }
  Spot rounded_landing(HalfEdge h, const Cell& cell, mesh::Side side) const noexcept {
    const Foot foot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
    return spot_on_edge(mesh_, h, rounded_on_edge(h, cell, foot), side);
  }

  // Of p's coordinates and the mesh's.
  double largest() const noexcept {
    float largest = mesh_.largest_coordinate();
    for (const float coordinate : p_)
      if (std::fabs(coordinate) > largest) largest = std::fabs(coordinate);
    return static_cast<double>(largest);
  }

  const Mesh& mesh_;
  Arrival& at_;
  Spot& spot_;
  const std::array<float, 3>& p_;
  Stages stages_;
  // The edge that the last slide went out through, and how p lies to the triangle that it left: that depends on p alone.
  struct {
    HalfEdge half = kRim;
    Beside beside{};
  } left_;
  int glide_from_ = 0;  // with fewer moves, a glide would meet the same doubt again
  static constexpr double kTwoSteps = 0x1p-23;
};

}  // namespace forceshade::fast
