// SPDX-License-Identifier: BSD-3-Clause
// The drawing of a property's cases, and the simplifying of the one that fails.

#include <gtest/gtest.h>

#include <climits>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "forceshade/properties.h"
#include "properties/binary32.h"
#include "properties/law_subject.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kAnyLaw{15.24F, 25.4F, 0.5F};
constexpr std::uint64_t kAnySeed = 9;

// Holds of what it draws, which it keeps.
Property keeping(std::vector<int>& drawn) {
  return [&drawn](Chooser& choose) -> Violation {
    drawn.push_back(choose(integers(0, 1000000)));
    drawn.push_back(choose(integers(0, 1000000)));
    return std::nullopt;
  };
}

TEST(run_property, draws_the_same_cases_for_the_same_seed_and_others_for_another) {
  std::vector<int> first, again, other;
  const PropertyResult result = run_property("mine", 100, 1, keeping(first));
  EXPECT_TRUE(result.held);
  EXPECT_EQ(result.name, "mine");
  EXPECT_EQ(result.cases, 100U);
  EXPECT_EQ(result.counterexample, "");
  run_property("mine", 100, 1, keeping(again));
  run_property("mine", 100, 2, keeping(other));
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
  ASSERT_EQ(first.size(), 200U);
  EXPECT_GE(std::set<int>(first.begin(), first.end()).size(), 199U) << "each value is drawn anew";
}

TEST(run_property, draws_every_integer_from_the_first_to_the_last) {
  std::set<int> seen, ends;
  run_property("mine", 300, kAnySeed, [&](Chooser& choose) -> Violation {
    seen.insert(choose(integers(-3, 4)));
    ends.insert(choose(integers(INT_MAX - 1, INT_MAX)));
    ends.insert(choose(integers(INT_MIN, INT_MAX)));
    return std::nullopt;
  });
  EXPECT_EQ(seen, (std::set<int>{-3, -2, -1, 0, 1, 2, 3, 4}));
  EXPECT_TRUE(ends.contains(INT_MAX) && ends.contains(INT_MAX - 1));
  EXPECT_LT(*ends.begin(), -1000000000);
  EXPECT_THROW(integers(1, 0), std::invalid_argument);
}

// The words of a failure that tells what it drew.
std::string simplest(const Property& property) {
  const PropertyResult result = run_property("mine", 1000, kAnySeed, property);
  EXPECT_FALSE(result.held);
  return result.counterexample;
}

TEST(run_property, ends_with_the_simplest_case_that_fails) {
  const auto integer_that = [](int low, int high, const std::function<bool(int)>& is_wrong) {
    return simplest([&](Chooser& choose) -> Violation {
      const int i = choose(integers(low, high));
      return is_wrong(i) ? Violation(std::to_string(i)) : std::nullopt;
    });
  };
  EXPECT_EQ(integer_that(-100000, 100000, [](int i) { return i > 17; }), "18");
  EXPECT_EQ(integer_that(-100000, 100000, [](int i) { return i < -17; }), "-18");
  EXPECT_EQ(integer_that(INT_MIN, INT_MAX, [](int i) { return i != INT_MIN; }), "0");
  EXPECT_EQ(integer_that(50, 90, [](int) { return true; }), "50") << "the nearest to 0";
  EXPECT_EQ(integer_that(-90, -50, [](int) { return true; }), "-50");
}

// After one value has become simpler the other may, too, and the first one again.
TEST(run_property, comes_back_to_a_value_until_none_can_be_simpler) {
  EXPECT_EQ(simplest([](Chooser& choose) -> Violation {
              const int a = choose(integers(0, 1000)), b = choose(integers(0, 1000));
              const bool is_wrong = a >= 10 && b >= 10 && a - b <= 5 && b - a <= 5;
              return is_wrong ? Violation(std::to_string(a) + ' ' + std::to_string(b)) : std::nullopt;
            }),
            "10 10");
}

// A list as long as it says, of elements that are drawn after it: the range of each depends on the length.
TEST(run_property, draws_within_the_range_of_what_was_drawn_before_also_while_it_simplifies) {
  int calls = 0;
  const std::string words = simplest([&](Chooser& choose) -> Violation {
    ++calls;
    const int count = choose(integers(1, 40));
    int sum = 0;
    for (int i = 0; i < count; ++i) {
      const int element = choose(integers(0, count - 1));
      EXPECT_LT(element, count);
      sum += element;
    }
    return sum > 3 ? Violation(std::to_string(count) + " with a sum of " + std::to_string(sum)) : std::nullopt;
  });
  EXPECT_TRUE(words == "3 with a sum of 4" || words == "4 with a sum of 4" || words == "5 with a sum of 4") << words;
  EXPECT_GT(calls, 10);
}

// One that has drawn nothing when it is asked again, as when a run is stopped.
TEST(run_property, may_draw_less_of_a_case_when_it_is_asked_again) {
  int calls = 0;
  EXPECT_EQ(simplest([&](Chooser& choose) -> Violation {
              if (++calls > 2) return "stopped";
              const int a = choose(integers(0, 1000)), b = choose(integers(0, 1000));
              return std::to_string(a) + ' ' + std::to_string(b);
            }),
            "stopped");
}

TEST(run_property, gives_up_after_as_many_simpler_cases_as_it_says) {
  // One that always has another one that is simpler.
  const Generator<int> endless{[](std::uint64_t) { return 0; }, [](const int& i) { return std::vector<int>{i + 1}; }};
  int calls = 0;
  const PropertyResult result = run_property("mine", 10, kAnySeed, [&](Chooser& choose) -> Violation {
    ++calls;
    return std::to_string(choose(endless));
  });
  EXPECT_EQ(calls, 1 + kSimplerCases + 1) << "the first, the simpler ones, and the last again";
  EXPECT_EQ(result.counterexample, std::to_string(kSimplerCases));
  EXPECT_EQ(result.cases, 1U);
}

TEST(run_property, does_without_simpler_values) {
  const Generator<int> alone{[](std::uint64_t) { return 7; }};
  EXPECT_EQ(simplest([&](Chooser& choose) { return Violation(std::to_string(choose(alone))); }), "7");
}

TEST(run_property, draws_values_of_any_type) {
  const Generator<bool> truths{[](std::uint64_t seed) { return seed % 2 == 0; },
                               [](const bool& value) { return std::vector<bool>(value ? 1 : 0, false); }};
  const Generator<std::string> words{[](std::uint64_t) { return std::string("soft"); }};
  EXPECT_EQ(simplest([&](Chooser& choose) { return Violation(choose(words) + (choose(truths) ? " true" : " false")); }),
            "soft false");
}

TEST(run_property, makes_a_case_simple_that_throws) {
  EXPECT_EQ(simplest([](Chooser& choose) -> Violation {
              if (choose(integers(0, 1000)) > 30) throw std::runtime_error("too large");
              return std::nullopt;
            }),
            "an exception is thrown: too large");
  EXPECT_EQ(simplest([](Chooser&) -> Violation { throw 7; }), "an exception is thrown: something that is no std::exception");
}

TEST(shorter, leaves_out_every_element_and_the_most_at_first) {
  EXPECT_EQ(shorter(std::vector{1, 2, 3, 4}, 1),
            (std::vector<std::vector<int>>{{1}, {4}, {1, 2, 3}, {2, 3, 4}, {1, 3, 4}, {1, 2, 4}}));
  EXPECT_TRUE(shorter(std::vector{1, 2, 3}, 3).empty());
  EXPECT_TRUE(shorter(std::vector{1, 2}, 3).empty());
}

// Wrong beyond 3 mm of depth: a position of x = y = 0 and a z of one significant bit, wherever the first one was.
TEST(run_property, finds_a_simple_position_at_which_a_wall_is_wrong) {
  RenderedLaw wall = std::get<RenderedLaw>(fast_rendering(LawId::wall, kAnyLaw));
  wall.force_at = [right = wall.force_at](const Eigen::Vector3f& position) {
    Rendered answer = right(position);
    if (answer.status == Status::contact && position.z() < -3) answer.force.z() *= 2;
    return answer;
  };
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const PropertyResult result = run_properties(LawSubject(wall), 1000, seed).at(0);
    EXPECT_FALSE(result.held);
    EXPECT_TRUE(result.counterexample.starts_with("at x = 0x0p+0 (0), y = 0x0p+0 (0), z = -0x1p+")) << result.counterexample;
    EXPECT_EQ(run_properties(LawSubject(wall), 1000, seed).at(0).counterexample, result.counterexample);
  }
}

TEST(run_property, may_run_in_several_threads_at_once) {
  const LawSubject subject(LawId::bump_2p_shaded, kAnyLaw);
  const auto words = [&] {
    std::string all;
    for (const PropertyResult& result : run_properties(subject, 200, kAnySeed))
      all += result.name + ' ' + std::to_string(result.held) + ' ' + std::to_string(result.cases) + '\n';
    std::vector<int> drawn;
    run_property("mine", 100, kAnySeed, keeping(drawn));
    for (const int i : drawn) all += ' ' + std::to_string(i);
    return all;
  };
  const std::string alone = words();
  std::string first, second;
  std::thread one([&] { first = words(); }), two([&] { second = words(); });
  one.join();
  two.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

}  // namespace
}  // namespace forceshade::properties
