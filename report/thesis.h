// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bumps of the thesis's experiments (5.5): five radii, one width.

#include <array>

namespace forceshade::properties {

struct ThesisRadius {
  int mil;
  float mm;
};

inline constexpr std::array<ThesisRadius, 5> kThesisRadii{
    {{600, 15.24F}, {800, 20.32F}, {1000, 25.4F}, {1200, 30.48F}, {1400, 35.56F}}};
inline constexpr float kThesisWidth = 25.4F;  // mm: 1000 mil

}  // namespace forceshade::properties
