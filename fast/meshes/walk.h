// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of the god-object: the descent of docs/meshes.md, rule by rule.

#include "forceshade/fast/meshes/flight.h"

namespace forceshade::fast {

// How the exact point r of a rest, which decides the force, follows from the state.
enum class Rest {
  none,         // free
  at_spot,      // r = g: the state itself
  in_triangle,  // r = the point of the triangle's plane nearest to p
  on_edge,      // r = the point of the edge's line nearest to p
  at_position,  // r = p
};

struct Arrival {
  Spot spot;
  Rest rest = Rest::none;
  std::uint16_t moves = 0;
  bool is_finished = true;
};

template <class Stages>
class Walk {
 public:
  static constexpr int kMostMoves = 256;

  // p: mm, in the domain and quantised.
  Walk(const Mesh& mesh, const std::array<float, 3>& p, const Stages& stages = {}) noexcept
      : mesh_(mesh), p_(p), stages_(stages), largest_(static_cast<double>(mesh.largest_coordinate())) {
    for (const float coordinate : p)
      if (std::fabs(coordinate) > largest_) largest_ = static_cast<double>(std::fabs(coordinate));
  }

  Arrival run(const Spot& from) noexcept {
    spot_ = from;
    if (spot_.place == mesh::Place::nowhere) return start();
    for (;;) {
      const Step step = move();
      if (step == Step::rest) return {spot_, rest_, static_cast<std::uint16_t>(moves_), true};
      if (step == Step::exhausted) return {spot_, Rest::at_spot, static_cast<std::uint16_t>(moves_), false};
    }
  }

 private:
  enum class Step { onward, rest, exhausted };

  Step rest(Rest how) noexcept {
    rest_ = how;
    return Step::rest;
  }
  Step rest(Rest how, const Spot& at) noexcept {
    spot_ = at;
    return rest(how);
  }
  Step onward(const Spot& to) noexcept {
    spot_ = to;
    return Step::onward;
  }

  Arrival start() noexcept {
    Hit hit;
    const Vector3<double> place{static_cast<double>(p_[0]), static_cast<double>(p_[1]), static_cast<double>(p_[2])};
    mesh_.tree().along(place, place, [&](std::uint32_t f) {
      if (side_of(mesh_.face(f), p_.data(), stages_) != 0) return;
      const Hit found = Flight<Stages>::part_at(mesh_, f, p_.data(), stages_);
      if (found.part != Hit::Part::none) hit = found;
    });
    if (hit.part == Hit::Part::none) return {free_spot(), Rest::none, 0, true};
    return {spot_at_position(hit), Rest::at_position, 0, true};
  }

  Spot free_spot() const noexcept { return {mesh::Place::free, mesh::Side::front, 0, {}, p_}; }

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
    std::uint32_t m = NearestParameters(foot.length).of(foot.along, stages_, [&] {
      const ExactFoot exact = exact_foot(h);
      return exact_nearest(exact.along, exact.length);
    });
    m = m < 1 ? 1 : m > kGrid - 1 ? kGrid - 1 : m;
    return spot_on_edge(mesh_, h, m, side);
  }
  Spot rest_in_triangle(std::uint32_t f, const Weights& weights, mesh::Side side) const noexcept {
    const NearestParameters parameters(weights.all);
    const auto parameter = [&](std::size_t corner) {
      const std::uint32_t nearest = parameters.of(weights.corner[corner], stages_, [&] {
        const ExactWeights exact(mesh_.face(f), p_.data());
        return exact_nearest(exact.corner[corner], exact.all);
      });
      return nearest < 1 ? 1 : nearest;
    };
    std::uint32_t k = parameter(1), l = parameter(2);
    if (k + l > kGrid - 1) {
      const std::uint32_t excess = k + l - (kGrid - 1);
      (k >= l ? k : l) -= excess;
    }
    return spot_in_triangle(mesh_, f, k, l, side);
  }

  // ---- Moves.

  Step move() noexcept {
    switch (spot_.place) {
      case mesh::Place::triangle: {
        const std::uint32_t f = face_of(spot_.half);
        const Face& face = mesh_.face(f);
        const FaceNumbers numbers(face);
        const Vector3<double> w = difference(p_.data(), face.corner[0].data());
        const int side = side_of(numbers, face, p_.data(), w, stages_);
        if (side == 0 && is_at_position()) return rest(Rest::at_spot);
        if (is_own(side > 0 ? Aim::front : side < 0 ? Aim::back : Aim::on)) return fly();
        return slide_in(f, Weights(numbers, w), side == 0);
      }
      case mesh::Place::edge: {
        // All that is decided beside an edge is the same from each of its points.
        const Point corner = Point::at(mesh_.start_point(spot_.half));
        const Vector3<double> w = difference(p_.data(), corner.corner[0]);
        const Direction direction{w, size_of(w), &corner, p_.data(), false};
        const Heading heading = Headings<Stages>(mesh_, direction, stages_).at_edge(spot_.half);
        if (heading.aim == Aim::on && heading.way.along == Slide::Along::edge && is_at_position()) return rest(Rest::at_spot);
        if (is_own(heading.aim)) return fly();
        return slide(heading);
      }
      case mesh::Place::vertex: {
        const Point corner = Point::at(mesh_.start_point(spot_.half));
        const Vector3<double> w = difference(p_.data(), corner.corner[0]);
        const Direction direction{w, size_of(w), &corner, p_.data(), false};
        if (direction.size == 0) return rest(Rest::at_spot);
        const Heading heading = Headings<Stages>(mesh_, direction, stages_).at_vertex(mesh_.start(spot_.half));
        if (is_own(heading.aim)) return fly();
        return slide(heading);
      }
      default:
        if (spot_.position == p_) return rest(Rest::none);
        return fly();
    }
  }

  // Whether the god-object may leave the surface that way.
  bool is_own(Aim aim) const noexcept {
    return aim == Aim::open || aim == (spot_.side == mesh::Side::front ? Aim::front : Aim::back);
  }

  bool is_at_position() const noexcept {
    const Point g = point_of(mesh_, spot_);
    const Offset U = offset_from(g, p_.data(), largest_);
    if (stages_.sure(U.size < HUGE_VAL)) return false;
    return is_zero(exact_offset_from(g, p_.data()));
  }

  Step slide(const Heading& heading) noexcept {
    if (heading.way.along == Slide::Along::nothing) return rest(Rest::at_spot);
    if (heading.way.along == Slide::Along::edge) return slide_along(heading.way);
    const std::uint32_t f = face_of(heading.way.half);
    const Face& face = mesh_.face(f);
    return slide_in(f, Weights(FaceNumbers(face), difference(p_.data(), face.corner[0].data())), heading.aim == Aim::on);
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
    if (moves_ == kMostMoves) return Step::exhausted;
    ++moves_;
    if (is_towards_start ? beyond(0) > 0 : beyond(kGrid) < 0) return rest(Rest::on_edge, rest_on_edge(h, spot_.side));
    const HalfEdge end = is_towards_start ? h : next(h);
    const Spot vertex = spot_at_vertex(mesh_, end, spot_.side);
    if (is_position(mesh_.start_point(end))) return rest(Rest::at_position, vertex);
    return onward(vertex);
  }
  ExactFoot exact_foot(HalfEdge h) const noexcept {
    return ExactFoot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
  }
  bool is_position(const float* point) const noexcept { return point[0] == p_[0] && point[1] == p_[1] && point[2] == p_[2]; }

  // From the spot, through the triangle, towards p's nearest point q of its plane. is_on: p lies in that plane.
  Step slide_in(std::uint32_t f, const Weights& weights, bool is_on) noexcept {
    std::array<int, 3> inside;
    for (std::size_t i = 0; i < 3; ++i)
      inside[i] = sign_of(weights.corner[i], stages_, [&] { return ExactWeights(mesh_.face(f), p_.data()).corner[i].sign(); });
    if (inside[0] > 0 && inside[1] > 0 && inside[2] > 0) {
      const Spot to = rest_in_triangle(f, weights, spot_.side);
      if (spot_.place == mesh::Place::triangle && to.weight == spot_.weight && is_nearest_already(f, weights))
        return rest(Rest::at_spot);
      if (moves_ == kMostMoves) return Step::exhausted;
      ++moves_;
      return rest(is_on ? Rest::at_position : Rest::in_triangle, to);
    }
    if (moves_ == kMostMoves) return Step::exhausted;
    ++moves_;
    // It leaves through the edge opposite to a corner whose weight falls to 0 on the way from G, the spot's, to q.
    const std::array<std::uint32_t, 3> G = weights_in(mesh_, spot_, f);
    const auto falls = [&](std::uint32_t i) { return inside[i] <= 0 && G[i] > 0; };
    std::uint32_t i = falls(0) ? 0 : falls(1) ? 1 : 2;
    // The weight of corner j where corner i's is 0, as num/den.
    const auto num = [&](std::uint32_t j) { return whole(G[i]) * weights.corner[j] - whole(G[j]) * weights.corner[i]; };
    const auto exact_num = [&](const ExactWeights& exact, std::uint32_t j) {
      return exact.corner[j] * integer(G[i]) - exact.corner[i] * integer(G[j]);
    };
    for (std::uint32_t j = i + 1; j < 3; ++j) {
      if (!falls(j)) continue;
      const int first = sign_of(num(j), stages_, [&] { return exact_num(ExactWeights(mesh_.face(f), p_.data()), j).sign(); });
      if (first == 0) {
        const HalfEdge corner = 3 * f + (3 - i - j);
        const Spot vertex = spot_at_vertex(mesh_, corner, spot_.side);
        if (is_position(mesh_.start_point(corner))) return rest(Rest::at_position, vertex);
        return onward(vertex);
      }
      if (first < 0) i = j;
    }
    const HalfEdge edge = 3 * f + after(i);
    if (is_on && inside[i] == 0) return rest(Rest::at_position, rest_on_edge(edge, spot_.side));
    const std::uint32_t j = before(i);  // the edge's end
    const Cell cell =
        cell_of(num(j), whole(G[i]) * weights.all - DoubleWithError::exactly(0x1p24) * weights.corner[i], stages_, [&] {
          const ExactWeights exact(mesh_.face(f), p_.data());
          return exact_cell(exact_num(exact, j), exact.all * integer(G[i]) - exact.corner[i].template shifted<24>());
        });
    return arrive(spot_on_edge(mesh_, edge, rounded_on_edge(edge, cell), spot_.side));
  }
  static DoubleWithError whole(std::uint32_t weight) noexcept { return DoubleWithError::exactly(static_cast<double>(weight)); }
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
  std::uint32_t rounded_on_edge(HalfEdge h, const Cell& cell) const noexcept {
    if (cell.is_whole) return cell.floor;
    const Foot foot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
    const int beyond = compare_with_halves(foot.along, foot.length, 2 * cell.floor + 1, stages_, [&] {
      const ExactFoot exact = exact_foot(h);
      return exact_compare_with_halves(exact.along, exact.length, 2 * cell.floor + 1);
    });
    const bool is_upper = beyond > 0 || (beyond == 0 && mesh_.start(h) > mesh_.start(next(h)));
    return cell.floor + (is_upper ? 1 : 0);
  }

  // At the rounded point, unless it is not nearer to p: then the move, counted already, is refused.
  Step arrive(const Spot& to) noexcept {
    const Point here = point_of(mesh_, spot_), there = point_of(mesh_, to);
    const auto length = [&](const Point& point) -> DoubleWithError {
      const Offset U = offset_from(point, p_.data(), largest_);
      return {square(U.U), kOffsetLength.error * U.size * U.size};
    };
    const int nearer = sign_of(length(here) - length(there), stages_, [&] {
      return square(exact_offset_from(here, p_.data())).compare(square(exact_offset_from(there, p_.data())));
    });
    if (nearer > 0) return onward(to);
    --moves_;
    return rest(Rest::at_spot);
  }

  [[gnu::noinline]] Step fly() noexcept {
    if (moves_ == kMostMoves) return Step::exhausted;
    ++moves_;
    const Point g = point_of(mesh_, spot_);
    double largest = largest_;
    if (spot_.place == mesh::Place::free)
      for (const float coordinate : spot_.position)
        if (std::fabs(coordinate) > largest) largest = static_cast<double>(std::fabs(coordinate));
    const Offset U = offset_from(g, p_.data(), largest);
    Flight<Stages> flight(mesh_, spot_, g, U, p_.data(), stages_);
    flight.run();
    const Hit& landing = flight.landing();
    if (landing.part == Hit::Part::none) {
      if (flight.end().part == Hit::Part::none) return rest(Rest::none, free_spot());
      return rest(Rest::at_position, spot_at_position(flight.end()));
    }
    const HalfEdge h = 3 * landing.face + landing.corner;
    const Spot to = landing.part == Hit::Part::corner ? spot_at_vertex(mesh_, h, landing.side)
                    : landing.part == Hit::Part::edge
                        ? spot_on_edge(mesh_, h, rounded_on_edge(h, flight.cell_on_edge()), landing.side)
                        : flight.rounded_in_triangle();
    return spot_.place == mesh::Place::free ? onward(to) : arrive(to);
  }

  const Mesh& mesh_;
  std::array<float, 3> p_;
  Stages stages_;
  double largest_;  // of p's coordinates and the mesh's
  Spot spot_;
  Rest rest_ = Rest::none;
  int moves_ = 0;
};

}  // namespace forceshade::fast
