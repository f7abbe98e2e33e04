// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds where a god-object comes to rest, and rounds it to a state: rules 3 and 4 of docs/god-object.md.

#include <array>
#include <cmath>
#include <cstdint>

#include "fast/meshes/flight.h"

namespace forceshade::fast {

// The way in which the exact point r of a rest, which decides the force, follows from the state and from p, the goal of the
// walk.
enum class RestKind {
  none,           // free
  at_grid_point,  // r = g: the state itself
  in_triangle,    // r = the point of the triangle's plane nearest to p
  on_edge,        // r = the point of the edge's line nearest to p
  at_goal,        // r = p
};

struct Arrival {
  GridPoint grid_point;
  RestKind rest = RestKind::none;
  int moves = 0;
  bool is_finished = true;
  Plane plane{};  // of the rest's triangle: in_triangle alone
  // By the contact rule friction alone: mesh::GodObject's; and the rough way along which the hand pulls at a rest at the
  // grid point.
  bool is_slipping = false;
  Slide pull{};
  Offset to_hand{};          // 2^24(p - g) there, where it is at hand
  double error_to_hand = 0;  // of a component of it; 0 where it is from offset_from()
  int looks = 0;             // triangles that the tick has looked at: those of docs/god-object.md, or more
};

// Between what a god-object remembers and the file's numbering. A state is one of the contact rule.
inline Arrival arrival_of(const Mesh& mesh, const mesh::GodObject& state, mesh::Contact contact) noexcept {
  Arrival at;
  at.grid_point = grid_point_of(mesh, state);
  at.is_slipping = state.is_slipping && contact == mesh::Contact::friction && is_touching(at.grid_point);
  return at;
}
inline mesh::GodObject object_of(const Mesh& mesh, const Arrival& at) noexcept {
  mesh::GodObject state = object_of(mesh, at.grid_point);
  state.is_slipping = at.is_slipping;
  return state;
}

// The points that the state can hold, as they lie to p.
template <class Stages>
class Rests {
 public:
  // p: mm, in the domain and quantised. Both have to outlive this.
  FORCESHADE_INLINE Rests(const Mesh& mesh, GridPoint& grid_point, const std::array<float, 3>& p, const Stages& stages) noexcept
      : mesh_(mesh), grid_point_(grid_point), p_(p), stages_(stages) {}

  // Makes this the state, but for the position of a free one. One member at a time: a load that spans several recent stores
  // waits for them.
  FORCESHADE_INLINE void put(const GridPoint& to) const noexcept {
    grid_point_.place = to.place;
    grid_point_.side = to.side;
    grid_point_.half = to.half;
    grid_point_.weight[0] = to.weight[0];
    grid_point_.weight[1] = to.weight[1];
  }

  // p, which lies on the surface at the hit, with its parameters rounded.
  GridPoint grid_point_at_position(const Hit& hit) const noexcept {
    const HalfEdge h = 3 * hit.face + hit.corner;
    if (hit.part == Hit::Part::corner) return grid_point_at_vertex(mesh_, h, hit.side);
    if (hit.part == Hit::Part::edge) return rest_on_edge(h, hit.side);
    const Face& f = mesh_.face(hit.face);
    return rest_in_triangle(hit.face, Weights(FaceNumbers(f), difference(p_.data(), f.corner[0].data())), hit.side);
  }

  // ---- Rule 4: what the state keeps of a rest.

  GridPoint rest_on_edge(HalfEdge h, mesh::Side side) const noexcept {
    const Foot foot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
    std::uint32_t m = GridParameters(foot.length).nearest(foot.along, stages_, [&] {
      const ExactFoot exact = exact_foot(h);
      return exact_nearest(exact.along, exact.length);
    });
    m = m < 1 ? 1 : m > kGrid - 1 ? kGrid - 1 : m;
    return grid_point_on_edge(mesh_, h, m, side);
  }
  FORCESHADE_INLINE std::uint32_t rested(std::uint32_t f, const GridParameters& parameters, const Weights& weights,
                                         std::size_t corner) const noexcept {
    const std::uint32_t nearest = parameters.nearest(weights.corner[corner], stages_, [&] {
      const ExactWeights exact(mesh_.face(f), p_.data());
      return exact_nearest(exact.corner[corner], exact.all);
    });
    return nearest < 1 ? 1 : nearest;
  }
  FORCESHADE_INLINE GridPoint rest_in_triangle(std::uint32_t f, const Weights& weights, mesh::Side side) const noexcept {
    const GridParameters parameters(weights.all);
    std::uint32_t k = rested(f, parameters, weights, 1), l = rested(f, parameters, weights, 2);
    if (k + l > kGrid - 1) {
      const std::uint32_t excess = k + l - (kGrid - 1);
      (k >= l ? k : l) -= excess;
    }
    return {mesh::Place::triangle, side, 3 * f, {k, l}, {}};
  }

  // True if the grid point, whose parameters are those of q rounded, is q.
  FORCESHADE_INLINE bool is_nearest_already(std::uint32_t f, const Weights& weights) const noexcept {
    for (std::size_t i = 0; i < 2; ++i) {
      const int sign = compare_with_halves(weights.corner[i + 1], weights.all, 2 * grid_point_.weight[i], stages_, [&] {
        const ExactWeights exact(mesh_.face(f), p_.data());
        return exact_compare_with_halves(exact.corner[i + 1], exact.all, 2 * grid_point_.weight[i]);
      });
      if (sign != 0) return false;
    }
    return true;
  }

  // ---- Rule 3: the end of a move, rounded to the grid.

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

  // True if the rounded point is nearer to p.
  [[gnu::noinline]] bool is_nearer(const GridPoint& to) const noexcept {
    const Point here = point_of(mesh_, grid_point_), there = point_of(mesh_, to);
    const auto length = [&](const Point& point) -> DoubleWithError {
      const Offset U = offset_from(point, p_.data(), largest());
      return {square(U.U), kOffsetLength.error * U.size * U.size};
    };
    return sign_of(length(here) - length(there), stages_, [&] {
             return square(exact_offset_from(here, p_.data())).compare(square(exact_offset_from(there, p_.data())));
           }) > 0;
  }
  GridPoint rounded_landing(HalfEdge h, const Cell& cell, mesh::Side side) const noexcept {
    const Foot foot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
    return grid_point_on_edge(mesh_, h, rounded_on_edge(h, cell, foot), side);
  }

  // The point of a triangle with these cells: the corner of its part of the grid that is nearest to p.
  FORCESHADE_INLINE GridPoint rounded_in_triangle(std::uint32_t f, const std::array<Cell, 3>& cells,
                                                  mesh::Side side) const noexcept {
    const std::uint32_t k = cells[1].floor, l = cells[2].floor;
    std::array<GridCorner, 3> corners{};  // in the order in which equally near ones count
    std::size_t count = 0;
    const auto add = [&](std::uint32_t up, std::uint32_t across) { corners[count++] = {k + up, l + across}; };
    if (cells[1].is_whole && cells[2].is_whole) {
      add(0, 0);
    } else if (cells[0].is_whole) {
      add(0, 1);
      add(1, 0);
    } else if (cells[1].is_whole) {
      add(0, 0);
      add(0, 1);
    } else if (cells[2].is_whole) {
      add(0, 0);
      add(1, 0);
    } else if (cells[0].floor + k + l == kGrid - 1) {
      add(0, 0);
      add(0, 1);
      add(1, 0);
    } else {
      add(0, 1);
      add(1, 0);
      add(1, 1);
    }
    const GridCorner nearest = nearest_corner(mesh_.face(f), corners, count);
    return grid_point_in_triangle(mesh_, f, nearest.k, nearest.l, side);
  }

  // p, which lies on the surface at the hit, as the end of a move that is no rest.
  [[gnu::noinline]] GridPoint rounded_position(const Hit& hit) const noexcept {
    stages_.note(Stage::wide);
    const HalfEdge h = 3 * hit.face + hit.corner;
    if (hit.part == Hit::Part::corner) return grid_point_at_vertex(mesh_, h, hit.side);
    if (hit.part == Hit::Part::edge) {
      const ExactFoot foot = exact_foot(h);
      return rounded_landing(h, exact_cell(foot.along, foot.length), hit.side);
    }
    const ExactWeights weights(mesh_.face(hit.face), p_.data());
    std::array<Cell, 3> cells{};
    for (std::size_t i = 0; i < 3; ++i) cells[i] = exact_cell(weights.corner[i], weights.all);
    return rounded_in_triangle(hit.face, cells, hit.side);
  }

  // ---- How p lies to the state.

  bool is_at_position() const noexcept {
    const Point g = point_of(mesh_, grid_point_);
    const Offset U = offset_from(g, p_.data(), largest());
    if (stages_.sure(U.size < HUGE_VAL)) return false;
    stages_.note(Stage::wide);
    return is_zero(exact_offset_from(g, p_.data()));
  }

  ExactFoot exact_foot(HalfEdge h) const noexcept {
    return ExactFoot(mesh_.start_point(h), mesh_.start_point(next(h)), p_.data());
  }
  bool is_position(const float* point) const noexcept { return is_same_point(point, p_.data()); }

  // The largest coordinate of p and of the mesh, in size; mm.
  double largest() const noexcept {
    float largest = mesh_.largest_coordinate();
    for (const float coordinate : p_)
      if (std::fabs(coordinate) > largest) largest = std::fabs(coordinate);
    return static_cast<double>(largest);
  }

 private:
  struct GridCorner {
    std::uint32_t k, l;
  };
  // The first of those that are nearest to p. With U = 2^24(p - a), a being the last corner, and d the way from a to another
  // one in units of the grid, that one's squared distance is larger than a's by 2^-48 (d² - 2 d·U).
  FORCESHADE_INLINE GridCorner nearest_corner(const Face& f, const std::array<GridCorner, 3>& corners,
                                              std::size_t count) const noexcept {
    const auto point = [&](const GridCorner& c) -> Point {
      return {{f.corner[0].data(), f.corner[1].data(), f.corner[2].data()}, {kGrid - c.k - c.l, c.k, c.l}, 3};
    };
    const Point last = point(corners[count - 1]);
    const Offset U = offset_from(last, p_.data(), largest());
    const auto excess = [&](std::size_t i) -> DoubleWithError {
      if (i == count - 1) return {};
      // A step of the grid is along a side: to the corner whose weight it raises, from the one whose weight it lowers.
      const Point to = point(corners[i]);
      std::size_t up = 0, down = 0;
      for (std::size_t c = 1; c < 3; ++c) {
        if (to.weight[c] > last.weight[c]) up = c;
        if (to.weight[c] < last.weight[c]) down = c;
      }
      const Vector3<double> d = difference(f.corner[up].data(), f.corner[down].data());
      const double size = size_of(d);
      const DoubleWithError along{dot(d, U.U), kAlong.error * size * U.size}, length{dot(d, d), kLength.error * size * size};
      return length - shifted<1>(along);
    };
    std::size_t nearest = 0;
    DoubleWithError least = excess(0);
    for (std::size_t i = 1; i < count; ++i) {
      const DoubleWithError other = excess(i);
      const int sign = sign_of(other - least, stages_, [&] {
        const Point a = point(corners[i]), b = point(corners[nearest]);
        return square(exact_offset_from(a, p_.data())).compare(square(exact_offset_from(b, p_.data())));
      });
      if (sign >= 0) continue;
      nearest = i;
      least = other;
    }
    return corners[nearest];
  }

 public:
  const Mesh& mesh_;
  GridPoint& grid_point_;
  const std::array<float, 3>& p_;
  Stages stages_;
};

}  // namespace forceshade::fast
