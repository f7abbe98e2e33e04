// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bounds a predicate and its rounding error: the number on which the compiler runs a predicate's own text, once, to
// find the constant of its error bound.

namespace forceshade::fast {

// |computed| <= size and |computed - true| <= error. A predicate is linear in each vector that it multiplies, so with vectors
// of components up to 1 in size the bounds hold as factors of the product of the vectors' largest components. The bound needs
// that no operation is inexact by underflow: the vectors are whole multiples of 2^-53 mm and up to 2^40 in size, and a product
// of nine of them is whole multiples of 2^-477.
struct RoundingBound {
  double size, error;

  static constexpr double kUnit = 0x1p-53;
  static constexpr double kSlack = 1 + 0x1p-40;  // more than the roundings of these bounds, here and where they are multiplied

  static constexpr RoundingBound rounded(double size, double propagated) noexcept {
    return {kSlack * size, kSlack * (propagated + kUnit * size)};
  }
  friend constexpr RoundingBound operator+(const RoundingBound& a, const RoundingBound& b) noexcept {
    return rounded(a.size + b.size, a.error + b.error);
  }
  friend constexpr RoundingBound operator-(const RoundingBound& a, const RoundingBound& b) noexcept { return a + b; }
  friend constexpr RoundingBound operator*(const RoundingBound& a, const RoundingBound& b) noexcept {
    return rounded(a.size * b.size, a.size * b.error + b.size * a.error + a.error * b.error);
  }
};

}  // namespace forceshade::fast
