// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exact force as a guaranteed enclosure of any width, in multiprecision numbers.

#include "forceshade/reference/law.h"
#include "forceshade/reference/numbers.h"

namespace forceshade::reference {

// low <= exact <= high.
struct Interval {
  Multiprecision low, high;
};

struct EnclosedForce {
  Interval x, z;  // N; F_y is 0
  Status status;
};

// Each component's interval is no wider than 10^-digits of its size; a component that is zero is [0, 0].
EnclosedForce enclosure(const Law& law, const Eigen::Vector3f& position, unsigned digits);

}  // namespace forceshade::reference
