// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force at rest, exactly: to be rounded once to binary32 or to decimal digits.

#include <string>

#include "reference/meshes/rounding.h"
#include "reference/meshes/schemes/scheme.h"

namespace forceshade::reference::meshes {

// K (|D_n| N/|N| + D_t), in N; K D where there is no direction, or N·D_n <= 0. stiffness: N/mm.
std::array<RootSum, 3> exact_force(const Direction& seen_from_front, const Rest& rest, float stiffness);

// Correctly rounded to so many significant decimal digits, ties to even.
std::string decimal(const RootSum& value, unsigned digits);

}  // namespace forceshade::reference::meshes
