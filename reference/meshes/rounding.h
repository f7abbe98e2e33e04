// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fractions, square roots of fractions and their sums, rounded to the nearest binary32.

#include "reference/meshes/integers.h"

namespace forceshade::reference::meshes {

// (whole + root) / under · 2^exponent, with a root that is ±√square; square >= 0, under > 0.
struct RootSum {
  Integer whole = 0;
  bool root_is_negative = false;
  Integer square = 0;
  Integer under = 1;
  int exponent = 0;
};

// The sign of the value less over / under; under > 0.
int compared(const RootSum& value, const Integer& over, const Integer& under);

// Correctly rounded: to nearest, ties to even, subnormal numbers included, a zero +0. The size of the value must be below
// 2^128 - 2^103, where binary32 overflows.
float nearest_binary32(const RootSum& value);

// value · 2^exponent, in the same way.
float nearest_binary32(const Fraction& value, int exponent);

// √value · 2^exponent, in the same way; value >= 0.
float nearest_binary32_root(const Fraction& value, int exponent);

// value · 2^scale, which must be an integer.
Integer integer_of(float value, int scale);

}  // namespace forceshade::reference::meshes
