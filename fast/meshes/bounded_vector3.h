// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sums of products of three numbers with one bound for all of their roundings. The general cross() and dot() of vector3.h, made
// of the operations of such numbers, have bounds as good, but each operation waits for the bound of the one before it: that
// chain is most of the time of a shaded force.

#include "fast/meshes/vector3.h"
#include "fast/numbers/double_with_error.h"

namespace forceshade::fast {

// Each product and each of up to two additions errs by 2^-53 of a number that is at most the sum of the products' sizes, times
// 1 + 2^-51 for the roundings in these. kSlackOfSum covers the up to 20 roundings of a bound, each of a sum or product of
// numbers that are not negative.
inline constexpr double kSlackOfSum = 1 + 0x1p-48;

// A number with a bound of its error. One of kLeast covers what is lost below the least normal number, in a sum and its bound.
template <class N>
concept Bounded = requires(const N& a) {
  a.value;
  a.error;
  N::kUnit;
};
template <Bounded N>
FORCESHADE_INLINE double bound_of_sum(double charged, double propagated) noexcept {
  const double bound = kSlackOfSum * (charged + propagated);
  if constexpr (requires { N::kLeast; })
    return bound + N::kLeast;
  else
    return bound;
}

// The share of the factors' errors in the error of their product.
template <Bounded N>
FORCESHADE_INLINE double handed_on(const N& a, const N& b) noexcept {
  return __builtin_fabs(a.value) * b.error + (__builtin_fabs(b.value) + b.error) * a.error;
}

// a b - c d
template <Bounded N>
FORCESHADE_INLINE N difference_of_products(const N& a, const N& b, const N& c, const N& d) noexcept {
  const double first = a.value * b.value, second = c.value * d.value;
  const double sizes = __builtin_fabs(first) + __builtin_fabs(second);
  return {first - second, bound_of_sum<N>(2 * N::kUnit * sizes, handed_on(a, b) + handed_on(c, d))};
}

template <Bounded N>
FORCESHADE_INLINE Vector3<N> cross(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

template <Bounded N>
FORCESHADE_INLINE N dot(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  const double x = a.x.value * b.x.value, y = a.y.value * b.y.value, z = a.z.value * b.z.value;
  const double sizes = __builtin_fabs(x) + __builtin_fabs(y) + __builtin_fabs(z);
  return {x + y + z, bound_of_sum<N>(3 * N::kUnit * sizes, handed_on(a.x, b.x) + handed_on(a.y, b.y) + handed_on(a.z, b.z))};
}

template <Bounded N>
FORCESHADE_INLINE N square(const Vector3<N>& a) noexcept {
  return dot(a, a);
}

}  // namespace forceshade::fast
