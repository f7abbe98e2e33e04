// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A supervised hand for tests, under no rule but those a test sets.

#include <gtest/gtest.h>

#include <cmath>

#include "device/supervisor.h"

namespace forceshade::device {

using Force = Eigen::Vector3f;

inline constexpr double kRate = 1000;
inline const float kNan = std::nanf("");

// No rule but those the test sets.
inline SupervisorLimits lenient() {
  SupervisorLimits limits;
  limits.slew = SupervisorLimits::kNone;
  limits.felt_free = limits.ramp_up = 0;
  return limits;
}

// A hand in contact that trembles by a count, past its gentle start.
class Hand {
 public:
  explicit Hand(const SupervisorLimits& limits, double rate = kRate) : supervisor(limits, rate) {
    for (int tick = 0; tick < 2; ++tick) supervise({0, 0, 0}, Status::free);
  }

  Verdict supervise(const Force& desired, Status status = Status::contact) {
    reading.position.y() += tremor;
    tremor = -tremor;
    return supervisor.supervise(reading, state, desired, unfinished ? Status::unfinished : status, late);
  }
  Verdict supervise_for(int ticks, const Force& desired) {
    Verdict verdict;
    for (int tick = 0; tick < ticks; ++tick) verdict = supervise(desired);
    return verdict;
  }

  Supervisor supervisor;
  Reading reading{.position = {1, 2, -1}};
  State state;
  double late = 0;
  bool unfinished = false;
  float tremor = 0.03F;
};

inline void expect_only(const Verdict& verdict, Rule rule) {
  for (std::size_t i = 0; i < kRules; ++i) {
    const Rule other = static_cast<Rule>(i);
    EXPECT_EQ(verdict.limited.has(other), other == rule) << name_of(other);
  }
}

inline void expect_tripped(const Verdict& verdict, Rule rule) {
  ASSERT_TRUE(verdict.trip) << name_of(rule);
  EXPECT_EQ(name_of(*verdict.trip), name_of(rule));
  EXPECT_EQ(verdict.force, Force(0, 0, 0));
}

}  // namespace forceshade::device
