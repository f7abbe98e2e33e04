// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force at rest: each component rounded once to binary32, or in decimal digits.

#include <string>

#include "reference/meshes/schemes/scheme.h"

namespace forceshade::reference::meshes {

// K D; stiffness in N/mm, the force in N.
std::array<float, 3> unshaded_force(const Rest& rest, float stiffness);

// K |D| N/|N|; K D where there is no direction, or N·D <= 0.
std::array<float, 3> shaded_force(const Direction& seen_from_front, const Rest& rest, float stiffness);

// ±√square · 2^exponent.
struct Root {
  bool is_negative = false;
  Fraction square;
  int exponent = 0;
};

// The components of shaded_force(), exactly; of unshaded_force() where there is no direction.
std::array<Root, 3> exact_force(const Direction& seen_from_front, const Rest& rest, float stiffness);

// Correctly rounded to so many significant decimal digits, ties to even.
std::string decimal(const Root& root, unsigned digits);

}  // namespace forceshade::reference::meshes
