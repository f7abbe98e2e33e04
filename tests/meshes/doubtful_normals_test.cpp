// SPDX-License-Identifier: BSD-3-Clause
// Intervals in integers, and the corner normals that they decide, against MPFI.

#include "rendering/meshes/doubtful_normals.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/mpfi.hpp>
#include <cmath>
#include <map>
#include <random>

#include "rendering/meshes/creases.h"
#include "rendering/meshes/interval.h"
#include "rendering/meshes/make.h"

namespace forceshade::mesh {
namespace {

// Intervals of 1660 bits.
using Mpfi = boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<500>, boost::multiprecision::et_off>;
using MpfiVector = std::array<Mpfi, 3>;

// Exact, since the centre and the radius have fewer bits.
Mpfi end_of(const Interval& interval, int side) {
  const Whole end = interval.centre() + side * interval.radius();
  return ldexp(Mpfi(end.str()), interval.exponent());
}

bool encloses(const Interval& ours, const Mpfi& theirs) {
  return lower(end_of(ours, -1)) <= lower(theirs) && upper(theirs) <= upper(end_of(ours, 1));
}

float nearest_to_end(const Mpfi& number, bool is_high) {
  return mpfr_get_flt(is_high ? &number.backend().data()->right : &number.backend().data()->left, MPFR_RNDN);
}

class Source {
 public:
  // A number between 2^-80 and 2^63 in size, of few bits or many; one of eight is 0.
  double number() {
    if (random_() % 8 == 0) return 0;
    const auto bits = static_cast<double>(static_cast<std::int64_t>(random_()) >> (random_() % 60));
    return std::ldexp(bits, static_cast<int>(random_() % 80) - 80);
  }
  // An interval of one number or of many.
  Interval interval(int bits) {
    const Interval centre(bits, number());
    return random_() % 3 == 0 ? centre : centre + Interval(bits, number()) * Interval::of_units(bits);
  }
  std::mt19937_64& random() { return random_; }

 private:
  std::mt19937_64 random_{20};
};

TEST(intervals, enclose_what_comes_of_their_numbers) {
  Source source;
  std::map<std::string, int> checked;
  for (const int bits : {8, 24, 64, 192, 500})
    for (int i = 0; i < 1000; ++i) {
      const Interval a = source.interval(bits), b = source.interval(bits);
      const auto check = [&](const char* name, const Interval& result, const auto& operation) {
        ++checked[name];
        for (const int of_a : {-1, 0, 1})
          for (const int of_b : {-1, 0, 1})
            ASSERT_TRUE(encloses(result, operation(end_of(a, of_a), end_of(b, of_b)))) << name << ' ' << bits << ' ' << i;
      };
      check("+", a + b, [](const Mpfi& x, const Mpfi& y) -> Mpfi { return x + y; });
      check("-", a - b, [](const Mpfi& x, const Mpfi& y) -> Mpfi { return x - y; });
      check("*", a * b, [](const Mpfi& x, const Mpfi& y) -> Mpfi { return x * y; });
      if (b.has_zero()) {
        EXPECT_THROW(a / b, std::domain_error);
      } else {
        check("/", a / b, [](const Mpfi& x, const Mpfi& y) -> Mpfi { return x / y; });
      }
      if (a.has_zero() || a.centre() < 0) {
        EXPECT_THROW(sqrt(a), std::domain_error);
      } else {
        check("sqrt", sqrt(a), [](const Mpfi& x, const Mpfi&) -> Mpfi { return sqrt(x); });
      }
    }
  for (const auto& [name, count] : checked) {
    std::printf("%s: %d\n", name.c_str(), count);
    EXPECT_GT(count, 1000) << name;
  }
}

// atan and cos of one number, and pi: narrow, too.
TEST(intervals, of_functions_enclose_and_are_narrow) {
  Source source;
  const auto is_narrow = [](const Interval& result, int lost) {
    return (result.radius() << (result.bits() - lost)) <= abs(result.centre());
  };
  for (const int bits : {64, 192, 384, 1280}) {
    const Interval pi = Interval::pi(bits);
    EXPECT_TRUE(encloses(pi, 4 * atan(Mpfi(1)))) << bits;
    EXPECT_TRUE(is_narrow(pi, 10)) << bits;
    for (int i = 0; i < 300; ++i) {
      const double number = std::fabs(source.number()) + 1e-12;
      const Interval angle = atan(Interval(bits, number)), root = sqrt(Interval(bits, number));
      ASSERT_TRUE(encloses(angle, atan(Mpfi(number)))) << bits << ' ' << number;
      ASSERT_TRUE(is_narrow(angle, 12)) << bits << ' ' << number;
      ASSERT_TRUE(encloses(root, sqrt(Mpfi(number)))) << bits << ' ' << number;
      ASSERT_TRUE(is_narrow(root, 3)) << bits << ' ' << number;
      const double turn = std::fmod(number, 3.14);
      const Interval cosine = cos(Interval(bits, turn));
      ASSERT_TRUE(encloses(cosine, cos(Mpfi(turn)))) << bits << ' ' << turn;
      ASSERT_LT(ldexp(upper(end_of(cosine, 1)) - lower(end_of(cosine, -1)), bits - 12), 1) << bits << ' ' << turn;
    }
  }
}

// Binary32's neighbours, ties between them, its subnormal numbers, and what is below those.
TEST(intervals, of_one_number_round_to_the_nearest_binary32_number) {
  Source source;
  int ties = 0, tiny = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto whole = static_cast<double>(static_cast<std::int64_t>(source.random()() >> (i % 2 == 0 ? 39 : 12)));
    const double number = std::ldexp(i % 3 == 0 ? -whole : whole, static_cast<int>(source.random()() % 150) - 172);
    const auto expected = static_cast<float>(number);
    ties += static_cast<double>(expected) != number && i % 2 == 0;
    tiny += std::fabs(number) < 0x1p-126;
    ASSERT_EQ(Interval(192, number).nearest_to_low(), expected) << number;
    ASSERT_EQ(Interval(192, number).nearest_to_high(), expected) << number;
  }
  EXPECT_GT(ties, 1000);
  EXPECT_GT(tiny, 1000);
}

MpfiVector mpfi_side(const Vertex& a, const Vertex& b) {
  return {Mpfi(b[0]) - Mpfi(a[0]), Mpfi(b[1]) - Mpfi(a[1]), Mpfi(b[2]) - Mpfi(a[2])};
}
Mpfi mpfi_dot(const MpfiVector& a, const MpfiVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// By the definition, with the angle between two sides by its cosine.
Normal normal_by_mpfi(const std::vector<TrianglePoints>& triangles) {
  MpfiVector sum{0, 0, 0};
  for (const TrianglePoints& t : triangles) {
    const MpfiVector u = mpfi_side(t[0], t[1]), v = mpfi_side(t[0], t[2]);
    const MpfiVector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Mpfi weight = acos(mpfi_dot(u, v) / sqrt(mpfi_dot(u, u) * mpfi_dot(v, v))) / sqrt(mpfi_dot(n, n));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * n[i];
  }
  const Mpfi length = sqrt(mpfi_dot(sum, sum));
  Normal normal{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Mpfi component = sum[i] / length;
    normal[i] = nearest_to_end(component, false);
    EXPECT_EQ(normal[i], nearest_to_end(component, true));
    if (normal[i] == 0) normal[i] = 0;
  }
  return normal;
}

void expect_the_same(const Normal& ours, const Normal& theirs, const std::string& where) {
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(ours[i], theirs[i]) << where << ' ' << i;
    ASSERT_FALSE(ours[i] == 0 && std::signbit(ours[i])) << where;
  }
}
void expect_the_same(const std::vector<TrianglePoints>& triangles, const std::string& where) {
  expect_the_same(normal_in_intervals(triangles), normal_by_mpfi(triangles), where);
}

// All triangles around each vertex, whatever binary64 leaves in doubt; and what comes of it, which binary64 mostly decides.
TEST(doubtful_normals, of_meshes_are_those_of_mpfi) {
  std::uint64_t decided = 0, doubtful = 0;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> small(-0.4F, 0.4F);
  const auto noise = [&](double, double) { return static_cast<double>(small(random)); };
  TriangleMesh far = icosphere(3, 0.01);
  for (Vertex& v : far.vertices) v = {v[0] + 9000, v[1] - 9000, v[2] + 9000};
  const auto steps = [](double x, double y) { return std::round(16 * std::sin(x) * std::cos(y)) / 16; };
  const auto tiny = [&](double, double) { return static_cast<double>(small(random)) * 1e-6; };
  for (const auto& [name, mesh] : std::map<std::string, TriangleMesh>{{"icosahedron", icosphere(1, 50)},
                                                                      {"sphere", icosphere(4, 31.5)},
                                                                      {"cube", cube(3)},
                                                                      {"grid", thin_wall(20, 20, 6, 6)},
                                                                      {"steps", height_map(20, 20, 16, 16, steps)},
                                                                      {"rough", height_map(20, 20, 12, 12, noise)},
                                                                      {"thin", height_map(20, 0.001, 12, 12, tiny)},
                                                                      {"far", far},
                                                                      {"torus", torus(20, 5, 16, 8)},
                                                                      {"needles", torus(5, 4.9, 60, 3)}}) {
    std::vector<std::vector<TrianglePoints>> around(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        around[t[k]].push_back({mesh.vertices[t[k]], mesh.vertices[t[(k + 1) % 3]], mesh.vertices[t[(k + 2) % 3]]});
    std::vector<Normal> expected;
    for (const std::vector<TrianglePoints>& triangles : around) {
      expected.push_back(normal_by_mpfi(triangles));
      expect_the_same(normal_in_intervals(triangles), expected.back(), name);
    }
    const ComputedNormals computed = corner_normals(std::get<CheckedMesh>(check_any(mesh)));
    decided += computed.stages.binary64;
    doubtful += computed.stages.intervals;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        expect_the_same(computed.normals[t][k], expected[mesh.triangles[t][k]], name + " " + std::to_string(t));
  }
  std::printf("  binary64 %llu, intervals %llu\n", static_cast<unsigned long long>(decided),
              static_cast<unsigned long long>(doubtful));
  EXPECT_GT(decided, 100U);
  EXPECT_GT(doubtful, 10U);
}

// Corners of a mesh: of any size that one may have, or on a coarse grid; the last bit of a coordinate is 2^-53 mm or more.
TEST(doubtful_normals, of_any_triangles_are_those_of_mpfi) {
  std::mt19937 random(5);
  int wide = 0, narrow = 0;
  for (int i = 0; i < 1500; ++i) {
    const bool is_coarse = random() % 2 == 0;
    const auto coordinate = [&]() -> float {
      const int sign = random() % 2 == 0 ? 1 : -1;
      if (is_coarse) return static_cast<float>(sign * static_cast<int>(random() % 3));
      return random() % 5 == 0 ? 0.0F
                               : static_cast<float>(sign) *
                                     std::ldexp(static_cast<float>(random() >> 8 | 1U), -20 - static_cast<int>(random() % 33));
    };
    const auto vertex = [&]() -> Vertex { return {coordinate(), coordinate(), coordinate()}; };
    const Vertex corner = vertex();
    std::vector<TrianglePoints> triangles;
    for (std::size_t count = 1 + random() % 6; triangles.size() < count;) {
      const TrianglePoints t{corner, vertex(), vertex()};
      if (!has_area(t)) continue;
      triangles.push_back(t);
      const MpfiVector u = mpfi_side(t[0], t[1]), v = mpfi_side(t[0], t[2]);
      ++(mpfi_dot(u, v) < 0 ? wide : narrow);
    }
    // Those that cancel in whole are in the next test.
    if (is_coarse)
      triangles.push_back(
          {corner, {corner[0] + 1, corner[1] + 0.5F, corner[2]}, {corner[0], corner[1] + 1, corner[2] + 0.25F}});
    expect_the_same(triangles, std::to_string(i));
  }
  EXPECT_GT(wide, 500);
  EXPECT_GT(narrow, 500);
}

// A triangle and the same turned over, whose far corner is moved by the last bit of a coordinate, or is not moved.
TEST(doubtful_normals, of_sums_that_nearly_cancel_are_those_of_mpfi_and_of_those_that_do_are_0) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> anywhere(-100, 100);
  for (int i = 0; i < 200; ++i) {
    const auto vertex = [&]() -> Vertex { return {anywhere(random), anywhere(random), anywhere(random)}; };
    const TrianglePoints t{vertex(), vertex(), vertex()};
    TrianglePoints turned{t[0], t[2], t[1]};
    if (i < 2) {
      EXPECT_EQ(normal_in_intervals({t, turned}), (Normal{0, 0, 0}));
    }
    float& moved = turned[1 + random() % 2][random() % 3];
    moved = std::nextafter(moved, 1000.0F);
    expect_the_same({t, turned}, std::to_string(i));
  }
}

// Two triangles leave a sum of some 2^-43, beside which the first bits do not resolve that the y of two others cancels.
TEST(doubtful_normals, that_the_first_bits_do_not_decide_are_those_of_mpfi) {
  const Vertex corner{0, 0, 0}, along_x{8192, 0, 0}, along_y{0, 8192, 0}, raised{8192, 0, 0x1p-30F};
  const Vertex one{3, 1, 2}, other{1, 5, -1};
  expect_the_same({{corner, along_x, along_y}, {corner, along_y, raised}, {corner, one, other}, {corner, other, one}}, "");
}

// At creases whose cosine is irrational, just below and just above the angle of two triangles: atan of 1/2, 1/3, ... there.
TEST(doubtful_normals, creases_are_decided_beside_the_angle) {
  for (const int k : {2, 3, 5, 7, 100, 1000000}) {
    const TrianglePoints flat{{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};
    const TrianglePoints turned{{{0, 1, 0}, {0, 0, 0}, {static_cast<float>(k), 0, 1}}};
    const Mpfi angle = atan(Mpfi(1) / k) * 45 / atan(Mpfi(1));  // in degrees
    const double below = mpfr_get_d(&angle.backend().data()->left, MPFR_RNDD), above = std::nextafter(below, 180.0);
    EXPECT_TRUE(turns_by_more(flat, turned, below)) << k;
    EXPECT_FALSE(turns_by_more(flat, turned, above)) << k;
  }
}

}  // namespace
}  // namespace forceshade::mesh
