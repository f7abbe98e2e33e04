// SPDX-License-Identifier: BSD-3-Clause
// A batch's forms leave doubtful positions to the later stages (fast/simd/form.inl), and no more: on the surface, beside it, at
// tiny coordinates, and for the cylinders around the axis. No answer shows it, since the later stages are right everywhere.

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "fast/simd/batch.h"
#include "forceshade/fast.h"

namespace forceshade::fast {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};
constexpr double kR = 15.24F, kHalf = 12.7F;                   // mm
const double kDepth = std::sqrt((kR - kHalf) * (kR + kHalf));  // mm: of the axis below the plane

// Returns true if a block is answered that has this position in one place.
template <class Definition>
bool answers(float x, float z) {
  const Built<Definition> law(kBump);
  const auto* const block = static_cast<const BlockOf<Definition>*>(
#if FORCESHADE_HAS_VECTOR_SETS
      best_instruction_set() == InstructionSet::avx512 ? &kAvx512Blocks : &kAvx2Blocks
#else
      static_cast<const BlockTable*>(nullptr)
#endif
  );
  std::vector<float> all_x(kStep, 1.1F), all_z(kStep, -0.7F), fx(kStep), fz(kStep);
  all_x[3] = x;
  all_z[3] = z;
  return block->answer(law.definition, kStep, all_x.data(), all_z.data(), fx.data(), fz.data());
}

class batch_doubt : public testing::Test {
 protected:
  void SetUp() override {
    if (best_instruction_set() == InstructionSet::scalar) GTEST_SKIP() << "this processor or build has no vectors";
  }
};

TEST_F(batch_doubt, is_none_away_from_surfaces) {
  for (const float x : {0.0F, 0.5F, 5.0F, -12.0F, 14.0F})
    for (const float z : {-1.5F, 0.0F, 9.0F}) {
      EXPECT_TRUE(answers<Wall>(x, z));
      EXPECT_TRUE(answers<Bump1p>(x, z));
      EXPECT_TRUE(answers<Bump1pShaded>(x, z));
      EXPECT_TRUE(answers<Bump2p>(x, z));
      EXPECT_TRUE(answers<Bump2pShaded>(x, z));
      EXPECT_TRUE(answers<Bump3p>(x, z));
      EXPECT_TRUE(answers<Bump3pShaded>(x, z));
      EXPECT_TRUE(answers<Cylinder>(x, z));
      EXPECT_TRUE(answers<BumpCylinder>(x, z));
    }
}

// h(1 - 2|x|/w), h = R - d, and on the flat top h′: a relative distance of 2^-21 of the height is left, one of 2^-19 not.
TEST_F(batch_doubt, is_on_the_surface_of_a_polygon) {
  const double h = kR - kDepth, x = 3.7F, on_side = h * (1 - x / kHalf);
  const double c = kR * std::sin(std::asin(kHalf / kR) / 3);  // w′/2
  const double h_top = std::sqrt(kR * kR - c * c) - kDepth;
  for (const double sign : {1.0, -1.0}) {
    const auto beside = [&](double surface, double height, double share) {
      return static_cast<float>(surface + sign * share * height);
    };
    EXPECT_FALSE(answers<Bump2p>(3.7F, beside(on_side, h, 0x1p-22)));
    EXPECT_TRUE(answers<Bump2p>(3.7F, beside(on_side, h, 0x1p-18)));
    EXPECT_FALSE(answers<Bump2pShaded>(3.7F, beside(on_side, h, 0x1p-22)));
    EXPECT_FALSE(answers<Bump3p>(0.5F, beside(h_top, h_top, 0x1p-22)));
    EXPECT_TRUE(answers<Bump3p>(0.5F, beside(h_top, h_top, 0x1p-18)));
    EXPECT_FALSE(answers<Bump3pShaded>(0.5F, beside(h_top, h_top, 0x1p-22)));
  }
}

TEST_F(batch_doubt, is_on_the_surface_of_a_cylinder_and_around_its_axis) {
  const double x = 3.7F, surface = std::sqrt(kR * kR - x * x) - kDepth;
  const auto near_axis = static_cast<float>(-kDepth);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(answers<Cylinder>(3.7F, static_cast<float>(surface)));
    EXPECT_FALSE(answers<BumpCylinder>(3.7F, static_cast<float>(surface)));
    EXPECT_TRUE(answers<Cylinder>(3.7F, static_cast<float>(surface + sign * 1e-4)));
    EXPECT_FALSE(answers<Cylinder>(2, near_axis + static_cast<float>(sign * 5.6)));
    EXPECT_TRUE(answers<Cylinder>(2, near_axis + static_cast<float>(sign * 5.9)));
    EXPECT_EQ(answers<BumpCylinder>(2, near_axis + static_cast<float>(sign * 5.9)), sign > 0)
        << "below the axis the forces oppose";
  }
  EXPECT_FALSE(answers<Cylinder>(9, near_axis)) << "where z + d cancels, off the axis";
  EXPECT_TRUE(answers<Cylinder>(9, std::nextafter(near_axis, 0.0F)));
}

TEST_F(batch_doubt, is_at_tiny_coordinates) {
  for (const float sign : {1.0F, -1.0F}) {
    const float below = sign * 0x1p-31F, inexact = sign * 0x1p-26F;
    EXPECT_TRUE(answers<Wall>(below, -1)) << "the wall's force does not depend on x";
    EXPECT_FALSE(answers<Wall>(1, below));
    EXPECT_FALSE(answers<Bump1pShaded>(below, -1));
    EXPECT_FALSE(answers<Bump1pShaded>(1, below));
    EXPECT_FALSE(answers<Bump2p>(inexact, -1)) << "w/2 - |x| is rounded";
    EXPECT_TRUE(answers<Bump2p>(sign * 0x1p-24F, -1));
    EXPECT_FALSE(answers<Bump3p>(inexact, -1));
    EXPECT_FALSE(answers<Cylinder>(inexact, 2));
    EXPECT_FALSE(answers<Cylinder>(2, inexact)) << "z + 2d is rounded";
    EXPECT_TRUE(answers<Cylinder>(2, sign * 0x1p-23F));
  }
}

}  // namespace
}  // namespace forceshade::fast
