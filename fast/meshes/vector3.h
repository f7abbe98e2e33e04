// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Three numbers of any kind: one text of a predicate serves binary64, its error analysis and exact integers.

#include "fast/numbers/fixed_integer.h"
#include "fast/numbers/inline.h"

namespace forceshade::fast {

template <class T>
struct Vector3 {
  T x, y, z;
};

template <class A, class B>
FORCESHADE_INLINE constexpr auto operator-(const Vector3<A>& a, const Vector3<B>& b) noexcept {
  return Vector3<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
FORCESHADE_INLINE constexpr auto cross(const Vector3<A>& a, const Vector3<B>& b) noexcept {
  return Vector3<decltype(a.x * b.x - a.x * b.x)>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class A, class B>
FORCESHADE_INLINE constexpr auto dot(const Vector3<A>& a, const Vector3<B>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A>
FORCESHADE_INLINE constexpr auto square(const Vector3<A>& a) noexcept {
  return dot(a, a);
}

// The largest component's size.
FORCESHADE_INLINE double size_of(const Vector3<double>& a) noexcept {
  const double x = __builtin_fabs(a.x), y = __builtin_fabs(a.y), z = __builtin_fabs(a.z);
  const double larger = x > y ? x : y;
  return larger > z ? larger : z;
}

// a - b: each component rounded once.
FORCESHADE_INLINE Vector3<double> difference(const float* a, const float* b) noexcept {
  return {static_cast<double>(a[0]) - static_cast<double>(b[0]), static_cast<double>(a[1]) - static_cast<double>(b[1]),
          static_cast<double>(a[2]) - static_cast<double>(b[2])};
}

// The same in units of 2^-53 mm.
using ExactDifference = Vector3<FixedInteger<68>>;
inline ExactDifference exact_difference(const float* a, const float* b) noexcept {
  return {in_units(a[0]) - in_units(b[0]), in_units(a[1]) - in_units(b[1]), in_units(a[2]) - in_units(b[2])};
}

}  // namespace forceshade::fast
