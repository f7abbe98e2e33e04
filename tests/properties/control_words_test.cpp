// SPDX-License-Identifier: BSD-3-Clause
// The exact side under control words that others have set: its answers are the same, and the words stay as they were.

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "forceshade/properties.h"
#include "forceshade/reference.h"
#include "tests/support/set_control_words.h"

namespace forceshade {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

// 53 bits; and the same where every exception traps, in both units.
const std::vector<ControlWords> kWords{{.x87 = tests::kX87Of53Bits}, {.mxcsr = 0, .x87 = 0x240}, {.mxcsr = 0}};

std::vector<Eigen::Vector3f> positions() {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> x(-14, 14), z(-2, 9);
  std::vector<Eigen::Vector3f> all(8000);
  for (Eigen::Vector3f& one : all) one = {x(random), 0, z(random)};
  return all;
}

template <class Side>
std::vector<Eigen::Vector3f> forces(const Side& side, const std::vector<Eigen::Vector3f>& at) {
  std::vector<Eigen::Vector3f> all(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) all[i] = side.round_to_binary32(at[i]).force;
  return all;
}

// A law that was built under other words, too.
TEST(control_words, of_anybody_change_no_exact_force_of_a_law) {
#if !FORCESHADE_HAS_CONTROL_WORDS
  GTEST_SKIP() << "this processor has no control words";
#endif
  const std::vector<Eigen::Vector3f> at = positions();
  for (const LawId id : {LawId::cylinder, LawId::bump_cylinder, LawId::bump_3p, LawId::bump_3p_shaded}) {
    const auto expected = forces(std::get<reference::Law>(reference::Law::build(id, kBump)), at);
    for (const ControlWords& words : kWords) {
      std::vector<Eigen::Vector3f> found;
      bool are_still_set = false;
      {
        const tests::SetControlWords set(words);
        const auto law = reference::Law::build(id, kBump);
        found = forces(std::get<reference::Law>(law), at);
        are_still_set = set.are_still_set();
      }
      EXPECT_TRUE(are_still_set);
      EXPECT_EQ(found, expected) << name_of(id) << " with the x87's word " << words.x87;
    }
  }
}

TEST(control_words, of_anybody_change_no_digit_and_no_exact_force_of_a_height_map) {
#if !FORCESHADE_HAS_CONTROL_WORDS
  GTEST_SKIP() << "this processor has no control words";
#endif
  const std::vector<Eigen::Vector3f> at = positions();
  const HeightMap hill{{{height::Gaussian{1, 0, 2, 1.5F}}}};
  const auto build = [&] {
    return std::get<reference::HeightMapField>(reference::HeightMapField::build(hill, height::Mode::conservative, 0.5F));
  };
  const auto bump = std::get<reference::Law>(reference::Law::build(LawId::bump_cylinder, kBump));
  const auto expected = forces(build(), at);
  const std::string digits = bump.decimal({3, 0, -0.5F}, 40).z, width = reference::geometry(kBump, 40).w_prime;
  for (const ControlWords& words : kWords) {
    std::vector<Eigen::Vector3f> found;
    std::string its_digits, its_width;
    {
      const tests::SetControlWords set(words);
      found = forces(build(), at);
      its_digits = bump.decimal({3, 0, -0.5F}, 40).z;
      its_width = reference::geometry(kBump, 40).w_prime;
    }
    EXPECT_EQ(found, expected) << words.x87;
    EXPECT_EQ(its_digits, digits);
    EXPECT_EQ(its_width, width);
  }
}

// Continuity and unit normals are judged in long double, outside of what the exact side itself computes.
TEST(control_words, of_anybody_change_no_verdict_about_a_property) {
  for (const ControlWords& words : kWords) {
    std::vector<properties::PropertyResult> results;
    {
      const tests::SetControlWords set(words);
      results = properties::run_properties(*properties::law_subject(LawId::bump_cylinder, kBump), 300, 1);
    }
    EXPECT_FALSE(results.empty());
    for (const properties::PropertyResult& result : results)
      EXPECT_TRUE(result.held) << result.name << ": " << result.counterexample;
  }
}

}  // namespace
}  // namespace forceshade
