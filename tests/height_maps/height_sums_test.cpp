// SPDX-License-Identifier: BSD-3-Clause
// Sums of height maps that are hard to round: the fast path against the reference in every bit, by every instruction set.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <variant>
#include <vector>

#include "fast/heights/exact.h"
#include "forceshade/identity.h"
#include "reference/estimates.h"
#include "tests/height_maps/hostile_maps.h"
#include "tests/laws/force_suite.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;

std::string words_for(const tests::HostileMap& one) {
  std::string name = std::string(name_of(one.mode)) + ", K = " + std::to_string(one.stiffness);
  for (const std::string& part : words_of(one.map)) name += "\n  " + part;
  return name + "\n ";
}

TEST(height_sums, equal_the_rounded_reference) {
  tests::HostileMaps maps(1);
  tests::Met met;
  std::size_t points = 0, built = 0, too_large = 0;
  while (points < tests::drawn(20000) && !testing::Test::HasFailure()) {
    const tests::HostileMap one = maps.next_map();
    const auto of_fast = fast::HeightMapField::build(one.map, one.mode, one.stiffness);
    if (fast::bits_of_exact_numbers(one.map) > fast::Fraction::kMostBits) {  // refused by the fast path alone
      EXPECT_TRUE(std::holds_alternative<ParameterError>(of_fast)) << words_for(one);
      ++too_large;
      continue;
    }
    const auto of_reference = reference::HeightMapField::build(one.map, one.mode, one.stiffness);
    EXPECT_EQ(of_fast.index(), of_reference.index()) << "one side refuses the map: " << words_for(one);
    if (std::holds_alternative<ParameterError>(of_fast)) continue;
    ++built;
    const auto& fast = std::get<fast::HeightMapField>(of_fast);
    const auto& reference = std::get<reference::HeightMapField>(of_reference);
    const auto surface = [&](float x, float y) {
      const bool is_valid = std::fabs(x) <= 1e4F && std::fabs(y) <= 1e4F;
      return is_valid ? static_cast<double>(reference.estimate({x, y, 0}).gap.mid()) : 0;
    };
    std::vector<Vector3f> positions{{0, 0, NAN}};
    for (int i = 0; i < 40; ++i) positions.push_back(maps.next_position(one, surface));
    points += positions.size();
    const tests::Tested tested{words_for(one), [&](const Vector3f& position) { return fast.evaluate(position); },
                               [&](const Vector3f& position) { return reference.round_to_binary32(position); },
                               [&](std::span<const Vector3f> from, std::span<Vector3f> to, fast::InstructionSet set) {
                                 return fast.force(from, to, set);
                               }};
    expect_rounded_reference(tested, positions, met);
    expect_scalar_at_every_simd_width(tested, positions);
  }
  std::printf("  %zu points on %zu maps; %zu more are refused for their size\n", points, built, too_large);
  for (const auto& counts : {met.stages, met.methods, met.statuses})
    for (const int count : counts) EXPECT_GT(count, 0) << "a stage, a method or a status was never reached";
}

}  // namespace
}  // namespace forceshade
