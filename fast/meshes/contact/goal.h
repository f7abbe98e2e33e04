// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact rule's answer in real time: the point that the god-object went for; and that point beside the hand's position.

#include <array>

namespace forceshade::fast {

struct Goal {
  bool is_decided = true;        // false: the last stage cannot decide the rule, and nothing has moved
  bool is_position = true;       // the hand's position itself
  std::array<float, 3> point{};  // any other: mm, in the domain and quantised
};

// The hand's position, from which the force is drawn, and the goal, which nearly always is the same point. Hand and goal live
// longer.
class HandAndGoal {
 public:
  explicit HandAndGoal(const std::array<float, 3>& hand) noexcept : hand_(hand.data()), goal_(hand.data()) {}
  HandAndGoal(const std::array<float, 3>& hand, const Goal& goal) noexcept
      : hand_(hand.data()), goal_(goal.is_position ? hand.data() : goal.point.data()) {}

  const float* hand() const noexcept { return hand_; }
  const float* goal() const noexcept { return goal_; }
  bool are_one() const noexcept { return goal_ == hand_; }

 private:
  const float *hand_, *goal_;  // mm, in the domain and quantised
};

}  // namespace forceshade::fast
