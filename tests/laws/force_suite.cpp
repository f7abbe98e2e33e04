// SPDX-License-Identifier: BSD-3-Clause
#include "tests/laws/force_suite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "properties/binary32.h"
#include "tests/support/allocations.h"

namespace forceshade::tests {

using Eigen::Vector3f;
using properties::neighbour;
using properties::show;

namespace {

bool same_bits(const Vector3f& a, const Vector3f& b) {
  return properties::same_bits(a.x(), b.x()) && properties::same_bits(a.y(), b.y()) && properties::same_bits(a.z(), b.z());
}

}  // namespace

void expect_rounded_reference(const Tested& tested, std::span<const Vector3f> positions, Met& met) {
  for (const Vector3f& position : positions) {
    const fast::Evaluation answer = tested.evaluate(position);
    const reference::Rounded exact = tested.exact(position);
    ASSERT_EQ(answer.status, exact.status) << tested.name << " at " << show(position);
    ASSERT_TRUE(same_bits(answer.force, exact.force))
        << tested.name << " at " << show(position) << ": " << show(answer.force) << ", not " << show(exact.force);
    ++met.stages[static_cast<std::size_t>(answer.stage)];
    ++met.methods[static_cast<std::size_t>(exact.method)];
    ++met.statuses[static_cast<std::size_t>(answer.status)];
  }
}

void expect_scalar_at_every_simd_width(const Tested& tested, std::span<const Vector3f> positions) {
  std::vector<fast::Evaluation> single;
  std::size_t invalid = 0;
  for (const Vector3f& position : positions) {
    single.push_back(tested.evaluate(position));
    invalid += single.back().status == Status::invalid;
  }
  EXPECT_GT(invalid, 0U) << tested.name;
  for (const fast::InstructionSet set : fast::kInstructionSets) {
    if (!fast::is_available(set)) continue;
    std::vector<Vector3f> forces(positions.size(), Vector3f::Constant(-7)), in_place(positions.begin(), positions.end());
    EXPECT_EQ(tested.batch(positions, forces, set).invalid, invalid) << tested.name << ", " << fast::name_of(set);
    EXPECT_EQ(tested.batch(in_place, in_place, set).invalid, invalid) << tested.name << ", " << fast::name_of(set);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      ASSERT_TRUE(same_bits(forces[i], single[i].force))
          << tested.name << ", " << fast::name_of(set) << " at " << show(positions[i]) << ": " << show(forces[i]);
      ASSERT_TRUE(same_bits(in_place[i], single[i].force))
          << tested.name << ", in place, " << fast::name_of(set) << " at " << show(positions[i]);
    }
  }
}

void expect_invalid_positions_reported(const Tested& tested) {
  const float beyond = neighbour(1e4F, 1);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(), beyond, -beyond, 3e38F})
    for (int axis = 0; axis < 3; ++axis) {
      Vector3f position(1, 2, -1);
      position[axis] = bad;
      const fast::Evaluation answer = tested.evaluate(position);
      EXPECT_EQ(answer.status, Status::invalid) << tested.name << " at " << show(position);
      EXPECT_EQ(answer.force, Vector3f::Zero()) << tested.name << " at " << show(position);
    }
  EXPECT_NE(tested.evaluate({1e4F, -1e4F, 1e4F}).status, Status::invalid) << tested.name << ": the ends belong to the domain";
}

void expect_tiny_coordinates_read_as_zero(const Tested& tested, std::span<const Vector3f> positions) {
  const float largest_tiny = neighbour(0x1p-30F, -1);
  for (const Vector3f& position : positions)
    for (int axis = 0; axis < 3; ++axis) {
      Vector3f at = position;
      at[axis] = 0;
      const fast::Evaluation at_zero = tested.evaluate(at);
      for (const float tiny : {largest_tiny, -largest_tiny, std::numeric_limits<float>::denorm_min(), -0.0F}) {
        at[axis] = tiny;
        const fast::Evaluation answer = tested.evaluate(at);
        EXPECT_TRUE(same_bits(answer.force, at_zero.force)) << tested.name << " at " << show(at);
        EXPECT_EQ(answer.status, at_zero.status) << tested.name << " at " << show(at);
      }
    }
}

void expect_no_negative_zero(const Tested& tested, std::span<const Vector3f> positions) {
  for (const Vector3f& position : positions)
    for (const float component : tested.evaluate(position).force)
      EXPECT_FALSE(component == 0 && std::signbit(component)) << tested.name << " at " << show(position);
}

void expect_no_allocation(const Tested& tested, std::span<const Vector3f> positions) {
  const std::size_t before = allocations();
  float sum = 0;
  for (const Vector3f& position : positions) sum += tested.evaluate(position).force.norm();
  EXPECT_EQ(allocations(), before) << tested.name << ' ' << sum;
}

}  // namespace forceshade::tests
