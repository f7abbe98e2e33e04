// SPDX-License-Identifier: BSD-3-Clause
// The lengths of the integers of docs/soups.md: the formulas of the real-time side on numbers that count bits, from each place
// of a state through a flight or a slide and its rounding to the force, and the decisions on the way.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "fast/soups/points.h"

namespace forceshade::fast::soups {
namespace {

int most_bits = 0;  // of any result

// |value| < 2^bits.
struct Bits {
  int bits = 0;

  static Bits of(std::int64_t value) {
    int count = 0;
    for (auto size = static_cast<std::uint64_t>(value < 0 ? -value : value); size > 0; size >>= 1) ++count;
    return {count};
  }
  static Bits noted(int bits) {
    most_bits = std::max(most_bits, bits);
    return {bits};
  }
  int sign() const { return 1; }
  Bits operator-() const { return *this; }
  friend Bits operator+(const Bits& a, const Bits& b) { return noted(std::max(a.bits, b.bits) + 1); }
  friend Bits operator-(const Bits& a, const Bits& b) { return a + b; }
  friend Bits operator*(const Bits& a, const Bits& b) { return noted(a.bits + b.bits); }
  Bits shifted(int count) const { return noted(bits + count); }
};
using Vector = Vector3<Bits>;
using At = Scaled<Bits>;
using Time = Quotient<Bits>;

constexpr Bits kCoordinate{67};
const Vector corner{kCoordinate, kCoordinate, kCoordinate};  // and the hand
const Corners<Bits> face{{corner, corner, corner}};
const Vector edge = face.side(0), n = face.normal(), crossing = cross(n, n);
constexpr std::int64_t kMost = kGrid;  // of a parameter

Vector from_corner(const At& x) {
  return x.x - x.w * corner;
}
Bits inside(const At& x) {
  return dot(cross(edge, from_corner(x)), n);
}
Vector way_between(const At& a, const At& b) {
  return a.w * b.x - b.w * a.x;
}
void compare(const Time& a, const Time& b) {
  static_cast<void>(a.num * b.den - b.num * a.den);
}

// Grid points and points where lines meet, which rounding gives; and feet, where a tick may begin, too.
std::vector<std::pair<std::string, At>> places() {
  return {{"v", {corner, Bits::of(1)}},
          {"e", point_on_edge(corner, corner, kMost)},
          {"t", point_in_triangle(face, kMost, kMost)},
          {"c", point_on_crossing(face, face, 0, kMost)},
          {"ee", edges_meeting(corner, corner, corner, corner)},
          {"ef", edge_and_plane(corner, corner, face)},
          {"fff", planes_meeting(face, face, face)},
          {"q t", foot_in_plane(face, corner)},
          {"q e", foot_on_edge(corner, corner, corner)},
          {"q c", foot_on_crossing(face, face, corner)}};
}
constexpr std::size_t kRounded = 7;

// Decides which triangles hold it, and where on the grid it is.
void locate(const At& x) {
  dot(n, from_corner(x));
  const Time weight{inside(x).shifted(25), (squared(n) * x.w).shifted(1)},
      along{dot(from_corner(x), edge).shifted(25), squared(edge) * x.w};
  for (const Time& t : {weight, along}) static_cast<void>(t.num - Bits::of(2 * kMost + 1) * t.den);
  way_between(x, {corner, Bits::of(1)});
}

// The cells that a direction and its opposite lead to.
void look_along(const Vector& d) {
  for (const Vector& ray : {edge, crossing}) {
    determinant(ray, d, n);
    const Bits s = dot(d, ray);
    const Time of_ray{s * s, squared(ray)}, of_piece{squared(cross(d, n)), squared(n)};
    for (const Vector& other : {edge, crossing}) {
      const Bits t = dot(d, other);
      compare(of_ray, {t * t, squared(other)});
    }
    compare(of_ray, of_piece);
    compare(of_piece, of_piece);
  }
}

// The stars themselves: borders, rays, pieces and their middles, wedges.
void build_stars() {
  for (const Vector& ray : {edge, crossing})
    for (const Vector& other : {edge, crossing}) {
      cross(ray, other);
      determinant(ray, other, n);
      determinant(n, n, ray);
      const Vector middle = other.x * ray + ray.x * other;
      dot(cross(edge, middle), n);
      determinant(edge, middle, n);
      determinant(middle, middle, n);
      look_along(middle);
      look_along(cross(n, ray));
      dot(n, cross(n + n, ray));
      determinant(n, ray, cross(n + n, ray));
    }
}

std::vector<Time> times(const At& g, const Vector& d) {
  const Vector from = from_corner(g);
  return {{dot(n, from), dot(n, d)}, {dot(cross(edge, from), n), dot(cross(edge, d), n)}};
}
Time foot_of(const At& g, const Vector& d, const At& target) {
  const Bits share = Bits::of(kGrid);
  return {share * dot(way_between(g, target), d), share * (target.w * squared(d))};
}

// A way from g along d to `most`; what ends there or on the way.
std::vector<At> ends(const At& g, const Vector& d, const Time& most) {
  look_along(d);
  dot(cross(from_corner(g), edge), d);
  std::vector<At> all{point_along(g, d, most)};
  for (const Time& t : times(g, d)) {
    compare(t, most);
    for (const Time& other : times(g, d)) compare(t, other);
    all.push_back(point_along(g, d, t));
  }
  for (const At& x : all) locate(x);
  return all;
}

void round_on_line(const At& x) {
  for (const Vector& line : {edge, crossing})
    for (const At& grid : {places()[1].second, places()[3].second}) {
      const Time most = foot_of(x, line, grid);
      for (const Time& t : times(x, line)) compare(t, most);
    }
}
void round_end(const At& x) {
  round_on_line(x);
  const At grid = places()[2].second;
  const Time most{Bits::of(1), grid.w};
  for (const At& y : ends(x, way_between(x, grid), most)) round_on_line(y);
}

void compare_distances(const At& a, const At& b) {
  const Vector first = b.w * a.x, second = a.w * b.x;
  const Bits both = a.w * b.w;
  dot(second - first, (both + both) * corner - (first + second));
}

// With friction: the pull and the pressure of a way from g to q.
void slip(const At& g, const At& q) {
  const Bits pull = squared(way_between(g, q)), pressure = squared(g.w * (q.w * corner - q.x)), mu{44}, i = Bits::of(kGrid);
  static_cast<void>((i * i * pull).shifted(66) - (mu * mu * pressure).shifted(48));
}

// The force at r; of friction the part r - q, else q is r. Normals are at most 2, in units of 2^-149; K has 53 bits. A tie is a
// multiple of 2^-203, and below 2^27 N.
void press(const At& r, const At& q) {
  constexpr Bits kNormal{151}, kLength{180}, kStiffness{53}, kTie{53};
  constexpr int kShift = 110;
  const Vector normal{kNormal, kNormal, kNormal};
  const Vector held = way_between(q, r), pressing = q.x - q.w * corner;
  const Bits held_w = q.w * r.w;
  const Vector interpolated = inside(r) * normal + inside(r) * normal + inside(r) * normal;
  const Vector turn = cross(n, n);
  dot(pressing, turn);
  const Bits alpha = dot(cross(pressing, n), turn);
  const Vector one = alpha * kLength * squared(n) * interpolated, crease = one + one;
  for (const Vector& N : {normal, interpolated, crease}) {
    dot(N, pressing);
    const Bits square_N = q.w * q.w * squared(N),
               root = kStiffness * kStiffness * squared(pressing) * (N.x * N.x) * (held_w * held_w),
               rest = (kTie * held_w).shifted(kShift) - (kStiffness * held.x).shifted(kShift);
    static_cast<void>(root.shifted(2 * kShift) - rest * rest * square_N);
  }
}

TEST(lengths_of_integers_on_soups, are_below_what_the_type_holds) {
  const auto all = places();
  const auto row = [](const char* what, const auto& run) {
    most_bits = 0;
    run();
    std::printf("  %5d bits: %s\n", most_bits, what);
    EXPECT_LE(most_bits / 64 + 2, static_cast<int>(Whole::kLimbs)) << what;  // of two factors' limbs, whose last are not full
    return most_bits;
  };
  const At hand{corner, Bits::of(1)}, foot = foot_in_plane(face, corner);
  int longest = row("stars", [] { build_stars(); });
  for (const auto& [name, place] : all) {
    const At& g = place;
    longest = std::max(longest, row(("flights and slides from " + name).c_str(), [&] {
                         locate(g);
                         const Vector u = way_between(g, hand);
                         std::vector<At> x = ends(g, u, {Bits::of(1), Bits::of(1)});
                         for (const At& end : ends(g, way_between(g, foot), {Bits::of(kGrid), Bits::of(kGrid) * foot.w}))
                           x.push_back(end);
                         for (const Vector& ray : {edge, crossing})
                           for (const At& end : ends(g, ray, foot_of(g, ray, hand))) x.push_back(end);
                         for (const At& end : x) round_end(end);
                         for (std::size_t i = 0; i < kRounded; ++i) compare_distances(all[i].second, g);
                       }));
    longest = std::max(longest, row(("friction at " + name).c_str(), [&] {
                         for (std::size_t i = kRounded; i < all.size(); ++i) slip(g, all[i].second);
                       }));
    longest = std::max(longest, row(("forces at " + name).c_str(), [&] {
                         for (std::size_t i = kRounded; i < all.size(); ++i) press(g, all[i].second);
                       }));
  }
  EXPECT_EQ(longest / 64 + 2, static_cast<int>(Whole::kLimbs))
      << "the type is longer than needed, and cuts nothing above the bound";
}

// Each operation that makes a number longer counts, and no other one.
TEST(lengths_of_integers_on_soups, a_result_that_is_cut_is_counted) {
  const auto cuts_of = [](const auto& run) {
    const std::uint64_t before = std::exchange(Whole::cuts, 0);
    run();
    return std::exchange(Whole::cuts, before);
  };
  constexpr int kBits = 64 * static_cast<int>(Whole::kLimbs);
  const Whole one(1), half = one.shifted(kBits / 2 - 1);  // whose limbs are full
  Whole largest;
  EXPECT_EQ(cuts_of([&] { largest = half * half; }), 0U);
  EXPECT_EQ(cuts_of([&] { largest = largest + largest; }), 0U);
  EXPECT_EQ(largest.bits(), kBits);
  EXPECT_EQ(cuts_of([&] { largest = largest + half - one; }), 0U);
  EXPECT_EQ(cuts_of([&] { largest + largest; }), 1U);
  EXPECT_EQ(cuts_of([&] { largest* Whole(-1); }), 1U) << "it may be cut";
  EXPECT_EQ(cuts_of([&] { one.shifted(kBits); }), 1U);
}

}  // namespace
}  // namespace forceshade::fast::soups
