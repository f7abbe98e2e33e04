// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a contact rule gives in real time: the point that the god-object went for.

#include <array>

namespace forceshade::fast {

struct Goal {
  bool is_decided = true;        // false: the last stage cannot decide the rule, and nothing has moved
  bool is_position = true;       // the hand's position itself
  std::array<float, 3> point{};  // any other: mm, in the domain and quantised
};

}  // namespace forceshade::fast
