// SPDX-License-Identifier: BSD-3-Clause
// The rounding of the reference god-object: fractions and roots to binary32, points of the surface to the grid.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "reference/meshes/points.h"
#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;

std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

// over / under · 2^exponent with 23 digits more than binary32 has is exact in binary64, which the machine rounds.
TEST(mesh_rounding, fractions_round_as_binary64_does_to_binary32) {
  std::mt19937_64 random(1);
  int ties = 0, subnormal = 0, zeros = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto odd = static_cast<std::int64_t>(random() % 9) - 4;  // near a tie, on it, or far from one
    const auto digits = static_cast<std::int64_t>(random() >> (40 + random() % 24)) * (1 << 20) + (random() % 2 << 19) + odd;
    const int exponent = static_cast<int>(random() % 240) - 175;
    const std::int64_t factor = 1 + static_cast<std::int64_t>(random() % 1000), sign = random() % 2 == 0 ? 1 : -1;
    const double exact = std::ldexp(static_cast<double>(sign * digits), exponent);
    const float expected = static_cast<float>(exact) + 0.0F;
    const float rounded = nearest_binary32({Integer(sign * digits) * factor, factor}, exponent);
    ASSERT_EQ(bits(rounded), bits(expected)) << std::hexfloat << exact;
    zeros += expected == 0 && digits != 0;
    subnormal += expected != 0 && std::fabs(expected) < 0x1p-126F;
    const double off = std::fabs(exact - static_cast<double>(expected));
    ties += off != 0 &&
            off == std::fabs(exact - static_cast<double>(std::nextafter(expected, exact > expected ? HUGE_VALF : -HUGE_VALF)));
  }
  std::printf("  %d ties, %d subnormal, %d to zero\n", ties, subnormal, zeros);
  EXPECT_GT(ties, 0);
  EXPECT_GT(subnormal, 0);
  EXPECT_GT(zeros, 0);
}

// IEEE 754 rounds a square root correctly.
TEST(mesh_rounding, roots_of_binary32_round_as_the_machine_does) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random() % 0x7f800000U));
    // value = over · 4^-75 · 2^0: 149 is odd, so once more.
    ASSERT_EQ(bits(nearest_binary32_root({integer_of(value, 150), 1}, -75)), bits(std::sqrt(value))) << std::hexfloat << value;
    ASSERT_EQ(bits(nearest_binary32_root({integer_of(value, 150) * 49, 49}, -75)), bits(std::sqrt(value)))
        << std::hexfloat << value;
  }
}

TEST(mesh_rounding, roots_on_a_tie_go_to_even_and_beside_it_to_their_side) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto below = std::bit_cast<float>(0x00000001U + static_cast<std::uint32_t>(random() % 0x6fffffffU));
    const float above = std::nextafter(below, HUGE_VALF), even = bits(below) % 2 == 0 ? below : above;
    const Integer tie = integer_of(below, 149) + integer_of(above, 149);  // times 2^150
    const Integer square = tie * tie;
    ASSERT_EQ(nearest_binary32_root({square, 1}, -150), even) << std::hexfloat << below;
    ASSERT_EQ(nearest_binary32_root({square - 1, 1}, -150), below) << std::hexfloat << below;
    ASSERT_EQ(nearest_binary32_root({square + 1, 1}, -150), above) << std::hexfloat << below;
    ASSERT_EQ(nearest_binary32({tie, 1}, -150), even);
    ASSERT_EQ(nearest_binary32({-tie, 1}, -150), -even);
  }
}

// A root of a square makes the sum a fraction, here a tie; one more or less takes it off. The root takes away nearly all of the
// rest, little of it, or more than it.
TEST(mesh_rounding, a_fraction_plus_a_root_rounds_as_their_sum) {
  std::mt19937_64 random(4);
  int to_even = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<float>(0x00000001U + static_cast<std::uint32_t>(random() % 0x6fffffffU));
    const float above = std::nextafter(value, HUGE_VALF);
    const Integer tie = integer_of(value, 149) + integer_of(above, 149);  // times 2^150
    const Integer sign = random() % 2 == 0 ? 1 : -1, under = 1 + random() % 1000;
    const Integer root = Integer(1 + random()) << static_cast<unsigned>(random() % 300);
    const bool is_negative = random() % 2 == 0;
    const RootSum on_tie{(sign * tie) * under + (is_negative ? root : Integer(-root)), is_negative, root * root, under, -150};
    const auto beside = [&](int off) {
      RootSum sum = on_tie;
      sum.square += off;
      return static_cast<float>(sign.convert_to<int>()) * nearest_binary32(sum);
    };
    const float even = bits(value) % 2 == 0 ? value : above;
    const bool grows = is_negative == (sign < 0);  // in size, with the root
    ASSERT_EQ(beside(0), even) << std::hexfloat << value;
    ASSERT_EQ(beside(1), grows ? above : value) << std::hexfloat << value;
    ASSERT_EQ(beside(-1), grows ? value : above) << std::hexfloat << value;
    ASSERT_EQ(compared(on_tie, sign * tie, Integer(1) << 150U), 0);
    to_even += beside(0) != beside(1);
  }
  EXPECT_GT(to_even, 0);
  EXPECT_EQ(bits(nearest_binary32(RootSum{7, true, 49, 3, -10})), 0U);
  EXPECT_EQ(bits(nearest_binary32(RootSum{7, true, 50, 3, -400})), 0U);
  EXPECT_EQ(bits(nearest_binary32(RootSum{3, true, 8, 1, -149})), 0U) << "0.17 of the smallest number";
  EXPECT_EQ(bits(nearest_binary32(RootSum{3, true, 5, 1, -149})), 1U) << "0.76 of it";
}

TEST(mesh_rounding, integers_of_binary32_are_exact) {
  for (const float value : {0.0F, 1.0F, -1.0F, 0.75F, -1000.0F, 0x1.fffffep-30F, -0x1p-53F, 3.0F})
    EXPECT_EQ(integer_of(value, 77), Integer(static_cast<std::int64_t>(std::ldexp(value, 53))) << 24);
  EXPECT_EQ(exact_coordinate(-0x1.fffffep-31F), 0);
  EXPECT_EQ(exact_coordinate(0x1p-30F), Integer(1) << 47);
  EXPECT_EQ(exact_coordinate(-0x1p-30F), -(Integer(1) << 47));
}

// The triangle (0,0,0), (1,0,0), (0,1,0), with k and l along x and y.
const Surface& plain() {
  static const Surface surface(mesh::TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  return surface;
}

// Parameters in eighths of a grid step.
SurfacePoint inside(std::int64_t k, std::int64_t l) {
  return {{Place::triangle, 0}, {Fraction{k, std::int64_t{8} * kGrid}, Fraction{l, std::int64_t{8} * kGrid}}};
}
SurfacePoint on_first_edge(std::int64_t m) {
  return {{Place::edge, 0}, {Fraction{m, std::int64_t{8} * kGrid}, {}}};
}

std::array<std::uint32_t, 2> towards(const SurfacePoint& point, float x, float y) {
  return rounded_towards(plain(), point, exact_point({x, y, 0})).parameter;
}

using Pair = std::array<std::uint32_t, 2>;

TEST(mesh_rounding, a_point_that_is_met_goes_to_a_corner_of_its_own_grid_cell) {
  // In the lower half of the cell (5, 6): the corners (5, 6), (6, 6), (5, 7).
  EXPECT_EQ(towards(inside(41, 49), 0, 0), (Pair{5, 6}));
  EXPECT_EQ(towards(inside(41, 49), 1, 0), (Pair{6, 6}));
  EXPECT_EQ(towards(inside(41, 49), 0, 1), (Pair{5, 7}));
  // In the upper half: (6, 7), (6, 6), (5, 7).
  EXPECT_EQ(towards(inside(47, 54), 1, 1), (Pair{6, 7}));
  EXPECT_EQ(towards(inside(47, 54), 1, 0), (Pair{6, 6}));
  EXPECT_EQ(towards(inside(47, 54), 0, 1), (Pair{5, 7}));
  // On a line of the grid: its ends, wherever p is.
  EXPECT_EQ(towards(inside(40, 49), 1, 1), (Pair{5, 7}));
  EXPECT_EQ(towards(inside(40, 49), 1, 0), (Pair{5, 6}));
  EXPECT_EQ(towards(inside(41, 48), 0, 1), (Pair{5, 6}));
  EXPECT_EQ(towards(inside(41, 48), 1, 0), (Pair{6, 6}));
  EXPECT_EQ(towards(inside(41, 55), 0, 0.25F), (Pair{5, 7}));
  EXPECT_EQ(towards(inside(41, 55), 0.25F, 0), (Pair{6, 6}));
  // A point of the grid stays.
  EXPECT_EQ(towards(inside(40, 48), 1, 1), (Pair{5, 6}));
  // On the diagonal through p both ends are as near: the smaller k. From the upper half (6, 6) and (5, 7) are as near too.
  EXPECT_EQ(towards(inside(44, 52), 0.5F, 0.5F + 0x1p-24F), (Pair{5, 7}));
  EXPECT_EQ(towards(inside(47, 54), 0, 0x1p-24F), (Pair{5, 7}));
}

TEST(mesh_rounding, a_point_that_is_met_on_an_edge_goes_to_a_neighbour_and_may_become_a_vertex) {
  EXPECT_EQ(towards(on_first_edge(41), 1, 0), (Pair{6, 0}));
  EXPECT_EQ(towards(on_first_edge(47), 0, 0), (Pair{5, 0}));
  EXPECT_EQ(towards(on_first_edge(44), 0x1.6p-22F, 0), (Pair{5, 0})) << "equally near: the lower";
  EXPECT_EQ(towards(on_first_edge(48), 0, 0), (Pair{6, 0}));
  const GridPoint first = rounded_towards(plain(), on_first_edge(3), exact_point({-1, 0, 0}));
  EXPECT_EQ(first.feature, (Feature{Place::vertex, 0}));
  const GridPoint last = rounded_towards(plain(), on_first_edge(std::int64_t{8} * kGrid - 3), exact_point({2, 0, 0}));
  EXPECT_EQ(last.feature, (Feature{Place::vertex, 1}));
  const GridPoint hypotenuse =
      rounded_towards(plain(), inside(std::int64_t{4} * kGrid - 1, std::int64_t{4} * kGrid), exact_point({1, 1, 0}));
  EXPECT_EQ(hypotenuse.feature.place, Place::edge);
}

TEST(mesh_rounding, a_rest_goes_to_the_nearest_grid_point_but_stays_inside_its_feature) {
  const auto of = [](const SurfacePoint& point) { return rounded_inside(point).parameter; };
  constexpr std::int64_t kWhole = std::int64_t{8} * kGrid;
  EXPECT_EQ(of(inside(43, 53)), (Pair{5, 7}));
  EXPECT_EQ(of(inside(44, 52)), (Pair{6, 6})) << "ties to even";
  EXPECT_EQ(of(inside(1, 50)), (Pair{1, 6}));
  EXPECT_EQ(of(inside(50, 1)), (Pair{6, 1}));
  EXPECT_EQ(of(inside(kWhole / 2 - 2, kWhole / 2 - 2)), (Pair{kGrid / 2 - 1, kGrid / 2}))
      << "k is lowered where both are equal";
  EXPECT_EQ(of(inside(kWhole - 16, 14)), (Pair{kGrid - 3, 2})) << "k is the larger";
  EXPECT_EQ(of(inside(14, kWhole - 16)), (Pair{2, kGrid - 3})) << "l is the larger";
  EXPECT_EQ(of(on_first_edge(1)), (Pair{1, 0}));
  EXPECT_EQ(of(on_first_edge(kWhole - 1)), (Pair{kGrid - 1, 0}));
  EXPECT_EQ(of(on_first_edge(52)), (Pair{6, 0})) << "ties to even";
}

}  // namespace
}  // namespace forceshade::reference::meshes
