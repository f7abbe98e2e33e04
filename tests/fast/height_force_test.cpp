// SPDX-License-Identifier: BSD-3-Clause
// From a jet and its errors to a force: an answer is that of all jets within the errors. The stiffness is chosen so that one of
// these jets has a component on a tie, or next to it, where each part of the bound counts.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "fast/heights/force.h"
#include "tests/support/multiprecision.h"

namespace forceshade::fast {
namespace {

using height::Mode;
using tests::Multiprecision;

// Exact numbers.
struct ExactJet {
  Multiprecision gap, Ux, Uy;

  std::array<Multiprecision, 3> force(Mode mode, double K) const {
    Multiprecision M = K * gap;
    if (mode != Mode::conservative) M /= sqrt(1 + Ux * Ux + Uy * Uy);
    return {-M * Ux, -M * Uy, M};
  }
};

// A number and how far the exact one may be from it.
struct Blurred {
  double value, error;
};

// The middle and the eight corners.
std::vector<ExactJet> members(const Multiprecision& gap, double gap_error, const Blurred& Ux, const Blurred& Uy) {
  std::vector<ExactJet> all{{gap, Ux.value, Uy.value}};
  for (const int g : {-1, 1})
    for (const int x : {-1, 1})
      for (const int y : {-1, 1})
        all.push_back({gap + g * Multiprecision(gap_error), Ux.value + x * Multiprecision(Ux.error),
                       Uy.value + y * Multiprecision(Uy.error)});
  return all;
}

bool rounds_to(const Multiprecision& number, float answer) {
  const auto tie_beside = [&](float end) {
    return Multiprecision(0.5 * (static_cast<double>(answer) + static_cast<double>(std::nextafter(answer, end))));
  };
  const bool is_even = (__builtin_bit_cast(unsigned, answer) & 1U) == 0;
  const Multiprecision up = tie_beside(HUGE_VALF), down = tie_beside(-HUGE_VALF);
  return is_even ? number >= down && number <= up : number > down && number < up;
}

class HeightForceBounds : public ::testing::Test {
 protected:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  double uniform() { return std::uniform_real_distribution<double>(1, 2)(random_); }
  double either_sign(double size) { return pick(2) == 0 ? size : -size; }
  Mode mode() { return height::kModes[static_cast<std::size_t>(pick(3))].mode; }

  // The stiffness that makes a component of a member a tie, but for 2^-50 of it, or now and then 2^-20.
  double stiffness_for(const ExactJet& jet, Mode mode, std::size_t axis, double tie) {
    const Multiprecision component = abs(jet.force(mode, 1)[axis]);
    if (component == 0) return 0;
    const auto exact = static_cast<double>(Multiprecision(tie / component));
    return exact * (1 + std::ldexp(pick(9) - 4, pick(4) == 0 ? -23 : -53));
  }
  double any_tie(int exponent) {
    const auto number = static_cast<float>(std::ldexp(uniform(), exponent));
    return 0.5 * (static_cast<double>(number) + static_cast<double>(std::nextafter(number, HUGE_VALF)));
  }

  void check(const HeightForce& answer, const std::vector<ExactJet>& all, Mode mode, double K) {
    ++answers_[static_cast<std::size_t>(answer.contact)];
    if (answer.contact == Sign::unknown) return;
    const std::array<float, 3> components{answer.x, answer.y, answer.z};
    for (const ExactJet& jet : all) {
      ASSERT_EQ(answer.contact == Sign::positive, jet.gap > 0) << jet.gap.str(30);
      if (answer.contact != Sign::positive) continue;
      const auto force = jet.force(mode, K);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(rounds_to(force[axis], components[axis]))
            << "axis " << axis << ": " << components[axis] << " for " << force[axis].str(30) << ", gap " << jet.gap.str(20)
            << ", slopes " << jet.Ux.str(20) << ' ' << jet.Uy.str(20) << ", mode " << static_cast<int>(mode);
    }
  }

  std::mt19937_64 random_{41};
  std::array<int, 4> answers_{};
};

TEST_F(HeightForceBounds, hold_beside_ties) {
  for (int i = 0; i < 30000; ++i) {
    const auto slope = [&]() -> Blurred {
      const double value = pick(4) == 0 ? pick(5) - 2 : either_sign(std::ldexp(uniform(), pick(12) - 8));
      return {value, pick(3) == 0 ? 0 : std::ldexp(uniform(), std::ilogb(value + (value == 0)) - 26 - pick(30))};
    };
    Blurred Ux = slope(), Uy = slope();
    if (pick(3) == 0) Uy = {0, 0};
    const auto z = static_cast<double>(static_cast<float>(-std::ldexp(uniform(), pick(8) - 4)));
    const double U = pick(3) == 0 ? 0 : std::ldexp(uniform(), pick(8) - 6);
    const double gap_error = pick(2) == 0 ? 0 : std::ldexp(uniform(), std::ilogb(z) - 26 - pick(30));
    const auto all = members(Multiprecision(U) - z, gap_error, Ux, Uy);
    const Mode how = mode();
    const ExactJet& aim = all[static_cast<std::size_t>(pick(9))];
    const auto axis = static_cast<std::size_t>(pick(3));
    const double K = stiffness_for(
        aim, how, axis, any_tie(std::ilogb(static_cast<double>(abs(aim.force(how, 1)[axis])) + 0x1p-99) + pick(9) - 4));
    if (K == 0) continue;
    const Jet<DoubleWithError> jet{{U, gap_error}, {Ux.value, Ux.error}, {Uy.value, Uy.error}};
    check(height_force(jet, how, K, z), all, how, K);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(answers_[static_cast<std::size_t>(Sign::positive)], 1000);
  EXPECT_GT(answers_[static_cast<std::size_t>(Sign::unknown)], 1000);
}

// Slopes that may be 0, and forces that may be the smallest binary32 or none.
TEST_F(HeightForceBounds, hold_where_errors_are_as_large_as_slopes) {
  for (int i = 0; i < 30000; ++i) {
    const auto slope = [&]() -> Blurred {
      const double value = pick(3) == 0 ? 0 : either_sign(uniform());
      return {value, pick(4) == 0 ? 0 : std::ldexp(uniform(), -pick(8))};
    };
    Blurred Ux = slope(), Uy = slope();
    const double gap = pick(2) == 0 ? 1 : uniform();
    const double gap_error = pick(2) == 0 ? 0 : std::ldexp(pick(2) == 0 ? 1 : uniform(), -1 - pick(8));
    // Steep, so that F_z is too small for binary32 beside F_x and F_y that may not be; or all of them level and small.
    const double slopes = std::ldexp(1.0, pick(2) == 0 ? -50 : 1 + pick(7)), gaps = slopes < 1 ? 0x1p-100 : 0x1p-155;
    const auto scaled = [&](const Blurred& a) -> Blurred { return {a.value * slopes, a.error * slopes}; };
    Ux = scaled(Ux);
    Uy = scaled(Uy);
    const auto all = members(gap * gaps, gap_error * gaps, Ux, Uy);
    const Mode how = mode();
    const double K = stiffness_for(all[static_cast<std::size_t>(pick(9))], how, static_cast<std::size_t>(pick(2)),
                                   0x1p-150 * (pick(3) == 0 ? 3 : 1));
    if (K == 0) continue;
    const Jet<DoubleWithError> jet{{gap * gaps, gap_error * gaps}, {Ux.value, Ux.error}, {Uy.value, Uy.error}};
    check(height_force(jet, how, K, 0), all, how, K);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(answers_[static_cast<std::size_t>(Sign::positive)], 100);
  EXPECT_GT(answers_[static_cast<std::size_t>(Sign::unknown)], 1000);
}

// Over level ground a force may be a tie, but the gap must not have been rounded to one.
TEST_F(HeightForceBounds, tell_a_tie_from_a_gap_that_was_rounded_to_it) {
  const double z = -0x1.000002p-30, tie = 1 + 0x1p-24;
  for (const double K : {1.0, 2.0, 0.5}) {
    const auto contact = [&](double U) { return height_force({{U, 0}, {0, 0}, {0, 0}}, Mode::true_height, K, z).contact; };
    EXPECT_EQ(contact(tie - 0x1p-30), Sign::unknown) << "rounded: the gap is 2^-53 more";
    EXPECT_EQ(contact(tie - 0x1.000002p-30 + 0x1p-24), Sign::positive);
  }
  EXPECT_EQ(height_force({{1, 0}, {0, 0}, {0, 0}}, Mode::true_height, 1, -0x1p-24).z, 1) << "a tie, to even";
}

// A gap that is rounded, and an error next to it.
TEST_F(HeightForceBounds, hold_beside_the_surface) {
  for (int i = 0; i < 20000; ++i) {
    const double z = either_sign(static_cast<double>(static_cast<float>(uniform())));
    const double U =
        pick(2) == 0 ? z + either_sign(std::ldexp(uniform(), -pick(53))) : either_sign(std::ldexp(uniform(), pick(6) - 3));
    const double error = std::fabs(U - z) * (1 + std::ldexp(pick(33) - 16, -52 + (pick(2) == 0 ? 0 : pick(33))));
    const auto all = members(Multiprecision(U) - z, error, {0, 0}, {0, 0});
    check(height_force(Jet<DoubleWithError>{{U, error}, {0, 0}, {0, 0}}, Mode::true_height, 0x1p-126, z), all,
          Mode::true_height, 0x1p-126);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(answers_[static_cast<std::size_t>(Sign::negative)], 100);
  EXPECT_GT(answers_[static_cast<std::size_t>(Sign::unknown)], 1000);
}

// The other one: errors up to 2^-35 of the sizes that it is given for gap and slopes.
TEST_F(HeightForceBounds, of_sure_sizes_hold_beside_ties) {
  for (int i = 0; i < 30000; ++i) {
    const auto value = [&] { return either_sign(std::ldexp(uniform(), pick(14) - 7)); };
    const double gap = std::fabs(value()), Ux = value(), Uy = pick(2) == 0 ? value() : 8 * Ux;
    const auto sure_of = [&](double size) {
      return std::fabs(size) * (pick(6) == 0 ? 32 * uniform() : pick(2) == 0 ? 1 : 1 / uniform());
    };
    const CertaintyThresholds sure{sure_of(gap), sure_of(Ux), sure_of(Uy)};
    const auto all = members(gap, 0x1p-35 * sure.gap, {Ux, 0x1p-35 * sure.Ux}, {Uy, 0x1p-35 * sure.Uy});
    const Mode how = mode();
    const ExactJet& aim = all[static_cast<std::size_t>(pick(9))];
    const auto axis = static_cast<std::size_t>(pick(3));
    const double K =
        stiffness_for(aim, how, axis, any_tie(std::ilogb(static_cast<double>(abs(aim.force(how, 1)[axis]))) + pick(9) - 4));
    check(height_force(gap, Ux, Uy, sure, how, K), all, how, K);
    if (HasFatalFailure()) return;
    // Away from the surface, and no farther than the gap may be wrong.
    EXPECT_EQ(height_force(-gap, Ux, Uy, sure, how, K).contact, gap >= sure.gap ? Sign::negative : Sign::unknown);
  }
}

}  // namespace
}  // namespace forceshade::fast
