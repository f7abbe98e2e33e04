// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of the force at a rest: the way from the hand's position p to r, normals, edges and weights, in the numbers of
// any stage. r follows from the goal that the god-object went for, which may be another point than p.

#include <array>
#include <cstdint>

#include "fast/meshes/bit_span.h"
#include "fast/meshes/bounded_vector3.h"
#include "fast/meshes/contact/goal.h"
#include "fast/meshes/walk.h"
#include "fast/numbers/big_float_ball.h"

namespace forceshade::fast::meshes {

// Exact, because no expression takes more bits than these have.
constexpr std::size_t kShadedLimbs = 64;
using Shaded = BigFloatBall<kShadedLimbs>;
static_assert(most_bits_of_shaded_force() <= static_cast<int>(64 * kShadedLimbs));

// r - p = vector/length, length > 0.
template <class N>
struct Way3 {
  Vector3<N> vector;
  N length;
};

template <class N>
FORCESHADE_INLINE Vector3<N> point(const float* a) noexcept {
  return {N::exactly(static_cast<double>(a[0])), N::exactly(static_cast<double>(a[1])), N::exactly(static_cast<double>(a[2]))};
}
template <class N>
FORCESHADE_INLINE Vector3<N> scaled(const N& factor, const Vector3<N>& a) noexcept {
  return {factor * a.x, factor * a.y, factor * a.z};
}
template <class N>
FORCESHADE_INLINE Vector3<N> sum(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
FORCESHADE_INLINE Vector3<N> opposite(const Vector3<N>& a) noexcept {
  return {-a.x, -a.y, -a.z};
}
template <class N>
N whole(std::uint32_t value) noexcept {
  return N::exactly(static_cast<double>(value));
}

using Force3 = std::array<float, 3>;  // N

// An exact number of units of `unit`, a power of two, in binary64.
template <int kBits>
DoubleWithError near(const FixedInteger<kBits>& number, double unit) noexcept {
  const double value = unit * number.approximately();
  return {value, 0x1p-51 * __builtin_fabs(value)};
}
template <class T>
Vector3<DoubleWithError> near(const Vector3<T>& a, double unit) noexcept {
  return {near(a.x, unit), near(a.y, unit), near(a.z, unit)};
}
constexpr double kUnit = 0x1p-53;  // mm, of coordinates; of products of two, three and four of them:
constexpr double kUnit2 = kUnit * kUnit, kUnit3 = kUnit2 * kUnit, kUnit4 = kUnit2 * kUnit2;

// kIsFromIntegers: what cancels is computed in integers first, so that each number is good to a few units of its last place,
// and 0 where it is 0.
template <class Numbers, bool kIsFromIntegers = false>
class RestNumbers {
 public:
  using N = Numbers;

  // Mesh, arrival, hand and goal have to outlive this.
  RestNumbers(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends) noexcept
      : mesh_(mesh),
        grid_point_(arrival.grid_point),
        rest_(arrival.rest),
        pull_(arrival.pull),
        ends_(ends),
        goal_point_(point<N>(ends.goal())) {}

  const Mesh& mesh() const noexcept { return mesh_; }
  const GridPoint& grid_point() const noexcept { return grid_point_; }
  RestKind rest() const noexcept { return rest_; }
  // True if the way, or what of it presses, is a foot's: at a right angle to the triangle or edge.
  bool is_at_foot() const noexcept { return (rest_ != RestKind::at_grid_point || is_pulled()) && ends_.are_one(); }
  // True if friction takes a part of the force: then q is p's nearest point of the plane or line along which the hand pulls.
  bool is_pulled() const noexcept { return rest_ == RestKind::at_grid_point && pull_.along != Slide::Along::nothing; }

  Way3<N> way() const noexcept {
    if (ends_.are_one() || rest_ == RestKind::at_grid_point) [[likely]]
      return way_from_goal();
    return way_past_goal();
  }

  // q - p, at a right angle to the pull.
  Way3<N> way_of_pressure() const noexcept {
    return pull_.along == Slide::Along::triangle ? to_triangle(mesh_.face(face_of(pull_.half))) : to_edge(pull_.half);
  }
  // r - q, along the pull.
  Way3<N> way_of_pull() const noexcept {
    if constexpr (kIsFromIntegers) {
      const ExactOffset U = exact_offset_from(point_of(mesh_, grid_point_), ends_.hand());
      const auto less = [&](const auto& pressure, const auto& length, double unit) -> Way3<N> {
        const auto one = [&](const auto& a, const auto& b) { return -(a * length) - b.template shifted<24>(); };
        const auto exact =
            Vector3<decltype(one(U.x, pressure.x))>{one(U.x, pressure.x), one(U.y, pressure.y), one(U.z, pressure.z)};
        return {near(exact, unit), near(length.template shifted<24>(), unit / kUnit)};
      };
      if (pull_.along == Slide::Along::triangle) {
        const Face& f = mesh_.face(face_of(pull_.half));
        const auto n = ExactFace(f).n;
        const auto across = -dot(n, exact_difference(ends_.goal(), f.corner[0].data()));
        return less(Vector3<decltype(across * n.x)>{across * n.x, across * n.y, across * n.z}, square(n), kUnit4 * kUnit);
      }
      const ExactDifference e = exact_edge(pull_.half), w = exact_difference(ends_.goal(), mesh_.start_point(pull_.half));
      return less(cross(e, cross(e, w)), square(e), kUnit3);
    }
    const Way3<N> all = way_from_goal(), pressure = way_of_pressure();
    return {scaled(pressure.length, all.vector) - scaled(all.length, pressure.vector), all.length * pressure.length};
  }

  Vector3<N> normal(const Face& f) const noexcept {
    if constexpr (kIsFromIntegers) return near(ExactFace(f).n, kUnit2);
    const Vector3<N> a = point<N>(f.corner[0].data());
    return cross(point<N>(f.corner[1].data()) - a, point<N>(f.corner[2].data()) - a);
  }
  Vector3<N> start() const noexcept { return point<N>(mesh_.start_point(grid_point_.half)); }
  Vector3<N> edge() const noexcept { return edge(grid_point_.half); }

  // Up to a common factor.
  std::array<N, 3> weights_in_triangle() const noexcept {
    if (rest_ == RestKind::at_grid_point)
      return {whole<N>(kGrid - grid_point_.weight[0] - grid_point_.weight[1]), whole<N>(grid_point_.weight[0]),
              whole<N>(grid_point_.weight[1])};
    const Face& f = mesh_.face(face_of(grid_point_.half));
    if constexpr (kIsFromIntegers) {
      const ExactWeights exact(f, ends_.goal());
      return {near(exact.corner[0], kUnit4), near(exact.corner[1], kUnit4), near(exact.corner[2], kUnit4)};
    }
    const Vector3<N> a = point<N>(f.corner[0].data()), n = normal(f), w = goal_point_ - a;
    const N second = dot(cross(w, point<N>(f.corner[2].data()) - a), n),
            third = dot(cross(point<N>(f.corner[1].data()) - a, w), n);
    return {square(n) - (second + third), second, third};
  }
  std::array<N, 2> weights_on_edge() const noexcept {
    if (rest_ == RestKind::at_grid_point) return {whole<N>(kGrid - grid_point_.weight[0]), whole<N>(grid_point_.weight[0])};
    if constexpr (kIsFromIntegers) {
      const ExactFoot exact(mesh_.start_point(grid_point_.half), mesh_.start_point(next(grid_point_.half)), ends_.goal());
      return {near(exact.length - exact.along, kUnit2), near(exact.along, kUnit2)};
    }
    const Vector3<N> e = edge();
    const N along = dot(goal_point_ - start(), e);
    return {square(e) - along, along};
  }

 private:
  // From the goal to its nearest point of a triangle's plane, and of an edge's line.
  FORCESHADE_INLINE Way3<N> to_triangle(const Face& f) const noexcept {
    const Vector3<N> n = normal(f);
    if constexpr (kIsFromIntegers) {
      const auto exact = ExactFace(f).n;
      return {scaled(-near(dot(exact, exact_difference(ends_.goal(), f.corner[0].data())), kUnit3), n),
              near(square(exact), kUnit4)};
    } else {
      return {scaled(-dot(n, goal_point_ - point<N>(f.corner[0].data())), n), square(n)};
    }
  }
  FORCESHADE_INLINE Way3<N> to_edge(HalfEdge h) const noexcept {
    if constexpr (kIsFromIntegers) {
      const ExactDifference e = exact_edge(h), w = exact_difference(ends_.goal(), mesh_.start_point(h));
      return {near(cross(e, cross(e, w)), kUnit3), near(square(e), kUnit2)};
    } else {
      const Vector3<N> e = edge(h), w = goal_point_ - point<N>(mesh_.start_point(h));
      return {cross(e, cross(e, w)), square(e)};
    }
  }

  // r less the goal; at the grid point, r less p.
  FORCESHADE_INLINE Way3<N> way_from_goal() const noexcept {
    switch (rest_) {
      case RestKind::in_triangle: return to_triangle(mesh_.face(face_of(grid_point_.half)));
      case RestKind::on_edge: return to_edge(grid_point_.half);
      case RestKind::at_goal: return {{}, N::exactly(1)};
      default: {
        const Point g = point_of(mesh_, grid_point_);
        if constexpr (kIsFromIntegers) return {opposite(near(exact_offset_from(g, ends_.hand()), kUnit)), N::exactly(0x1p24)};
        const Vector3<N> p = point<N>(ends_.hand());
        Vector3<N> to = scaled(whole<N>(g.weight[0]), point<N>(g.corner[0]) - p);
        for (std::size_t c = 1; c < static_cast<std::size_t>(g.count); ++c)
          to = sum(to, scaled(whole<N>(g.weight[c]), point<N>(g.corner[c]) - p));
        return {to, N::exactly(0x1p24)};
      }
    }
  }

  // Longer by the way from p to the goal.
  [[gnu::noinline]] Way3<N> way_past_goal() const noexcept {
    const Way3<N> from_goal = way_from_goal();
    const auto past = [&]() -> Vector3<N> {
      if constexpr (kIsFromIntegers) return near(exact_difference(ends_.goal(), ends_.hand()), kUnit);
      return goal_point_ - point<N>(ends_.hand());
    };
    return {sum(from_goal.vector, scaled(from_goal.length, past())), from_goal.length};
  }

  Vector3<N> edge(HalfEdge h) const noexcept { return point<N>(mesh_.start_point(next(h))) - point<N>(mesh_.start_point(h)); }
  ExactDifference exact_edge(HalfEdge h) const noexcept {
    return exact_difference(mesh_.start_point(next(h)), mesh_.start_point(h));
  }

  const Mesh& mesh_;
  const GridPoint& grid_point_;
  RestKind rest_;
  const Slide& pull_;
  HandAndGoal ends_;
  Vector3<N> goal_point_;
};

}  // namespace forceshade::fast::meshes
