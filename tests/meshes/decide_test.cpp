// SPDX-License-Identifier: BSD-3-Clause
// The error bounds of the god-object's decisions: their constants, counted again by hand, and against exact integers.

#include "fast/meshes/decide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "fast/meshes/bit_span.h"
#include "fast/meshes/contact/all.h"
#include "fast/meshes/quick_slips.h"

namespace forceshade::fast {
namespace {

// Quotients that are a whole or a half step of the grid, or beside one by less than binary64 distinguishes: 2^24 num/den with
// den = 2^24 * unit and num = k * unit + beside, or that and half a unit.
TEST(decide, finds_cells_and_nearest_steps_at_their_very_ends) {
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto half_unit = static_cast<std::int64_t>((std::uint64_t{1} << 60) + (std::uint64_t{random()} << 27));
    const FixedInteger<63> unit(2 * half_unit);
    const auto den = unit.shifted<24>();
    const std::int64_t k = i % 2 == 0 ? 1 + i / 2 : 1 + random() % 16777214;
    for (const std::int64_t beside : {-2, -1, 0, 1, 2}) {
      const auto whole = unit * FixedInteger<26>(k) + FixedInteger<5>(beside);
      EXPECT_EQ(exact_cell(whole, den), (Cell{static_cast<std::uint32_t>(beside < 0 ? k - 1 : k), beside == 0}));
      EXPECT_EQ(exact_nearest(whole, den), static_cast<std::uint32_t>(k)) << k << ", " << beside;
      const auto middle = unit * FixedInteger<26>(k) + FixedInteger<63>(half_unit + beside);
      const bool is_up = beside > 0 || (beside == 0 && k % 2 == 1);
      EXPECT_EQ(exact_cell(middle, den), (Cell{static_cast<std::uint32_t>(k), false})) << k << ", " << beside;
      EXPECT_EQ(exact_nearest(middle, den), static_cast<std::uint32_t>(k) + (is_up ? 1 : 0)) << k << ", " << beside;
    }
  }
}

template <class First, class... Rest>
void expect_numbers_from(std::size_t number, ContactList<First, Rest...>) {
  EXPECT_EQ(static_cast<std::size_t>(First::kContact), number);
  if constexpr (sizeof...(Rest) > 0) expect_numbers_from(number + 1, ContactList<Rest...>());
}

TEST(decide, has_each_contact_rule_under_its_own_number) {
  expect_numbers_from(0, ContactRules());
}

// Shares that are whole, or beside that by less than binary64 distinguishes: (k/2^24)² t² = μ² z², and one unit of z² beside.
TEST(decide, finds_the_share_left_of_a_slip_at_its_very_end) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const auto units = static_cast<std::int64_t>((1U << 31) + (random() >> 1));  // of the coefficient, 2^-33
    const auto coefficient = static_cast<float>(std::ldexp(static_cast<double>(units & ~std::int64_t{255}), -33));
    const std::int64_t k = 1 + random() % 16777214, all = 1 + random() % 1023;
    const FixedInteger<44> t(static_cast<std::int64_t>(std::ldexp(static_cast<double>(coefficient), 33)) * all);
    const FixedInteger<44> z(k * 512 * all);
    const Load load{{(t * t).approximately(), 0}, {(z * z).approximately(), 0}};
    const Coefficients of{coefficient, coefficient};
    for (const std::int64_t beside : {-1, 0, 1}) {
      const ExactStages stages;
      const auto exact = [&] { return ExactLoad{t * t, z * z + FixedInteger<3>(beside)}; };
      const Friction<ExactStages, decltype(exact)> friction(load, of, stages, exact);
      EXPECT_EQ(friction.share_left(), static_cast<std::uint32_t>(beside < 0 ? k - 1 : k)) << k << ", " << beside;
    }
  }
}

// In units of 2^-53, to the slack.
void expect_units(const RoundingBound& bound, double size, double units) {
  EXPECT_GE(bound.error * 0x1p53, units);
  EXPECT_LE(bound.error * 0x1p53, units * (1 + 0x1p-30));
  EXPECT_GE(bound.size, size);
  EXPECT_LE(bound.size, size * (1 + 0x1p-30));
}

// With components up to 1: a difference is off by 1 unit, an offset by 2. A product is off by each factor's error times the
// other's size, and by its own size; a sum by its operands' errors and its own size.
TEST(decide, has_the_bounds_that_counting_by_hand_gives) {
  expect_units(kNormal.x, 2, (1 + 1 + 1) * 2 + 2);
  const double n = 8, beside = (2 + 1 + 1) * 2 + 2;  // of n and of e x w, which have components up to 2
  expect_units(kAcross, 6, (n + 2 * 2 + 2) * 3 + 4 + 6);
  expect_units(kInside, 12, (2 * beside + 2 * n + 4) * 3 + 8 + 12);
  expect_units(kArea, 12, (2 * n + 2 * n + 4) * 3 + 8 + 12);
  expect_units(kThird, 36, 128 + (140 + 140 + 24) + 36);
  expect_units(kAlong, 3, (2 + 1 + 1) * 3 + 2 + 3);
  expect_units(kLength, 3, (1 + 1 + 1) * 3 + 2 + 3);
  expect_units(kOffsetLength, 3, (2 + 2 + 1) * 3 + 2 + 3);
  expect_units(kPasses, 6, (beside + 2 + 2) * 3 + 4 + 6);
  expect_units(kPressed, 2, beside);
  expect_units(kPulled, 4, (n + 2 * 2 + 2) * 2 + 4);
  const double along = 2 * (14 + 3) + 6;  // of c·E
  expect_units(kPullSquared, 12, 2 * (along + 6) + 12);
  expect_units(kGainByStep, 15, 14 + (2 * along + 12) + 15);
  expect_units(kWayToHand, 4, (2 * (1 + 1) + 2) + (n + 2) + 4);
}

// The sums of quick_slips.h: of what is in proportion to q's own error, and to u m. d is less than 2^-10 m, and m is 2 at
// least.
TEST(decide, has_bounds_of_slips_that_cover_their_parts) {
  const double of_c = 8;  // u m in c_error
  EXPECT_EQ(SlipBounds::kShareOfC, of_c * 0x1p-53);
  const auto expect_covered = [&](double factor, double of_q, double of_units, const char* what) {
    EXPECT_GT(factor, of_q) << what;
    EXPECT_GT(of_c * factor, of_q + of_units) << what;
    EXPECT_LT(factor, 4 * std::fmax(of_q, (of_q + of_units) / of_c)) << what;
  };
  const auto units = [](const RoundingBound& bound) { return bound.error * 0x1p53; };
  expect_covered(SlipBounds::kOfPull, 24 + 12 * 0x1p-10, units(kPullSquared) + 12, "pull");
  expect_covered(SlipBounds::kOfGain, 3 * 12, 3 * units(kGainByStep) + 28 / 2.0 + 66 + 51, "gain by a step");
  expect_covered(SlipBounds::kOfWay, 2, units(kWayToHand), "way to the hand");
  EXPECT_GT(SlipBounds::kOfLift, 2 + units(kWayToHand) / 4);
  EXPECT_GT(SlipBounds::kOfPressure, 2 + 0x1p-10 + 3 / 4.0);
}

// proofs/meshes/MeshSigns.v runs RoundingBound too: a line of its proof has the significand and the exponent of each error.
TEST(decide, has_the_bounds_that_coq_gives) {
  std::ifstream file(FORCESHADE_SOURCE_DIR "/proofs/meshes/MeshSigns.v");
  std::vector<double> proved;
  long long significand = 0;
  int exponent = 0;
  for (std::string line; std::getline(file, line);)
    if (std::sscanf(line.c_str(), "  - above %lld%%positive (%d)%%Z.", &significand, &exponent) == 2)
      proved.push_back(std::ldexp(static_cast<double>(significand), exponent));
  EXPECT_EQ(proved, (std::vector<double>{kNormal.x.error, kAcross.error, kInside.error, kArea.error, kAlong.error,
                                         kLength.error, kOffsetLength.error, kPasses.error, kThird.error}));
}

// Gappa proves the bound of each expression (fast/meshes/decide.g), in units of 2^-53.
TEST(decide, has_bounds_that_the_proofs_of_gappa_imply) {
  const std::map<std::string, RoundingBound> bounds{{"normal", kNormal.x},
                                                    {"across", kAcross},
                                                    {"inside", kInside},
                                                    {"area", kArea},
                                                    {"along", kAlong},
                                                    {"length", kLength},
                                                    {"offset_length", kOffsetLength},
                                                    {"passes", kPasses},
                                                    {"third", kThird},
                                                    {"pressed", kPressed},
                                                    {"pulled", kPulled},
                                                    {"pull", kPullSquared},
                                                    {"gain", kGainByStep},
                                                    {"way", kWayToHand}};
  std::ifstream file(FORCESHADE_SOURCE_DIR "/fast/meshes/decide.gappa-expected");
  std::size_t found = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string piece = line.substr(0, line.find(':'));
    const auto bound = bounds.find(piece);
    if (bound == bounds.end()) continue;
    ++found;
    const double proved = std::strtod(line.c_str() + line.rfind(',') + 1, nullptr);
    std::printf("  %-14s %6.2f, proved %6.2f\n", piece.c_str(), bound->second.error * 0x1p53, proved * 0x1p53);
    // Gappa prints six digits, and the header has its slack.
    EXPECT_LE(proved, bound->second.error * (1 + 1e-5)) << piece;
    EXPECT_GE(proved, bound->second.error * (1 - 1e-3)) << piece;
  }
  EXPECT_EQ(found, bounds.size());
}

// A span of numbers that binary64 holds without rounding. The ends of each span are met, so that none is too wide either.
TEST(decide, counts_the_bits_of_sums_and_products) {
  std::mt19937 random(8);
  int longest_sums = 0, longest_products = 0;
  for (int i = 0; i < 100000; ++i) {
    struct Number {
      BitSpan span;
      double value;
    };
    const auto draw = [&]() -> Number {
      const int low = static_cast<int>(random() % 40) - 20, bits = 1 + static_cast<int>(random() % 6);
      const auto size = static_cast<int>(random() % (1U << bits));
      return {{low, low + bits}, std::ldexp(random() % 2 == 0 ? size : -size, low)};
    };
    const Number a = draw(), b = draw();
    const auto is_in = [](const BitSpan& span, double value) {
      const double units = std::ldexp(value, -span.low);
      return units == std::trunc(units) && std::fabs(value) < std::ldexp(1.0, span.high);
    };
    ASSERT_TRUE(is_in(a.span + b.span, a.value + b.value));
    ASSERT_TRUE(is_in(a.span - b.span, a.value - b.value));
    ASSERT_TRUE(is_in(a.span * b.span, a.value * b.value));
    longest_sums += !is_in({(a.span + b.span).low, (a.span + b.span).high - 1}, a.value + b.value);
    longest_products += !is_in({(a.span * b.span).low, (a.span * b.span).high - 1}, a.value * b.value);
  }
  std::printf("  %d sums and %d products as long as can be; the shaded force takes %d bits\n", longest_sums, longest_products,
              most_bits_of_shaded_force());
  EXPECT_GT(longest_sums, 500);
  EXPECT_GT(longest_products, 1000);
  // docs/proofs.md states it.
  EXPECT_EQ(most_bits_of_shaded_force(), 3611);
}

TEST(decide, stays_within_the_bounds_on_flat_and_thin_triangles) {
  std::mt19937 random(3);
  double worst_side = 0, worst_weight = 0;
  std::size_t doubtful = 0;
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 24) - 12),
                 thin = std::ldexp(1.0, -static_cast<int>(random() % 20));
    const auto coordinate = [&](double size) {
      return static_cast<float>(scale * size * std::uniform_real_distribution<double>(-1, 1)(random));
    };
    Face f{};
    for (auto& corner : f.corner) corner = {coordinate(1), coordinate(1), coordinate(thin)};
    std::array<float, 3> p{coordinate(2), coordinate(2), coordinate(thin)};
    const auto read = [](float& one) { one = std::fabs(one) < 0x1p-30F ? 0 : one; };
    for (auto& corner : f.corner)
      for (float& one : corner) read(one);
    for (float& one : p) read(one);
    const FaceNumbers numbers(f);
    const Vector3<double> w = difference(p.data(), f.corner[0].data());
    const double side = dot(numbers.n, w), bound = kAcross.error * numbers.area * size_of(w);
    const auto exact = dot(ExactFace(f).n, exact_difference(p.data(), f.corner[0].data()));
    const double off = std::fabs(std::ldexp(exact.approximately(), -159) - side);
    // The exact number is rounded here.
    ASSERT_LE(off, bound + 0x1p-51 * std::fabs(side));
    if (bound > 0) worst_side = std::fmax(worst_side, off / bound);
    if (std::fabs(side) > bound)
      ASSERT_EQ(exact.sign(), side > 0 ? 1 : -1);
    else
      ++doubtful;
    const Weights weights(numbers, w);
    const ExactWeights integers(f, p.data());
    for (std::size_t c = 0; c < 3; ++c) {
      const double away = std::fabs(std::ldexp(integers.corner[c].approximately(), -212) - weights.corner[c].value);
      ASSERT_LE(away, weights.corner[c].error + 0x1p-51 * std::fabs(weights.corner[c].value));
      if (weights.corner[c].error > 0) worst_weight = std::fmax(worst_weight, away / weights.corner[c].error);
    }
  }
  std::printf("  worst error over bound: %.3f of a side, %.3f of a weight; %zu doubtful\n", worst_side, worst_weight, doubtful);
  EXPECT_GT(worst_side, 0.02);
  EXPECT_GT(worst_weight, 0.02);
}

}  // namespace
}  // namespace forceshade::fast
