// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tests of laws and height maps alike, on positions that the caller aims.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <string>

#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::tests {

// One law with its parameters, or one height map with its rendering; both sides. `name` is for messages.
struct Tested {
  std::string name;
  std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate;
  std::function<reference::Rounded(const Eigen::Vector3f& position)> exact;
  std::function<fast::BatchResult(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> to,
                                  fast::InstructionSet)>
      batch;
};

// The number of times each was met: by number of fast::Stage, reference::Method and Status.
struct Met {
  std::array<int, 3> stages{}, methods{}, statuses{};
};

// Every claim ends with the test's first failure. The force and the status are the reference's.
void expect_rounded_reference(const Tested& tested, std::span<const Eigen::Vector3f> positions, Met& met);
// A batch gives the bits of single calls, by every instruction set, to another place and in place, and counts what is invalid.
void expect_scalar_at_every_simd_width(const Tested& tested, std::span<const Eigen::Vector3f> positions);
// NaN, infinities and what is beyond 10⁴ mm, along each axis; the ends of the domain are valid.
void expect_invalid_positions_reported(const Tested& tested);
void expect_tiny_coordinates_read_as_zero(const Tested& tested, std::span<const Eigen::Vector3f> positions);
void expect_no_negative_zero(const Tested& tested, std::span<const Eigen::Vector3f> positions);
// By single calls.
void expect_no_allocation(const Tested& tested, std::span<const Eigen::Vector3f> positions);

}  // namespace forceshade::tests
