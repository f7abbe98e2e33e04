// SPDX-License-Identifier: BSD-3-Clause
// The energy that a closed loop of a recording may give the hand, the cost of one that the definition makes costly, and where a
// loop may begin: cases beside both sides of what is allowed.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "properties/conformance/recordings/invariants.h"

namespace forceshade::conformance {
namespace {

constexpr double kDepth = 2;    // mm, of each loop
constexpr int kSteps = 2000;    // of each loop
constexpr double kNone = 1e-9;  // mJ

// A hand that goes up and down, with the force along its way and, where there is a definition, the exact one.
struct Hand {
  Measurements measured{"made.csv", {}};
  ExactForces exact = {};

  Hand& at(double depth, double force) {
    const std::size_t i = measured.samples.size();
    measured.samples.push_back({0.001 * static_cast<double>(i), {0, 0, -depth}, {0, 0, force}, i + 2, i == 0 ? 0 : 0.001});
    return *this;
  }
  Hand& at(double depth, double force, double exact_force) {
    exact.emplace_back(Eigen::Vector3d(0, 0, exact_force));
    return at(depth, force);
  }
  // From the surface to the depth and back, with a spring of 1 N/mm that gives so much more on the way out (mJ).
  static double force_of(double depth, bool is_out, double given) {
    return depth + (is_out ? given * std::numbers::pi / (2 * kDepth) * std::sin(std::numbers::pi * depth / kDepth) : 0);
  }
  Hand& loop(double given, int steps = kSteps) { return loop(given, nullptr, steps); }
  Hand& loop(double given, const double* exactly_given, int steps = kSteps) {
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps, depth = kDepth / 2 * (1 - std::cos(2 * std::numbers::pi * share));
      const bool is_out = 2 * i > steps;
      if (exactly_given != nullptr)
        at(depth, force_of(depth, is_out, given), force_of(depth, is_out, *exactly_given));
      else
        at(depth, force_of(depth, is_out, given));
    }
    return *this;
  }
  Hand& loop_beside(double given, double exactly_given) { return loop(given, &exactly_given); }
};

struct Case {
  const char* what;
  Hand hand;
  Allowed allowed;
  bool gives_in_a_loop, gives_in_all;
};

TEST(recorded_energy, is_more_than_what_is_allowed_or_not) {
  // Errors of the force add up as steps of chance: 4 times their mean size by the root of the sum of the squares of all steps.
  const double step_squares = kDepth * kDepth * std::numbers::pi * std::numbers::pi / (2.0 * kSteps),
               by_chance = 4 * std::sqrt(step_squares);
  Hand biased;
  for (int i = 0; i <= 1000; ++i) biased.at(10 - 0.01 * i, 0.09);
  const std::vector<Case> cases{
      {"a spring", Hand().loop(0), {0, kNone}, false, false},
      {"just inside", Hand().loop(1), {0, 1.01}, false, false},
      {"just outside", Hand().loop(1), {0, 0.99}, true, true},
      {"just inside of what errors of the force do", Hand().loop(0.9 * 0.01 * by_chance), {0.01, 0}, false, false},
      {"just outside of what errors of the force do", Hand().loop(1.2 * 0.01 * by_chance), {0.01, 0}, true, true},
      {"two loops, each inside", Hand().loop(0.6).loop(0.6), {0, 1}, true, true},
      {"two loops, each inside, after one that took more", Hand().loop(-5).loop(0.6).loop(0.6), {0, 1}, true, true},
      {"a long way with a force that is none, to what it may be off by", biased, {0.1, 0}, false, false},
      {"a loop that takes", Hand().loop(-1), {0, kNone}, false, false},
      {"as much as an active law", Hand().loop_beside(1, 1), {0, 0.01}, false, false},
      {"more than an active law", Hand().loop_beside(1, 0.5), {0, 0.49}, true, true},
      {"less than an active law", Hand().loop_beside(0.5, 1), {0, 0.01}, false, false},
      {"takes less than a law that takes", Hand().loop_beside(-0.5, -1), {0, 0.01}, false, false},
      {"gives beside a law that takes", Hand().loop_beside(0.5, -1), {0, 0.49}, true, true},
      // In by three samples and out by two, of a force that is the square of the depth: the rule gives 1 mJ where there is
      // none.
      {"few samples of a force that bends", Hand().at(0, 0).at(1, 1).at(2, 4).at(0, 0), {0, kNone}, false, false}};
  for (const Case& its : cases) {
    const std::vector<Invariant> found = energy_invariants_of(its.hand.measured, its.hand.exact, its.allowed);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].violation.has_value(), its.gives_in_a_loop) << its.what << ": " << found[0].violation.value_or("");
    EXPECT_EQ(found[1].violation.has_value(), its.gives_in_all) << its.what << ": " << found[1].violation.value_or("");
    EXPECT_GT(found[1].cases, 0U) << its.what;
  }
}

// A loop inside of a contact that ends beside its beginning is closed straight, so that what the spring still holds is no gift.
TEST(recorded_energy, of_a_loop_that_begins_in_a_contact_is_without_what_is_stored) {
  for (const double given : {0.0, 0.5}) {
    Hand hand;
    for (int i = 0; i <= 1000; ++i) hand.at(1.009 + 0.001 * i, 1.009 + 0.001 * i);
    for (int i = 0; i <= 1009; ++i) {
      const double depth = 2.009 - 0.001 * i;
      hand.at(depth, depth + given * std::sin(std::numbers::pi * (depth - 1)));
    }
    for (Measured& each : hand.measured.samples) each.position.x() = each.position.z() < -1.5 ? 0.02 : 0;
    const std::vector<Invariant> found = energy_invariants_of(hand.measured, hand.exact, {0, 0.001});
    EXPECT_EQ(found[0].violation.has_value(), given > 0) << found[0].violation.value_or("");
    EXPECT_FALSE(found[1].violation) << "nothing is known of what was stored";
  }
}

// A force that is lost inside of the surface is none of a hand that stores nothing.
TEST(recorded_energy, begins_where_there_is_no_force_and_none_is_exact) {
  for (const bool is_known : {true, false}) {
    Hand hand;
    for (int i = 0; i <= 1000; ++i) {
      const double depth = 1 - 0.001 * i, force = i == 0 ? 0 : 2 * depth;
      if (is_known)
        hand.at(depth, force, depth);
      else
        hand.at(depth, force);
    }
    EXPECT_EQ(energy_invariants_of(hand.measured, hand.exact, {0, 0.1})[1].violation.has_value(), !is_known);
  }
}

}  // namespace
}  // namespace forceshade::conformance
