// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Slides that friction may hold, and what a rest keeps of them: rules 2a, 2b and 4a of docs/friction.md.

#include <memory>
#include <optional>

#include "fast/meshes/looks.h"
#include "fast/meshes/quick_slips.h"

namespace forceshade::fast {

// The consequence of a move: another one, a rest, or the end of the tick's moves.
enum class Step { onward, rest, exhausted };

template <class Stages>
class Slips : protected Rests<Stages> {
 public:
  static constexpr int kMostMoves = 256, kMostLooks = 1 << 14;

 protected:
  // Moves `at`; all of it has to outlive this.
  FORCESHADE_INLINE Slips(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, const Stages& stages) noexcept
      : Rests<Stages>(mesh, at.grid_point, p, stages), at_(at) {}

  // The most moves of the tick. Once it has looked at so many triangles, these are the moves that it has made.
  FORCESHADE_INLINE int most_moves() const noexcept { return at_.looks < kMostLooks ? kMostMoves : at_.moves; }

  // The beginning of a flight, as far as it and the next moves depend on it.
  struct Beginning {
    GridPoint grid_point;
    int moves, looks;
    bool is_slipping;
  };
  FORCESHADE_INLINE Beginning beginning() const noexcept { return {grid_point_, at_.moves, at_.looks, at_.is_slipping}; }
  void begin_again(const Beginning& from) noexcept {
    grid_point_ = from.grid_point;
    at_.moves = from.moves;
    at_.looks = from.looks;
    at_.is_slipping = from.is_slipping;
    at_.pull = {};
    at_.to_hand = {};
  }

  // The position of p relative to a triangle.
  struct Facing {
    FaceNumbers numbers;
    Vector3<double> w;       // p less the first corner
    DoubleWithError across;  // n·w
    int side;                // its sign
    Weights weights;

    FORCESHADE_INLINE Facing(const Face& face, const float* p, const Stages& stages) noexcept
        : numbers(face),
          w(difference(p, face.corner[0].data())),
          across(across_of(numbers, w)),
          side(sign_of(across, stages, [&] { return exact_side_of(face, p); })),
          weights(numbers, w) {}
  };

  // On which side of the edge opposite to each corner p's nearest point of the plane is.
  FORCESHADE_INLINE std::array<int, 3> inside(std::uint32_t f, const Facing& facing) const noexcept {
    std::array<int, 3> inside;
    for (std::size_t i = 0; i < 3; ++i)
      inside[i] =
          sign_of(facing.weights.corner[i], stages_, [&] { return ExactWeights(mesh_.face(f), p_.data()).corner[i].sign(); });
    return inside;
  }

  // On which side of the edge h the foot of p lies: see Headings::inward().
  FORCESHADE_INLINE int inward(const Facing& facing, HalfEdge h) const noexcept {
    const std::uint32_t opposite = before(corner_of(h));
    return sign_of(facing.weights.corner[opposite], stages_,
                   [&] { return ExactWeights(mesh_.face(face_of(h)), p_.data()).corner[opposite].sign(); });
  }

  // In a rough triangle, as far as binary64 can decide it from the parameters: see QuickSlips.
  FORCESHADE_INLINE typename QuickSlips<Stages>::Outcome slip_quickly_in(std::uint32_t f, const Facing& facing,
                                                                         const Coefficients& of) noexcept {
    using Quick = QuickSlips<Stages>;
    if constexpr (!Stages::kFilter) return Quick::Outcome::unsure;
    const std::array<std::uint32_t, 2> from =
        grid_point_.place == mesh::Place::triangle ? grid_point_.weight : weights_of_last_two(f);
    Quick quick(facing.numbers, facing.across, facing.weights, of, stages_);
    const int before = at_.moves;
    const auto outcome = quick.run(from[0], from[1], at_.is_slipping, at_.moves, most_moves());
    if (at_.moves != before)
      put({mesh::Place::triangle,
           grid_point_.side,
           3 * f,
           {static_cast<std::uint32_t>(quick.k()), static_cast<std::uint32_t>(quick.l())},
           {}});
    if (outcome == Quick::Outcome::rests) {
      at_.to_hand = {quick.way_to_hand(), 1};
      at_.error_to_hand = quick.error_of_way();
      at_.rest = RestKind::at_grid_point;
      at_.pull = {Slide::Along::triangle, 3 * f, false};
    }
    return outcome;
  }
  // A slide in a rough triangle, or along a rough edge; none where it goes on to the border or to the end. In a triangle, all
  // that follow while the god-object stays in it. It looks at the triangle again, so that what does without it is shorter.
  [[gnu::noinline]] std::optional<Step> slip_in(std::uint32_t f, const Coefficients& of) noexcept {
    const Facing facing(mesh_.face(f), p_.data(), stages_);
    const std::array<int, 3> inside = this->inside(f, facing);
    for (;;) {
      const auto step =
          by_friction_in(f, facing.numbers, of, [&](const auto& friction) { return slip_by(friction, f, facing, inside); });
      if (!step || *step != Step::onward || grid_point_.place != mesh::Place::triangle) return step;
    }
  }
  std::optional<Step> slip_along(const Slide& way, const Foot& foot, bool is_towards_start, bool is_foot_inside,
                                 const Coefficients& of) noexcept {
    return by_friction_along(
        way.half, of, [&](const auto& friction) { return slip_by(friction, way, foot, is_towards_start, is_foot_inside); });
  }

  // A rest at the grid point that is not for friction's sake. way: the steepest, along which the hand pulls.
  Step stay(const Slide& way) noexcept {
    const Slide pull = rough(way);
    if (pull.along != Slide::Along::nothing) return held_at_grid_point(pull);
    at_.to_hand = {};
    return rest_at_grid_point({}, false);
  }
  Step exhausted(const Slide& way) noexcept {
    at_.pull = rough(way);
    at_.to_hand = {};
    return Step::exhausted;
  }

  // True if the triangle beyond the edge h is the steeper way: both lead inward.
  [[gnu::noinline]] bool is_second_nearer(HalfEdge h) const noexcept {
    const Point corner = Point::at(mesh_.start_point(h));
    const Vector3<double> w = difference(p_.data(), corner.corner[0]);
    const Direction direction{w, size_of(w), &corner, p_.data(), false};
    return Headings<Stages>(mesh_, direction, stages_)
        .is_better({Slide::Along::triangle, mesh_.twin(h), false}, {Slide::Along::triangle, h, false});
  }
  FORCESHADE_INLINE static DoubleWithError times(std::uint32_t weight, const DoubleWithError& a) noexcept {
    return fast::times(static_cast<double>(weight), a);
  }
  static FixedInteger<25> integer(std::uint32_t weight) noexcept { return FixedInteger<25>(static_cast<std::int64_t>(weight)); }
  // True if the god-object may leave the surface that way.
  bool is_own(DirectionKind kind) const noexcept {
    return kind == DirectionKind::open ||
           kind == (grid_point_.side == mesh::Side::front ? DirectionKind::front : DirectionKind::back);
  }
  // The steepest way from a touching grid point; nothing where the surface does not lead nearer.
  [[gnu::noinline]] Slide steepest() const noexcept {
    const HalfEdge h = grid_point_.half;
    if (grid_point_.place == mesh::Place::triangle) return {Slide::Along::triangle, h, false};
    const Point g = point_of(mesh_, grid_point_);
    const Offset U = offset_from(g, p_.data(), largest());
    const Direction direction{U.U, U.size, &g, p_.data(), false};
    const Headings<Stages> headings(mesh_, direction, stages_);
    if (grid_point_.place == mesh::Place::vertex) return headings.at_vertex(mesh_.start(h)).way;
    return headings.on_edge(h);
  }

 private:
  template <class Friction>
  FORCESHADE_INLINE std::optional<Step> slip_by(const Friction& friction, std::uint32_t f, const Facing& facing,
                                                const std::array<int, 3>& inside) noexcept {
    const Slide way{Slide::Along::triangle, 3 * f, false};
    if (friction.holds(at_.is_slipping)) return held(way, friction);
    if (at_.moves == most_moves()) return exhausted(way);
    const std::uint32_t left = friction.share_left();
    const Weights& weights = facing.weights;
    const std::array<std::uint32_t, 3> G = weights_in(mesh_, grid_point_, f);
    const auto exact_weight = [&](const ExactWeights& exact, std::size_t i) {
      return exact_weight_after(left, G[i], exact.corner[i], exact.all);
    };
    const GridParameters parameters(weights.all);
    std::array<Cell, 3> cells{};
    for (std::size_t i = 0; i < 3; ++i) {
      const DoubleWithError weight = weight_after(left, G[i], weights.corner[i], weights.all);
      if (inside[i] <= 0 &&
          sign_of(weight, stages_, [&] { return exact_weight(ExactWeights(mesh_.face(f), p_.data()), i).sign(); }) <= 0)
        return std::nullopt;
      cells[i] = parameters.cell(weight, stages_, [&] {
        const ExactWeights exact(mesh_.face(f), p_.data());
        return exact_cell(exact_weight(exact, i), exact.all.template shifted<48>());
      });
    }
    const double longest = 3 * (facing.numbers.s1 + facing.numbers.s2) * (facing.numbers.s1 + facing.numbers.s2);
    const bool is_nearer = friction.surely_brings_nearer(left, weights.all.value + weights.all.error, longest);
    return slipped(rounded_in_triangle(f, cells, grid_point_.side), is_nearer, way, friction);
  }
  template <class Friction>
  FORCESHADE_INLINE std::optional<Step> slip_by(const Friction& friction, const Slide& way, const Foot& foot,
                                                bool is_towards_start, bool is_foot_inside) noexcept {
    const HalfEdge h = way.half;
    if (friction.holds(at_.is_slipping)) return held(way, friction);
    if (at_.moves == most_moves()) return exhausted(way);
    const std::uint32_t left = friction.share_left();
    const std::uint32_t G = grid_point_.place == mesh::Place::edge ? grid_point_.weight[0] : is_towards_start ? kGrid : 0;
    const DoubleWithError along = weight_after(left, G, foot.along, foot.length);
    const auto exact_along = [&](const ExactFoot& exact) { return exact_weight_after(left, G, exact.along, exact.length); };
    if (!is_foot_inside) {
      const int ahead = sign_of(is_towards_start ? along : foot.length - along, stages_, [&] {
        const ExactFoot exact = exact_foot(h);
        const auto from_start = exact_along(exact);
        return is_towards_start ? from_start.sign() : exact.length.template shifted<48>().compare(from_start);
      });
      if (ahead <= 0) return std::nullopt;
    }
    const Cell cell = GridParameters(foot.length).cell(along, stages_, [&] {
      const ExactFoot exact = exact_foot(h);
      return exact_cell(exact_along(exact), exact.length.template shifted<48>());
    });
    const double length = foot.length.value + foot.length.error;
    return slipped(grid_point_on_edge(mesh_, h, rounded_on_edge(h, cell, foot), grid_point_.side),
                   friction.surely_brings_nearer(left, length, length), way, friction);
  }
  [[gnu::noinline]] std::array<std::uint32_t, 2> weights_of_last_two(std::uint32_t f) const noexcept {
    const std::array<std::uint32_t, 3> weights = weights_in(mesh_, grid_point_, f);
    return {weights[1], weights[2]};
  }
  FORCESHADE_INLINE Step rest_at_grid_point(const Slide& pull, bool is_slipping) noexcept {
    at_.rest = RestKind::at_grid_point;
    at_.pull = pull;
    at_.is_slipping = is_slipping;
    return Step::rest;
  }
  Slide rough(const Slide& way) const noexcept {
    const bool is_rough = way.along == Slide::Along::triangle
                              ? mesh_.friction_in_triangle(face_of(way.half)).is_rough()
                              : way.along == Slide::Along::edge && mesh_.friction_on_edge(way.half).is_rough();
    return is_rough ? way : Slide{};
  }
  [[gnu::noinline]] Step held_at_grid_point(const Slide& way) noexcept {
    const auto hold = [&](const auto& friction) { return held(way, friction); };
    if (way.along == Slide::Along::edge) return by_friction_along(way.half, mesh_.friction_on_edge(way.half), hold);
    const std::uint32_t f = face_of(way.half);
    return by_friction_in(f, FaceNumbers(mesh_.face(f)), mesh_.friction_in_triangle(f), hold);
  }
  // then(): gets what friction decides from the grid point, in the triangle or along the edge.
  template <class Then>
  FORCESHADE_INLINE auto by_friction_in(std::uint32_t f, const FaceNumbers& numbers, const Coefficients& of,
                                        const Then& then) noexcept {
    const Point g = point_of(mesh_, grid_point_);
    at_.to_hand = offset_from(g, p_.data(), largest());
    at_.error_to_hand = 0;
    const Load load = load_in_triangle(numbers, at_.to_hand);
    const auto exact = [&] { return exact_load_in_triangle(mesh_.face(f), exact_offset_from(g, p_.data())); };
    return then(Friction(load, of, stages_, exact));
  }
  template <class Then>
  FORCESHADE_INLINE auto by_friction_along(HalfEdge h, const Coefficients& of, const Then& then) noexcept {
    const float *const start = mesh_.start_point(h), *const end = mesh_.start_point(next(h));
    const Point g = point_of(mesh_, grid_point_);
    at_.to_hand = offset_from(g, p_.data(), largest());
    at_.error_to_hand = 0;
    const Load load = load_on_edge(difference(end, start), at_.to_hand);
    const auto exact = [&] { return exact_load_on_edge(exact_difference(end, start), exact_offset_from(g, p_.data())); };
    return then(Friction(load, of, stages_, exact));
  }
  template <class Friction>
  FORCESHADE_INLINE Step slipped(const GridPoint& to, bool is_surely_nearer, const Slide& way,
                                 const Friction& friction) noexcept {
    if (!is_surely_nearer && !is_nearer(to)) return held(way, friction);
    ++at_.moves;
    at_.is_slipping = true;
    put(to);
    return Step::onward;
  }
  template <class Friction>
  FORCESHADE_INLINE Step held(const Slide& way, const Friction& friction) noexcept {
    const bool slips_on = at_.is_slipping && friction.slips_on();
    return rest_at_grid_point(way, slips_on);
  }

 protected:
  using Rests<Stages>::mesh_, Rests<Stages>::grid_point_, Rests<Stages>::p_, Rests<Stages>::stages_;
  using Rests<Stages>::put, Rests<Stages>::is_nearer, Rests<Stages>::rounded_in_triangle, Rests<Stages>::rounded_on_edge,
      Rests<Stages>::exact_foot, Rests<Stages>::largest;

  // The looks of the tick after a flight from g.
  void count_looks(const Flight<Stages>& flight, const Point& g, const Beginning& before) noexcept {
    constexpr int kFewLooks = 512;  // counting them exactly would take longer than the flight
    const bool is_exact = counts_exactly_ || flight.looks() > kFewLooks;
    at_.looks += is_exact ? exact_looks(flight, mesh_, g, p_.data(), kMostLooks) : flight.looks();
    if (is_exact || has_doubt_) return;
    has_doubt_ = true;
    std::construct_at(&first_flight_, before);
  }
  void note_landing(std::uint32_t vertex, const Heading& onward) noexcept {
    landed_at_ = vertex;
    std::construct_at(&landed_, onward);
  }

  Arrival& at_;
  bool counts_exactly_ = false;    // the looks of every flight
  bool has_doubt_ = false;         // a flight's looks are not counted exactly
  std::uint32_t landed_at_ = ~0U;  // the vertex that the last flight landed at
  // Set only after a flight, since most ticks have none: how the first one began that leaves a doubt, and where p leads to from
  // the vertex landed at, each triangle of which that flight has looked at.
  union {
    Beginning first_flight_;
  };
  union {
    Heading landed_;
  };
};

}  // namespace forceshade::fast
