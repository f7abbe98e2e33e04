// SPDX-License-Identifier: BSD-3-Clause
// The truth along a run is the truth at each of its positions.

#include "reference/consecutive_floats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "properties/binary32.h"
#include "tests/laws/law_suite.h"

namespace forceshade::reference {
namespace {

using properties::same_bits;
using properties::show;

// The first bit pattern of a run somewhere in the domain, at an edge of the bump, or anywhere, with either sign.
std::uint32_t any_run(const Parameters& p, std::mt19937_64& random) {
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  std::uint32_t pattern = 0;
  switch (random() % 4) {
    case 0: pattern = bits(p.width / 2) - static_cast<std::uint32_t>(kRun * (random() % 4)); break;
    case 1: pattern = static_cast<std::uint32_t>(random()); break;
    default: pattern = bits(p.width) - (static_cast<std::uint32_t>(random()) & 0x3FFFFFF); break;
  }
  return ((pattern & 0x7FFFFFFF) | static_cast<std::uint32_t>(random() << 31)) & ~static_cast<std::uint32_t>(kRun - 1);
}

TEST(run, rounds_as_position_by_position) {
  std::mt19937_64 random(5);
  std::size_t positions = 0, one_by_one = 0;
  for (const LawName& name : kLaws) {
    for (const Parameters& p : tests::parameter_sets()) {
      const auto law = std::get<Law>(Law::build(name.id, p));
      for (int k = 0; k < 12; ++k) {
        const Along along = random() % 2 == 0 ? Along::x : Along::z;
        const float fixed = std::ldexp(p.radius, -static_cast<int>(random() % 12)) * (random() % 4 == 0 ? 0.3F : -0.3F);
        const std::uint32_t first = any_run(p, random);
        const RoundedRun run = round_run(law, along, fixed, first);
        positions += kRun;
        one_by_one += run.one_by_one;
        for (std::size_t i = random() % 13; i < kRun; i += 13) {
          const float moving = coordinate_of_run(first, i);
          const Eigen::Vector3f position =
              along == Along::x ? Eigen::Vector3f(moving, 0, fixed) : Eigen::Vector3f(fixed, 0, moving);
          const Rounded exact = law.round_to_binary32(position);
          ASSERT_TRUE(same_bits(run.x[i], exact.force.x()) && same_bits(run.z[i], exact.force.z()) &&
                      run.status[i] == exact.status)
              << name.name << ", R = " << show(p.radius) << ", w = " << show(p.width) << " at " << show(position);
        }
      }
    }
  }
  std::printf("  %zu of %zu positions one by one\n", one_by_one, positions);
  EXPECT_GT(one_by_one, 0U) << "no run was hard";
  EXPECT_LT(one_by_one, positions / 20);
}

TEST(run, finds_the_two_positions_on_both_sides_of_the_surface) {
  std::mt19937_64 random(6);
  std::size_t positions = 0, one_by_one = 0;
  for (const LawName& name : kLaws) {
    if (!has_bump_geometry(name.id)) continue;
    for (const Parameters& p : tests::parameter_sets()) {
      if (p.width == 2 * p.radius) continue;
      const auto law = std::get<Law>(Law::build(name.id, p));
      for (int k = 0; k < 3; ++k) {
        const float far = std::ldexp(p.width / 2, -static_cast<int>(random() % 8)) * 0.99F;
        const std::uint32_t first =
            std::bit_cast<std::uint32_t>(k == 0 ? 0x1p-40F : far) & ~static_cast<std::uint32_t>(kRun - 1);
        const SurfaceRun run = surface_run(law, first);
        ASSERT_GT(run.count, 0U);
        positions += run.count;
        one_by_one += run.one_by_one;
        for (std::size_t i = random() % 31; i < run.count; i += 31) {
          const float x = coordinate_of_run(first, i), free = run.free[i], contact = run.contact[i];
          const auto status = [&](float z) { return law.round_to_binary32({x, 0, z}).status; };
          ASSERT_TRUE(status(contact) == Status::contact && status(free) == Status::free)
              << name.name << ", R = " << show(p.radius) << ", w = " << show(p.width) << " at x = " << show(x);
          ASSERT_TRUE(free == std::nextafter(contact, free) || (free == 0 && contact == -0x1p-30F) ||
                      (free == 0x1p-30F && contact == 0))
              << show(contact) << ' ' << show(free) << " are not neighbours";
        }
      }
    }
  }
  std::printf("  %zu of %zu positions one by one\n", one_by_one, positions);
  EXPECT_LT(one_by_one, positions);
}

TEST(run, goes_up_to_the_edge_of_the_bump_and_no_farther) {
  const Parameters p{15.24F, 25.4F, 0.5F};
  const auto edge = std::bit_cast<std::uint32_t>(p.width / 2), first = edge & ~static_cast<std::uint32_t>(kRun - 1);
  const SurfaceRun run = surface_run(std::get<Law>(Law::build(LawId::bump_2p, p)), first);
  ASSERT_EQ(run.count, edge - first + 1);
  EXPECT_EQ(run.free[run.count - 1], 0) << "the surface meets the plane";
  EXPECT_EQ(run.contact[run.count - 1], -0x1p-30F);
}

TEST(run, of_one_answer_outside_the_domain_and_below_the_quantum) {
  const auto law = std::get<Law>(Law::build(LawId::bump_2p, {15.24F, 25.4F, 0.5F}));
  const RoundedRun outside = round_run(law, Along::x, -1, 0x7F800000U);  // infinity, then NaN
  const RoundedRun tiny = round_run(law, Along::x, -1, 0x80000000U);     // -0 and on: read as 0, so on the right face
  const Rounded middle = law.round_to_binary32({0, 0, -1});
  for (std::size_t i = 0; i < kRun; ++i) {
    ASSERT_EQ(outside.status[i], Status::invalid);
    ASSERT_TRUE(same_bits(outside.x[i], 0) && same_bits(outside.z[i], 0));
    ASSERT_TRUE(same_bits(tiny.x[i], middle.force.x()) && same_bits(tiny.z[i], middle.force.z()));
  }
}

}  // namespace
}  // namespace forceshade::reference
