// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A straight way between two points of the grid, in integers: where it meets a triangle.

#include "fast/meshes/flight.h"

namespace forceshade::fast {

// A point in units of 2^-77 mm.
using GridPlace = Vector3<FixedInteger<92>>;

inline GridPlace place_of(const Point& g) noexcept {
  const auto coordinate = [&](std::size_t axis) {
    FixedInteger<92> sum;
    for (int c = 0; c < g.count; ++c) {
      const auto i = static_cast<std::size_t>(c);
      // No partial sum exceeds 2^24 times the largest coordinate: the weights add up to 2^24.
      const auto next = sum + in_units(g.corner[i][axis]) * FixedInteger<25>(static_cast<std::int64_t>(g.weight[i]));
      sum = FixedInteger<92>(next.words());
    }
    return sum;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

// A straight way. Its ends are `scale` times as long as they are in units of 2^-53 mm.
template <int kEnd, int kScale>
class Segment {
 public:
  using End = Vector3<FixedInteger<kEnd>>;
  Segment(const End& from, const End& to, const FixedInteger<kScale>& scale) noexcept : from_(from), to_(to), scale_(scale) {}

  // The share of the way at which it meets a feature, as num/den from 0 to 1.
  struct Fraction {
    FixedInteger<2 * kEnd + 142> num, den;
  };

  // Calls meets(part, corner, where) for each feature of the triangle that it meets strictly between its ends. Where it lies in
  // the triangle's plane, these are its edges and corners. where(): a Fraction.
  template <class Meets>
  void meet(const Face& f, const Meets& meets) const noexcept {
    const ExactFace face(f);
    const auto u = to_ - from_;
    const auto at_start = dot(face.n, from_ - corner(f, 0)), at_end = dot(face.n, to_ - corner(f, 0));
    const int before_plane = at_start.sign(), beyond = at_end.sign();
    if (before_plane == 0 && beyond == 0) return meet_flat(f, u, meets);
    if (before_plane * beyond >= 0) return;
    std::array<int, 3> inside;  // of the edge opposite to a corner
    for (std::uint32_t i = 0; i < 3; ++i) {
      inside[i] = beyond * opposite(f, i, u).sign();
      if (inside[i] < 0) return;
    }
    const auto where = [&] { return between(at_start, at_end); };
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (inside[i] != 0) continue;
      if (inside[after(i)] == 0) return meets(Hit::Part::corner, before(i), where);
      if (inside[before(i)] != 0) return meets(Hit::Part::edge, after(i), where);
    }
    meets(Hit::Part::triangle, 0, where);
  }

  // The place where it goes through the triangle's plane, its ends being on either side.
  Fraction through(const Face& f) const noexcept {
    const ExactFace face(f);
    return between(dot(face.n, from_ - corner(f, 0)), dot(face.n, to_ - corner(f, 0)));
  }

  // n·u times the weight that the corner i has where the way's line goes through the plane.
  template <class Direction>
  auto opposite(const Face& f, std::uint32_t i, const Direction& u) const noexcept {
    const std::uint32_t a = after(i), b = after(a);
    return dot(cross(from_ - corner(f, a), u), exact_difference(f.corner[b].data(), f.corner[a].data()));
  }

  // The feature of the triangle that the start lies in.
  Hit::Part start_in(const Face& f, std::uint32_t& corner_or_edge) const noexcept {
    const ExactFace face(f);
    if (!dot(face.n, from_ - corner(f, 0)).is_zero()) return Hit::Part::none;
    std::array<int, 3> inside;  // of edge i
    int zeros = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto e = exact_difference(f.corner[after(i)].data(), f.corner[i].data());
      inside[i] = dot(cross(e, from_ - corner(f, i)), face.n).sign();
      if (inside[i] < 0) return Hit::Part::none;
      zeros += inside[i] == 0;
    }
    corner_or_edge = 0;
    if (zeros == 0) return Hit::Part::triangle;
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (zeros == 1 && inside[i] == 0) corner_or_edge = i;
      if (zeros == 2 && inside[i] != 0) corner_or_edge = before(i);
    }
    return zeros == 1 ? Hit::Part::edge : Hit::Part::corner;
  }

 private:
  template <class Side>
  static Fraction between(const Side& at_start, const Side& at_end) noexcept {
    const auto all = at_start - at_end;
    return all.is_negative() ? Fraction{-at_start, -all} : Fraction{at_start, all};
  }

  auto corner(const Face& f, std::uint32_t i) const noexcept {
    const auto& c = f.corner[i];
    return Vector3<FixedInteger<67 + kScale>>{in_units(c[0]) * scale_, in_units(c[1]) * scale_, in_units(c[2]) * scale_};
  }

  template <class Direction, class Meets>
  void meet_flat(const Face& f, const Direction& u, const Meets& meets) const noexcept {
    const auto is_zero = [](const auto& v) { return v.x.is_zero() && v.y.is_zero() && v.z.is_zero(); };
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto w = corner(f, i) - from_;
      const auto along = dot(w, u), length = dot(u, u);
      if (is_zero(cross(w, u)) && along.sign() > 0 && along.compare(length) < 0)
        meets(Hit::Part::corner, i, [&] { return Fraction{along, length}; });
      const auto e = exact_difference(f.corner[after(i)].data(), f.corner[i].data());
      const auto across = cross(u, e);
      if (is_zero(across)) continue;
      const auto all = dot(across, across), s = dot(cross(w, e), across);
      const auto t = dot(cross(w, u), across);  // times the scale
      if (s.sign() > 0 && s.compare(all) < 0 && t.sign() > 0 && t.compare(all * scale_) < 0)
        meets(Hit::Part::edge, i, [&] { return Fraction{s, all}; });
    }
  }

  const End from_, to_;
  const FixedInteger<kScale> scale_;
};
using GridSegment = Segment<92, 25>;

}  // namespace forceshade::fast
