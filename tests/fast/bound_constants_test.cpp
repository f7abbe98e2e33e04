// SPDX-License-Identifier: BSD-3-Clause
// The constants of the error bounds, each from its definition, in exact arithmetic.

#include <gtest/gtest.h>

#include <boost/multiprecision/mpfr.hpp>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

#include "fast/heights/force.h"
#include "fast/heights/spline.h"
#include "tests/support/multiprecision.h"

namespace forceshade {
namespace {

using fast::DoubleDouble;
using fast::DoubleWithError;
using tests::Multiprecision;

const Multiprecision kUnit = ldexp(Multiprecision(1), -53);  // half of what the neighbour of 1 differs by

// The factor that a bound may lose to `roundings` roundings.
Multiprecision loss(int roundings, const Multiprecision& unit = kUnit) {
  return pow(1 - unit, roundings);
}

TEST(bound_constants, a_unit_is_half_the_distance_of_1_to_its_neighbour) {
  EXPECT_EQ(DoubleWithError::kUnit, (std::nextafter(1.0, 2.0) - 1) / 2);
}

// The terms of the quotient: |q| itself, its product with an error, the sum, the divisor's least size, the division, the sum
// with the rounding error, and the product with kSlack. Every other operation has fewer.
TEST(bound_constants, slacks_outweigh_the_roundings_of_the_bounds) {
  constexpr int kRoundings = 7;
  EXPECT_GE(DoubleWithError::kSlack * loss(kRoundings), 1);
  EXPECT_LT((1 + (DoubleWithError::kSlack - 1) / 2) * loss(kRoundings), 1) << "half would do";
  // Beside these, the first number stands for both, in operand and result.
  EXPECT_GE(DoubleDouble::kSlack * loss(kRoundings + 4), 1);
}

// The number that Gappa prints for a piece of a script: the largest size of its last interval.
Multiprecision proved(const std::string& script, const std::string& piece) {
  std::ifstream file(std::string(FORCESHADE_SOURCE_DIR "/fast/") + script + ".gappa-expected");
  std::string line;
  while (std::getline(file, line)) {
    std::smatch ends;
    if (line.starts_with(piece + ":") && std::regex_search(line, ends, std::regex(R"(\[(\S+), (\S+)\])")))
      return std::max<Multiprecision>(abs(Multiprecision(ends[1].str())), abs(Multiprecision(ends[2].str())));
  }
  ADD_FAILURE() << "expected a piece " << piece << " in " << script;
  return 0;
}

// At most four times what is proved, and not less.
void expect_implied(double constant, const Multiprecision& least) {
  EXPECT_GE(Multiprecision(constant), least);
  EXPECT_LE(Multiprecision(constant), 4 * least);
}

TEST(bound_constants, are_implied_by_what_gappa_proves) {
  const Multiprecision quotient = proved("numbers/double_double", "quotient");
  for (const char* piece : {"product", "root"}) EXPECT_LE(proved("numbers/double_double", piece), quotient);
  EXPECT_LE(3 * kUnit * kUnit / (1 - 4 * kUnit), quotient) << "a sum";
  expect_implied(DoubleDouble::kRelativeError, quotient);
  // The rise, with the two units of adding c - z, which is at most |gap| and two steps; a unit of the slopes' own.
  const Multiprecision along = proved("heights/spline", "along");
  for (const char* piece : {"rise", "aside"}) EXPECT_LE(proved("heights/spline", piece), along);
  EXPECT_LE(proved("heights/spline", "rise") + 2 * 2 * kUnit, Multiprecision(fast::kSplineError));
  expect_implied(fast::kSplineError, along);
  // The end of the enclosure is rounded once more.
  const Multiprecision force = proved("heights/force", "force");
  EXPECT_LE(proved("heights/force", "conservative"), force);
  expect_implied(fast::kHeightForceError, force + kUnit);
}

TEST(bound_constants, windows_hold_what_an_error_moves) {
  EXPECT_EQ(fast::kDroppedMask + 1, 1 << (std::numeric_limits<double>::digits - std::numeric_limits<float>::digits));
  EXPECT_EQ(fast::doubt_window(0), 0);
  for (double bound = 0x1p-53; bound < 0x1p-30; bound *= 1.37) {
    // Units in the last place of a number next to 2, the most that a relative error is.
    const Multiprecision units = ldexp(Multiprecision(bound), 53);
    EXPECT_GE(Multiprecision(fast::doubt_window(bound)), units) << bound;
    EXPECT_LE(Multiprecision(fast::doubt_window(bound)), units + 1) << bound;
    const bool is_covered = units * (1 + 2 * Multiprecision(bound)) <= fast::doubt_window(bound);
    EXPECT_EQ(fast::window_covers(fast::doubt_window(bound), bound), is_covered) << bound;
  }
  // One unit of the last place less than the error moves; and an error whose square fills the rest of a unit.
  EXPECT_FALSE(fast::window_covers(8, 0x1p-50));
  EXPECT_FALSE(fast::window_covers(fast::doubt_window(0x1.0000003p-27), 0x1.0000003p-27));
}

template <int kWindow>
void doubts_a_window_on_both_sides_of_a_half() {
  constexpr std::int64_t kHalf = (fast::kDroppedMask + 1) / 2;
  const auto with_dropped_bits = [](std::int64_t bits) {
    return __builtin_bit_cast(double, (std::uint64_t{0x3FF12345} << 32) + static_cast<std::uint64_t>(bits));
  };
  for (const std::int64_t off : {std::int64_t{0}, std::int64_t{kWindow} / 2, std::int64_t{kWindow} - 1, std::int64_t{kWindow}})
    for (const std::int64_t side : {-off, off})
      EXPECT_TRUE(fast::rounding_is_in_doubt<kWindow>(with_dropped_bits(kHalf + side))) << kWindow << ' ' << side;
  for (const std::int64_t off : {std::int64_t{kWindow} + 2, std::int64_t{kWindow} + 1000, kHalf - 1})
    for (const std::int64_t side : {-off, off})
      EXPECT_FALSE(fast::rounding_is_in_doubt<kWindow>(with_dropped_bits(kHalf + side))) << kWindow << ' ' << side;
}
TEST(bound_constants, windows_reach_as_far_on_both_sides_of_a_half) {
  doubts_a_window_on_both_sides_of_a_half<1>();
  doubts_a_window_on_both_sides_of_a_half<9>();
  doubts_a_window_on_both_sides_of_a_half<19>();
  doubts_a_window_on_both_sides_of_a_half<fast::doubt_window(4 * fast::kErrorBudgetShare)>();
}

}  // namespace
}  // namespace forceshade
