// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Points as x/w with integers, w > 0, from the coordinates of triangles and of the hand.

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "fast/meshes/mesh.h"
#include "fast/soups/numbers.h"

namespace forceshade::fast::soups {

inline constexpr std::int64_t kGrid = std::int64_t{1} << 24;
inline constexpr std::uint32_t kNone = ~std::uint32_t{0};

template <class N>
struct Scaled {
  Vector3<N> x;
  N w;
};

// A triangle's numbers.
template <class N>
struct Corners {
  std::array<Vector3<N>, 3> at;

  const Vector3<N>& operator[](std::size_t i) const noexcept { return at[i]; }
  Vector3<N> side(std::size_t i) const noexcept { return at[i == 2 ? 0 : i + 1] - at[i]; }
  Vector3<N> normal() const noexcept { return cross(side(0), at[2] - at[0]); }
};
template <class N>
Corners<N> corners(const Face& f) noexcept {
  return {{corner_point<N>(f.corner[0].data()), corner_point<N>(f.corner[1].data()), corner_point<N>(f.corner[2].data())}};
}
template <class N>
Vector3<N> normal(const Face& f) noexcept {
  return corners<N>(f).normal();
}
template <class N>
Vector3<N> side_of_face(const Face& f, std::size_t i) noexcept {
  return corner_point<N>(f.corner[after(static_cast<std::uint32_t>(i))].data()) - corner_point<N>(f.corner[i].data());
}

// ---- Points of the grids. sum: kGrid.
template <class N>
Scaled<N> point_on_edge(const Vector3<N>& a, const Vector3<N>& b, std::int64_t m) noexcept {
  return {N::of(kGrid - m) * a + N::of(m) * b, N::of(kGrid)};
}
template <class N>
Scaled<N> point_in_triangle(const Corners<N>& f, std::int64_t k, std::int64_t l) noexcept {
  return {N::of(kGrid - k - l) * f[0] + N::of(k) * f[1] + N::of(l) * f[2], N::of(kGrid)};
}
template <class N>
Scaled<N> positive(const Vector3<N>& x, const N& w) noexcept {
  return w.sign() < 0 ? Scaled<N>{-x, -w} : Scaled<N>{x, w};
}
// On the line of f and h, where the weight of f's corner i is m/kGrid: h's heights under the corners, with these weights, are
// 0.
template <class N>
Scaled<N> point_on_crossing(const Corners<N>& f, const Corners<N>& h, std::size_t i, std::int64_t m) noexcept {
  const Vector3<N> n = h.normal();
  const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
  const N of_i = dot(n, f[i] - h[0]), of_j = dot(n, f[j] - h[0]), of_l = dot(n, f[l] - h[0]);
  const N own = N::of(m), rest = N::of(kGrid - m), slope = of_j - of_l;
  return positive<N>(own * slope * f[i] - (own * of_i + rest * of_l) * f[j] + (own * of_i + rest * of_j) * f[l],
                     N::of(kGrid) * slope);
}

// ---- Points where lines and planes meet.
template <class N>
Scaled<N> edges_meeting(const Vector3<N>& a, const Vector3<N>& b, const Vector3<N>& c, const Vector3<N>& d) noexcept {
  const Vector3<N> e = b - a, other = d - c, turn = cross(e, other);
  const N w = squared(turn);
  return {w * a + dot(cross(c - a, other), turn) * e, w};
}
template <class N>
Scaled<N> edge_and_plane(const Vector3<N>& a, const Vector3<N>& b, const Corners<N>& f) noexcept {
  const Vector3<N> n = f.normal(), e = b - a;
  const N w = dot(n, e);
  return positive<N>(w * a + dot(n, f[0] - a) * e, w);
}
template <class N>
Scaled<N> planes_meeting(const Corners<N>& f, const Corners<N>& g, const Corners<N>& h) noexcept {
  const Vector3<N> n = f.normal(), m = g.normal(), k = h.normal(), cut = cross(m, k);
  return positive<N>(dot(n, f[0]) * cut + dot(m, g[0]) * cross(k, n) + dot(k, h[0]) * cross(n, m), dot(n, cut));
}

// ---- Feet of p.
template <class N>
Scaled<N> foot_in_plane(const Corners<N>& f, const Vector3<N>& p) noexcept {
  const Vector3<N> n = f.normal();
  const N w = squared(n);
  return {w * p - dot(n, p - f[0]) * n, w};
}
template <class N>
Scaled<N> foot_on_edge(const Vector3<N>& a, const Vector3<N>& b, const Vector3<N>& p) noexcept {
  const Vector3<N> e = b - a;
  const N w = squared(e);
  return {w * a + dot(p - a, e) * e, w};
}
template <class N>
Scaled<N> foot_on_crossing(const Corners<N>& f, const Corners<N>& h, const Vector3<N>& p) noexcept {
  const Vector3<N> n = f.normal(), m = h.normal(), r = cross(n, m);
  const N w = squared(r);
  return {w * p + dot(n, f[0] - p) * cross(m, r) + dot(m, h[0] - p) * cross(r, n), w};
}

// The point of the way from g along e that is num/den of e/g.w away.
template <class N>
Scaled<N> point_along(const Scaled<N>& g, const Vector3<N>& e, const Quotient<N>& t) noexcept {
  return {t.den * g.x + t.num * e, t.den * g.w};
}

// A point with what is known of the triangles that hold it.
class Point {
 public:
  Point() noexcept = default;
  explicit Point(Scaled<Whole> exact) noexcept
      : exact_(std::move(exact)), about_{ball_of(exact_.x, exact_.w), Ball::exactly(1)} {}
  static Point of(const std::array<float, 3>& position) noexcept {
    Point point;
    point.exact_ = {corner_point<Whole>(position.data()), Whole(1)};
    point.about_ = {corner_point<Ball>(position.data()), Ball::exactly(1)};
    return point;
  }

  template <class N>
  const Scaled<N>& get() const noexcept {
    if constexpr (std::is_same_v<N, Ball>)
      return about_;
    else
      return exact_;
  }
  Vector3<double> about() const noexcept { return {about_.x.x.value, about_.x.y.value, about_.x.z.value}; }

  std::uint32_t vertex = kNone;                     // it is this one
  std::array<std::uint32_t, 2> edge{kNone, kNone};  // it lies between these, ends included
  std::array<const Face*, 3> faces{};               // these hold it

  // The same point, by the numbers of another one, which may be shorter.
  void take_numbers(const Point& same) noexcept {
    exact_ = same.exact_;
    about_ = same.about_;
  }

  void forget() noexcept {
    vertex = kNone;
    edge = {kNone, kNone};
    faces = {};
  }

 private:
  Scaled<Whole> exact_;
  Scaled<Ball> about_;
};

// The point less a corner, times a positive number.
template <class N>
Vector3<N> from_corner(const float* corner, const Point& x) noexcept {
  const Scaled<N>& its = x.get<N>();
  if constexpr (std::is_same_v<N, Ball>)
    return its.x - corner_point<Ball>(corner);
  else
    return its.x - its.w * corner_point<Whole>(corner);
}

// n·(x - a): the side of the triangle's plane that x is on.
inline int side_of_plane(const Face& f, const Point& x) noexcept {
  return sign_of([&]<class N>() { return dot(normal<N>(f), from_corner<N>(f.corner[0].data(), x)); });
}
// The distance of a point of the plane from side i, times a positive number.
template <class N>
N inside(const Face& f, std::size_t i, const Point& x) noexcept {
  return dot(cross(side_of_face<N>(f, i), from_corner<N>(f.corner[i].data(), x)), normal<N>(f));
}
inline int sign_inside(const Face& f, std::size_t i, const Point& x) noexcept {
  return sign_of([&]<class N>() { return inside<N>(f, i, x); });
}

// The sign of |p - b| - |p - a|.
inline bool is_nearer(const Point& p, const Point& a, const Point& b) noexcept {
  return sign_of([&]<class N>() {
           const Scaled<N>&at = p.get<N>(), &one = a.get<N>(), &other = b.get<N>();
           const Vector3<N> first = other.w * one.x, second = one.w * other.x;
           const N both = one.w * other.w;
           return dot(second - first, (both + both) * at.x - at.w * (first + second));
         }) < 0;
}
inline bool is_same(const Point& a, const Point& b) noexcept {
  const Vector3<Ball> off = a.get<Ball>().x - b.get<Ball>().x;
  if (off.x.is_sure() || off.y.is_sure() || off.z.is_sure()) return false;
  const Scaled<Whole>&one = a.get<Whole>(), &other = b.get<Whole>();
  const Vector3<Whole> difference = other.w * one.x - one.w * other.x;
  return difference.x.is_zero() && difference.y.is_zero() && difference.z.is_zero();
}

}  // namespace forceshade::fast::soups
