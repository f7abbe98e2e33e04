// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The sign of a polynomial: in binary64 with a bound of its error, and where that holds 0 in integers. A polynomial is written
// once for both numbers, is homogeneous in each point and each direction, and so has one sign however long these are given.

#include <cmath>
#include <cstdint>

#include "fast/meshes/bounded_vector3.h"
#include "fast/numbers/inline.h"
#include "fast/soups/whole.h"

namespace forceshade::fast::soups {

// |true value - value| <= error. kLeast covers what is lost below the least normal number, in the value and in its bound: at
// most 2^-1075 in each of the four operations of a product. In a quotient the divisor multiplies it (operator/).
struct Ball {
  double value = 0, error = 0;

  static constexpr double kUnit = 0x1p-53, kSlack = kSlackOfSum, kLeast = 0x1p-1040;

  FORCESHADE_INLINE static Ball exactly(double value) noexcept { return {value, 0}; }
  FORCESHADE_INLINE static Ball of(std::int64_t value) noexcept { return {static_cast<double>(value), 0}; }
  FORCESHADE_INLINE static Ball rounded(double value, double propagated) noexcept {
    return {value, kSlack * (propagated + kUnit * __builtin_fabs(value)) + kLeast};
  }
  FORCESHADE_INLINE bool is_sure() const noexcept { return __builtin_fabs(value) > error; }

  FORCESHADE_INLINE Ball operator-() const noexcept { return {-value, error}; }
  FORCESHADE_INLINE friend Ball operator+(const Ball& a, const Ball& b) noexcept {
    return rounded(a.value + b.value, a.error + b.error);
  }
  FORCESHADE_INLINE friend Ball operator-(const Ball& a, const Ball& b) noexcept {
    return rounded(a.value - b.value, a.error + b.error);
  }
  FORCESHADE_INLINE friend Ball operator*(const Ball& a, const Ball& b) noexcept {
    return rounded(a.value * b.value, __builtin_fabs(a.value) * b.error + (__builtin_fabs(b.value) + b.error) * a.error);
  }
  // A divisor that may be 0 gives an infinite error. The exact quotient of the values is within 2^-1075 of what is rounded, and
  // is multiplied by the divisor's error; what the product loses comes to that. Both are divided by a `size` that may be small,
  // so kLeast stands in for them before the division, too.
  FORCESHADE_INLINE friend Ball operator/(const Ball& a, const Ball& b) noexcept {
    const double size = __builtin_fabs(b.value) - b.error;
    if (!(size > 0)) return {0, HUGE_VAL};
    const double quotient = a.value / b.value;
    return rounded(quotient, (a.error + (__builtin_fabs(quotient) + kLeast) * b.error + kLeast) / size);
  }
  FORCESHADE_INLINE Ball shifted(int count) const noexcept { return {std::ldexp(value, count), std::ldexp(error, count)}; }
};

template <class N>
Vector3<N> operator+(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
Vector3<N> operator-(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
Vector3<N> operator-(const Vector3<N>& a) noexcept {
  return {-a.x, -a.y, -a.z};
}
template <class N>
Vector3<N> operator*(const N& t, const Vector3<N>& a) noexcept {
  return {t * a.x, t * a.y, t * a.z};
}
template <class N>
Vector3<N> cross(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class N>
N dot(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
N squared(const Vector3<N>& a) noexcept {
  return dot(a, a);
}
template <class N>
N determinant(const Vector3<N>& a, const Vector3<N>& b, const Vector3<N>& c) noexcept {
  return dot(cross(a, b), c);
}
template <class N>
Vector3<N> signed_by(int sign, const Vector3<N>& a) noexcept {
  return sign < 0 ? -a : a;
}

// Integers count units of 2^-53 mm.
inline constexpr int kUnitBits = 53;
template <class N>
N coordinate(float value) noexcept;
template <>
FORCESHADE_INLINE Ball coordinate<Ball>(float value) noexcept {
  return Ball::exactly(static_cast<double>(value));
}
template <>
inline Whole coordinate<Whole>(float value) noexcept {
  const auto bits = __builtin_bit_cast(std::uint32_t, value);
  const auto exponent = static_cast<int>(bits >> 23 & 0xFFU);
  if (exponent == 0) return {};
  const auto significand = static_cast<std::int64_t>((bits & 0x7FFFFFU) | 0x800000U);
  return Whole::scaled((bits >> 31) != 0 ? -significand : significand, exponent - (127 - 30));
}
template <class N>
FORCESHADE_INLINE Vector3<N> corner_point(const float* a) noexcept {
  return {coordinate<N>(a[0]), coordinate<N>(a[1]), coordinate<N>(a[2])};
}

// a/b units, in mm.
inline Ball ball_of(const Whole& a, const Whole& b) noexcept {
  if (a.is_zero()) return {};
  const double value = std::ldexp(ratio(a, b), -kUnitBits);
  return {value, Whole::kRatioError * std::fabs(value) + Ball::kLeast};
}
inline Vector3<Ball> ball_of(const Vector3<Whole>& a, const Whole& b) noexcept {
  return {ball_of(a.x, b), ball_of(a.y, b), ball_of(a.z, b)};
}

// The number of signs that binary64 has left to integers, where it is not null; for tests and measurements.
inline thread_local std::uint64_t* exact_decisions = nullptr;
inline void note_exact_decision() noexcept {
  if (exact_decisions != nullptr) ++*exact_decisions;
}

// value<N>(): the number, as a Ball and as a Whole.
template <class Value>
int sign_of(const Value& value) noexcept {
  const Ball about = value.template operator()<Ball>();
  if (about.is_sure()) [[likely]]
    return about.value > 0 ? 1 : -1;
  note_exact_decision();
  return value.template operator()<Whole>().sign();
}

// The integer at or below num/den, den > 0, and whether they are equal; 0 <= num/den < 2^26. value<N>(): {num, den}.
struct Floor {
  std::int64_t floor;
  bool is_whole;
};
template <class Value>
Floor floor_of(const Value& value) noexcept {
  const auto [num, den] = value.template operator()<Ball>();
  const Ball about = num / den;
  const double below = std::floor(about.value);
  if (about.value - about.error > below && about.value + about.error < below + 1)
    return {static_cast<std::int64_t>(below), false};
  note_exact_decision();
  const auto [over, under] = value.template operator()<Whole>();
  auto floor = static_cast<std::int64_t>(std::floor(ratio(over, under)));
  int sign = (over - Whole(floor) * under).sign();
  if (sign < 0) {
    --floor;
  } else if (const int above = (over - Whole(floor + 1) * under).sign(); above >= 0) {
    ++floor;
    sign = above;
  }
  return {floor, sign == 0};
}
// The nearest integer, ties to even.
template <class Value>
std::int64_t nearest_of(const Value& value) noexcept {
  const Floor halves = floor_of([&]<class N>() {
    auto both = value.template operator()<N>();
    both.num = both.num.shifted(1);
    return both;
  });
  const std::int64_t floor = halves.floor >> 1;
  if ((halves.floor & 1) == 0) return floor;
  return halves.is_whole && (floor & 1) == 0 ? floor : floor + 1;
}

template <class N>
struct Quotient {
  N num, den;
};

}  // namespace forceshade::fast::soups
