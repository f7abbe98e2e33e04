// SPDX-License-Identifier: BSD-3-Clause
// Sides and meetings against rational arithmetic by another method: one triangle is cut by the other's plane and edges, and
// what is left of it is compared with the corners that they share.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {
namespace {

using Point = std::array<mpq_class, 3>;

Point exact(const Vertex& v) {
  return {mpq_class(static_cast<double>(v[0])), mpq_class(static_cast<double>(v[1])), mpq_class(static_cast<double>(v[2]))};
}
Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The part of a convex polygon where normal . (x - at) >= 0.
std::vector<Point> cut(const std::vector<Point>& polygon, const Point& normal, const Point& at) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const mpq_class of_a = dot(normal, minus(a, at)), of_b = dot(normal, minus(b, at));
    if (of_a >= 0) kept.push_back(a);
    if (sgn(of_a) * sgn(of_b) < 0) {
      const mpq_class t = of_a / (of_a - of_b);
      const Point along = minus(b, a);
      kept.push_back({a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]});
    }
  }
  return kept;
}

// The corners of what two triangles have in common.
std::set<Point> common_points(const TrianglePoints& s, const TrianglePoints& t) {
  std::vector<Point> polygon{exact(s[0]), exact(s[1]), exact(s[2])};
  const std::array<Point, 3> corners{exact(t[0]), exact(t[1]), exact(t[2])};
  const Point n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  polygon = cut(polygon, n, corners[0]);
  polygon = cut(polygon, {-n[0], -n[1], -n[2]}, corners[0]);
  for (std::size_t i = 0; i < 3; ++i) polygon = cut(polygon, cross(n, minus(corners[(i + 1) % 3], corners[i])), corners[i]);
  return {polygon.begin(), polygon.end()};
}

bool is_on_line(const Point& p, const Point& a, const Point& b) {
  const Point zero = cross(minus(p, a), minus(b, a));
  return zero[0] == 0 && zero[1] == 0 && zero[2] == 0;
}

int sign_of_side(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  const Point of_a = exact(a);
  return sgn(dot(cross(minus(exact(b), of_a), minus(exact(c), of_a)), minus(exact(d), of_a)));
}

// Coordinates that often coincide or nearly do: a small grid; the grid far from the origin; neighbours of its points; any
// sizes; and points of two lines through the origin, which are in one plane although their differences need more bits than
// binary64 has.
class Cases {
 public:
  explicit Cases(unsigned seed) : random_(seed) {}

  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }

  void next_kind() { kind_ = below(6); }

  Vertex vertex() {
    if (kind_ == 5) {
      const float x = std::ldexp(1 + static_cast<float>(below(1U << 20)) * 0x1p-20F, static_cast<int>(below(40)) - 30);
      return {x, 3 * x, below(2) == 0 ? 5 * x : -5 * x};
    }
    Vertex v;
    for (float& x : v) {
      x = static_cast<float>(below(4));
      if (kind_ == 1) x += 9996;
      if (kind_ == 2) x = x * 0.1F + static_cast<float>(below(2)) * 0x1p-24F;
      if (kind_ == 3) x = static_cast<float>(static_cast<int>(random_())) * 0x1p-25F;
      if (kind_ == 4) x = below(2) == 0 ? std::ldexp(x, -static_cast<int>(below(30))) : x * 3000;
      if (std::fabs(x) < 0x1p-30F) x = 0;
    }
    return v;
  }

  TrianglePoints triangle() {
    while (true) {
      const TrianglePoints t{vertex(), vertex(), vertex()};
      if (has_area(t)) return t;
    }
  }

 private:
  std::mt19937 random_;
  unsigned kind_ = 0;
};

TEST(predicates, give_the_sign_of_the_rational_number) {
  Cases cases(1);
  std::array<int, 3> signs{};
  const Stages before = stages();
  for (int i = 0; i < 40000; ++i) {
    cases.next_kind();
    const Vertex a = cases.vertex(), b = cases.vertex(), c = cases.vertex(), d = cases.vertex();
    const int sign = sign_of_side(a, b, c, d);
    ASSERT_EQ(side_of(a, b, c, d), sign) << i;
    ++signs[static_cast<std::size_t>(sign + 1)];
    const Point n = cross(minus(exact(b), exact(a)), minus(exact(c), exact(a)));
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(turn(axis, a, b, c), sgn(n[axis])) << i;
    ASSERT_EQ(has_area({a, b, c}), n[0] != 0 || n[1] != 0 || n[2] != 0) << i;
  }
  const Stages after = stages();
  std::printf("behind %d, in the plane %d, in front %d; binary64 %llu, 128 bits %llu, 256 bits %llu\n", signs[0], signs[1],
              signs[2], static_cast<unsigned long long>(after.binary64 - before.binary64),
              static_cast<unsigned long long>(after.bits_128 - before.bits_128),
              static_cast<unsigned long long>(after.bits_256 - before.bits_256));
  for (const int count : signs) EXPECT_GT(count, 1000);
  EXPECT_GT(after.binary64 - before.binary64, 1000U);
  EXPECT_GT(after.bits_128 - before.bits_128, 1000U);
  EXPECT_GT(after.bits_256 - before.bits_256, 100U);
}

// Points that are as far apart as they can be and nearly in one plane.
TEST(predicates, decide_at_the_ends_of_the_domain) {
  const float most = 1e4F, least = 0x1p-30F;
  int zeros = 0, others = 0;
  for (const float e : {0.0F, least, -least, std::nextafter(least, 1.0F)}) {
    const Vertex a{-most, -most, -most}, b{most, most, most}, c{most, -most, least}, d{-most, most, e};
    const int sign = sign_of_side(a, b, c, d);
    EXPECT_EQ(side_of(a, b, c, d), sign) << e;
    EXPECT_EQ(side_of(b, a, c, d), -sign) << e;
    ++(sign == 0 ? zeros : others);
  }
  EXPECT_GT(zeros, 0);
  EXPECT_GT(others, 0);
}

TEST(predicates, find_what_triangles_have_in_common_beside_their_common_corners) {
  Cases cases(2);
  std::array<std::array<int, 2>, 3> counts{};
  int coplanar = 0;
  for (int i = 0; i < 60000; ++i) {
    cases.next_kind();
    const std::size_t shared = cases.below(3);
    const TrianglePoints s = cases.triangle();
    TrianglePoints t = cases.triangle();
    for (std::size_t k = 0; k < shared; ++k) t[k] = s[k];
    if (!has_area(t)) continue;
    const std::set<Point> points = common_points(s, t);
    bool is_wrong = false;
    for (const Point& p : points) {
      if (shared == 0) is_wrong = true;
      if (shared == 1) is_wrong |= p != exact(s[0]);
      if (shared == 2) is_wrong |= !is_on_line(p, exact(s[0]), exact(s[1]));
    }
    const auto decide = [&](const TrianglePoints& a, const TrianglePoints& b) {
      return shared == 0 ? meet(a, b) : shared == 1 ? meet_beside_corner(a, b) : meet_beside_edge(a, b);
    };
    ASSERT_EQ(decide(s, t), is_wrong) << i << ", " << shared << " shared";
    ASSERT_EQ(decide(t, s), is_wrong) << i << ", " << shared << " shared";
    ++counts[shared][is_wrong ? 1 : 0];
    coplanar +=
        side_of(s[0], s[1], s[2], t[0]) == 0 && side_of(s[0], s[1], s[2], t[1]) == 0 && side_of(s[0], s[1], s[2], t[2]) == 0;
  }
  for (std::size_t shared = 0; shared < 3; ++shared) {
    std::printf("%zu corners shared: %d meet as they should, %d otherwise\n", shared, counts[shared][0], counts[shared][1]);
    EXPECT_GT(counts[shared][0], 500);
    EXPECT_GT(counts[shared][1], 500);
  }
  std::printf("%d of them in one plane\n", coplanar);
  EXPECT_GT(coplanar, 500);
}

}  // namespace
}  // namespace forceshade::mesh
