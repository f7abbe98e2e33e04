// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fractions and square roots of fractions, rounded to the nearest binary32.

#include "reference/meshes/integers.h"

namespace forceshade::reference::meshes {

// value · 2^exponent, correctly rounded: to nearest, ties to even, subnormal numbers included, a zero +0. Its size must be
// below 2^128 - 2^103, where binary32 overflows.
float nearest_binary32(const Fraction& value, int exponent);

// √value · 2^exponent, in the same way; value >= 0.
float nearest_binary32_root(const Fraction& value, int exponent);

// value · 2^scale, which must be an integer.
Integer integer_of(float value, int scale);

}  // namespace forceshade::reference::meshes
