// SPDX-License-Identifier: BSD-3-Clause
// Vertices at their places in a scene, against the product q a q* of quaternions in rational numbers: each coordinate is
// rounded once.

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <random>

#include "rendering/meshes/placement.h"

namespace forceshade::mesh {
namespace {

using Quaternion = std::array<mpq_class, 4>;  // w, x, y, z

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {mpq_class(a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]),
          mpq_class(a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]),
          mpq_class(a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]),
          mpq_class(a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])};
}

float kept(float length) {
  return std::fabs(length) < 0x1p-30F ? 0.0F : length;
}

// The exact place of a vertex.
std::array<mpq_class, 3> exact(const Vertex& a, const scene::Pose& placement) {
  Quaternion q, conjugate;
  mpq_class squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = placement.rotation[i];
    conjugate[i] = i == 0 ? q[i] : mpq_class(-q[i]);
    squares += q[i] * q[i];
  }
  const Quaternion turned = product(product(q, {0, mpq_class(a[0]), mpq_class(a[1]), mpq_class(a[2])}), conjugate);
  std::array<mpq_class, 3> place;
  for (std::size_t i = 0; i < 3; ++i) place[i] = turned[i + 1] / squares + mpq_class(kept(placement.translation[i]));
  return place;
}

// The binary32 number nearest to it, ties to even; 0 below 2^-30 in size.
float nearest(const mpq_class& number) {
  // 300 bits rounded to odd, then to 24, are as one rounding: what is left out is a bit that is set.
  mpfr_t wide;
  mpfr_init2(wide, 300);
  if (mpfr_set_q(wide, number.get_mpq_t(), MPFR_RNDZ) != 0 && mpfr_min_prec(wide) < 300)
    mpfr_sgn(wide) > 0 ? mpfr_nextabove(wide) : mpfr_nextbelow(wide);
  const float result = mpfr_get_flt(wide, MPFR_RNDN);
  mpfr_clear(wide);
  return kept(result);
}

bool are_the_same(const Vertex& a, const Vertex& b) {
  return std::bit_cast<std::array<std::uint32_t, 3>>(a) == std::bit_cast<std::array<std::uint32_t, 3>>(b);
}

class Draw {
 public:
  // A number of any size between two powers of two, of either sign, and now and then 0.
  float number(int low, int high) {
    if (random_() % 8 == 0) return 0;
    const auto exponent = low + static_cast<int>(random_() % static_cast<unsigned>(high - low));
    const float size = std::ldexp(static_cast<float>((1U << 23) + random_() % (1U << 23)), exponent - 23);
    return random_() % 2 == 0 ? size : -size;
  }
  // Components of about one size or of any: both that they all count and that some are too small to do so.
  scene::Pose placement() {
    scene::Pose placement;
    const int low = random_() % 2 == 0 ? -30 : -2;
    do
      for (float& component : placement.rotation) component = number(low, 1);
    while (placement.rotation == std::array<float, 4>{});
    for (float& component : placement.translation) component = random_() % 4 == 0 ? 0 : number(-40, 13);
    return placement;
  }
  Vertex vertex() { return {number(-30, 13), number(-30, 13), number(-30, 13)}; }

 private:
  std::mt19937_64 random_{23};
};

TEST(mesh_placement, rounds_the_exact_place_once) {
  Draw draw;
  int zeros = 0, moved = 0;
  for (int i = 0; i < 20000; ++i) {
    const scene::Pose placement = draw.placement();
    const Vertex a = draw.vertex(), got = placed({a}, placement).front();
    const std::array<mpq_class, 3> place = exact(a, placement);
    const Vertex expected{nearest(place[0]), nearest(place[1]), nearest(place[2])};
    ASSERT_TRUE(are_the_same(got, expected))
        << got[0] << ' ' << got[1] << ' ' << got[2] << ", expected " << expected[0] << ' ' << expected[1] << ' ' << expected[2];
    for (const float x : got) zeros += x == 0 ? 1 : 0;
    moved += got == a ? 0 : 1;
  }
  EXPECT_GT(zeros, 100);
  EXPECT_GT(moved, 15000);
}

TEST(mesh_placement, rounds_ties_to_even_and_what_is_beside_them_to_its_side) {
  const auto x_of = [](float a, std::array<float, 4> rotation, float shift) {
    return placed({{a, 0, 0}}, {{shift, 0, 0}, rotation}).front()[0];
  };
  EXPECT_EQ(x_of(1, {1, 0, 0, 0}, 0x1p-24F), 1.0F);
  EXPECT_EQ(x_of(-1, {1, 0, 0, 0}, -0x1p-24F), -1.0F);
  EXPECT_EQ(x_of(0x1.000002p0F, {1, 0, 0, 0}, 0x1p-24F), 0x1.000004p0F);
  EXPECT_EQ(x_of(1, {1, 0, 0, 0}, 0x1.000002p-24F), 0x1.000002p0F);
  // A half turn and a quarter of 3:4:5, whose cosine is 3/5: 5/8 of it is 3/8, and the tie is reached over a division.
  EXPECT_EQ(x_of(5, {2, 0, 0, 1}, 0), 3.0F);
  EXPECT_EQ(x_of(5 * 0x1p-24F, {2, 0, 0, 1}, 4), 4.0F) << "3/8 of the last place above 4";
  EXPECT_EQ(x_of(5 * 0x1p-22F, {2, 0, 0, 1}, 4), 0x1.000004p2F) << "3/2 of it: a tie, whose even neighbour is above";
  // A size below 2^-30 becomes 0, without a sign.
  EXPECT_EQ(x_of(1, {1, 0, 0, 0}, -0x1.fffffep-1F), 0x1p-24F);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(x_of(-0x1p-30F, {2, 0, 0, 1}, 0)), 0U) << "3/5 of -2^-30";
  EXPECT_EQ(std::bit_cast<std::uint32_t>(x_of(0, {0, 1, 0, 0}, 0)), 0U);
  EXPECT_EQ(x_of(-0x1p-30F, {0, 1, 0, 0}, 0), -0x1p-30F);
  EXPECT_EQ(x_of(0, {1, 0, 0, 0}, 0x1p-31F), 0.0F) << "as every coordinate";
  EXPECT_EQ(x_of(0x1p-30F, {1, 0, 0, 0}, 0x1p-149F), 0x1p-30F);
}

TEST(mesh_placement, keeps_the_bits_of_what_is_not_moved) {
  Draw draw;
  for (int i = 0; i < 2000; ++i) {
    const Vertex a = draw.vertex();
    for (const float w : {1.0F, -1.0F, 0.7F, 2.0F, 0x1p-30F})
      EXPECT_TRUE(are_the_same(placed({a}, {{}, {w, 0, 0, 0}}).front(), a));
  }
}

TEST(mesh_placement, turns_the_bits_by_quarter_turns) {
  Draw draw;
  for (int i = 0; i < 2000; ++i) {
    const Vertex a = draw.vertex();
    const auto negated = [](float x) { return x == 0 ? 0.0F : -x; };
    const Vertex about_z{negated(a[1]), a[0], a[2]}, about_x{a[0], negated(a[2]), a[1]}, about_y{a[2], a[1], negated(a[0])};
    const Vertex half{a[0], negated(a[1]), negated(a[2])}, third{a[2], a[0], a[1]};
    for (const float s : {1.0F, -1.0F, 0.3F}) {
      EXPECT_TRUE(are_the_same(placed({a}, {{}, {s, 0, 0, s}}).front(), about_z));
      EXPECT_TRUE(are_the_same(placed({a}, {{}, {s, s, 0, 0}}).front(), about_x));
      EXPECT_TRUE(are_the_same(placed({a}, {{}, {s, 0, s, 0}}).front(), about_y));
      EXPECT_TRUE(are_the_same(placed({a}, {{}, {0, s, 0, 0}}).front(), half));
      EXPECT_TRUE(are_the_same(placed({a}, {{}, {s, s, s, s}}).front(), third));
    }
    EXPECT_TRUE(are_the_same(placed({about_z}, {{}, {1, 0, 0, -1}}).front(), a)) << "the conjugate turns back";
  }
}

TEST(mesh_placement, keeps_distances_and_handedness_up_to_rounding) {
  Draw draw;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vertex> before;
    for (int k = 0; k < 4; ++k) before.push_back({draw.number(5, 12), draw.number(5, 12), draw.number(5, 12)});
    const scene::Pose turn{{draw.number(5, 10), 0, 3}, draw.placement().rotation};
    const std::vector<Vertex> after = placed(before, turn);
    const auto side = [](const std::vector<Vertex>& of, std::size_t k) {
      std::array<double, 3> side;
      for (std::size_t axis = 0; axis < 3; ++axis) side[axis] = double{of[k][axis]} - double{of[0][axis]};
      return side;
    };
    const auto length = [&](const std::vector<Vertex>& of, std::size_t k) {
      const auto [x, y, z] = side(of, k);
      return std::hypot(x, y, z);
    };
    const auto volume = [&](const std::vector<Vertex>& of) {
      const auto a = side(of, 1), b = side(of, 2), c = side(of, 3);
      return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    };
    for (std::size_t k = 1; k < 4; ++k) worst = std::max(worst, std::fabs(length(after, k) - length(before, k)));
    // Sides are below 2^14 mm, and each changes by at most 2^-10 mm.
    ASSERT_NEAR(volume(after), volume(before), 3 * 0x1p28 * 0x1p-10);
  }
  // Two ends, each coordinate of which is below 2^13 mm and so moves by at most 2^-12 mm.
  EXPECT_LE(worst, 2 * std::sqrt(3.0) * 0x1p-12);
  EXPECT_GE(worst, 0x1p-13) << "the bound is not reached by far";
  std::printf("worst change of a distance: %.3g mm\n", worst);
}

TEST(mesh_placement, has_components_of_rotations_and_translations) {
  for (const float good : {0.0F, -0.0F, 0x1p-30F, -0x1p-30F, 2.0F, -2.0F, 0.1F}) EXPECT_TRUE(is_of_rotation(good)) << good;
  for (const float bad : {0x1.fffffep-31F, -0x1.fffffep-31F, 0x1.000002p1F, HUGE_VALF, NAN})
    EXPECT_FALSE(is_of_rotation(bad)) << bad;
  for (const float good : {0.0F, 1e4F, -1e4F, 0x1p-149F}) EXPECT_TRUE(is_of_translation(good)) << good;
  for (const float bad : {std::nextafter(1e4F, 2e4F), -HUGE_VALF, NAN}) EXPECT_FALSE(is_of_translation(bad)) << bad;
}

}  // namespace
}  // namespace forceshade::mesh
