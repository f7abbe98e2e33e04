// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Damping in binary64, with bounds of its errors: damping.g proves those of the parts, and the comments here add them up.
// Real: binary64, several of them, or a number that writes down what is done with it (tests/fast/recorded_number.h).

#include <array>
#include <cstdint>

#include "fast/meshes/vector3.h"
#include "fast/numbers/first_stage.h"
#include "fast/numbers/row.h"

namespace forceshade::fast {

// The largest error of a part, of the scale that damping.g measures it by. The proofs leave a third of it, or more, which
// covers the roundings of the scales, of their sums, and of the ends of an enclosure.
inline constexpr double kDampingError = 0x1p-49;

template <class Real>
FORCESHADE_INLINE Real sum_of_three(const Vector3<Real>& a) noexcept {
  return (a.x + a.y) + a.z;
}

// r(x - x⁻), mm/s for a period.
template <class Real>
FORCESHADE_INLINE Real speed_between(const Real& x, const Real& before, const Real& rate) noexcept {
  return rate * (x - before);
}
// v + α(u - v), before it is rounded.
template <class Real>
FORCESHADE_INLINE Real velocity_after(const Real& v, const Real& speed, const Real& share) noexcept {
  return v + share * (speed - v);
}

// The quotients of a velocity v and a force f that is not 0.
template <class Real>
struct AlongForce {
  Real square;  // f²
  Real ratio;   // v·f/f²
  Real size;    // Σ|v_i f_i|/f²

  // products: v_i f_i; squares: f_i². All are exact.
  FORCESHADE_INLINE AlongForce(const Vector3<Real>& products, const Vector3<Real>& squares) noexcept
      : square(sum_of_three(squares)) {
    const Real inverse = Real(1) / square;
    ratio = sum_of_three(products) * inverse;
    size = sum_of_three(Vector3<Real>{absolute(products.x), absolute(products.y), absolute(products.z)}) * inverse;
  }

  // B (v·f)/f²: 1 - s, before the limits.
  FORCESHADE_INLINE Real turn(const Real& damping) const noexcept { return damping * ratio; }
};

// v less its part along f.
template <class Real>
FORCESHADE_INLINE Real across_force(const Real& v, const Real& f, const Real& ratio) noexcept {
  return v - ratio * f;
}

// s f²/F₀², before the limit.
template <class Real>
FORCESHADE_INLINE Real fullness(const Real& scale, const Real& square, const Real& per_square) noexcept {
  return scale * square * per_square;
}

// ---- Three numbers side by side; the fourth is 0.

FORCESHADE_INLINE Quad three(const float* a) noexcept {
  return {to_binary64(a[0], a[1]), Pair64{static_cast<double>(a[2]), 0}};
}
FORCESHADE_INLINE Vector3<double> each_of(const Quad& a) noexcept {
  return {a.low[0], a.low[1], a.high[0]};
}
FORCESHADE_INLINE std::array<float, 3> in_binary32(const Quad& a) noexcept {
  return {static_cast<float>(a.low[0]), static_cast<float>(a.low[1]), static_cast<float>(a.high[0])};
}

// The binary32 that all numbers within `reach` of the value round to; is_sure: there is one, in every lane.
struct SurelyRounded {
  Four32 value;  // -0 is possible
  bool is_sure;
};
FORCESHADE_INLINE SurelyRounded surely_rounded(const Quad& value, const Quad& reach) noexcept {
  const Four32 low = to_binary32(value - reach);
  return {low, are_equal(low, to_binary32(value + reach))};
}

// The velocities after a period in which the hand went from `before` to x.
FORCESHADE_INLINE SurelyRounded filtered_velocity(const Quad& v, const Quad& x, const Quad& before, double rate,
                                                  double share) noexcept {
  const Quad speed = speed_between(x, before, Quad(rate));
  // Error: 9 units of 2^-53 of the larger of |v| and |u|, piece velocity.
  return surely_rounded(velocity_after(v, speed, Quad(share)), Quad(kDampingError) * (absolute(v) + absolute(speed)));
}

// a: normal.
FORCESHADE_INLINE bool is_power_of_two(double a) noexcept {
  constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52) - 1;
  return (__builtin_bit_cast(std::uint64_t, a) & kFraction) == 0;
}

// The error of a - b.
FORCESHADE_INLINE Quad error_of_difference(const Quad& a, const Quad& b) noexcept {
  return absolute(two_sum(a, Quad(0.0) - b).lo);
}

// The same where α is a power of two, and x - x⁻ a binary32 number. Then x - x⁻ and r(x - x⁻) are exact, since an error of x -
// x⁻ would be a coordinate below 2^-39 mm. The two sums often are exact, too, and ties are decided: with α = 1/2 and 1000 Hz
// every second velocity is one.
FORCESHADE_INLINE SurelyRounded velocity_of_short_numbers(const Quad& v, const Quad& x, const Quad& before, double rate,
                                                          double share) noexcept {
  const Quad way = x - before, speed = Quad(rate) * way, part = Quad(share) * (speed - v);
  const Quad errors = absolute(way - to_binary64(to_binary32(way))) +
                      (error_of_difference(speed, v) + error_of_difference(v, Quad(0.0) - part));
  return {to_binary32(v + part), is_power_of_two(share) && are_at_most(errors, 0)};
}

// The damped force, and sure only where no component of f is above 2^26 N in size or NaN. numbers: of fast::Damping.
//
// s is the limited number, and limits make no error larger; one that may be 0 or not stays as it is. With e = 2^-53, E = B·size
// and primes for exact numbers, |s - s'| <= 7eE + e|s| (piece turn, and the subtraction), so s f_i is off by (7E + 2|s|)e|f_i|,
// which 16e(E + |s|)|f_i| covers. Where s is certainly at the limit S, it has no error: S f_i is then a binary64 number, as 24
// and 24 bits are. The drag is λ B_t c, c across f. c is off by at most 9e(|v_i| + size|f_i|) (piece across); l = s f²/F₀² by
// 5e·l (piece full) and, through s, by (7E + |s|)e f²/F₀², for which 16e(E + 2|s|) f²/F₀² is charged. The two products and the
// last difference are rounded by 3e of what they are made of.
template <class Numbers>
FORCESHADE_INLINE SurelyRounded filtered_force(const Quad& v, const Quad& f, const Numbers& numbers) noexcept {
  const AlongForce<double> along(each_of(v * f), each_of(f * f));
  if (!(along.square < 0x1p52)) [[unlikely]]
    return {Four32{}, false};
  if (along.square == 0) return {Four32{}, true};
  double scale = 1 - along.turn(numbers.damping);
  double error = kDampingError * (__builtin_fabs(scale) + numbers.damping * along.size);
  if (scale + error <= 0) return {Four32{}, true};
  if (scale > numbers.most) [[unlikely]] {
    if (scale - error >= numbers.most) error = 0;
    scale = numbers.most;
  }
  Quad value = Quad(scale) * f, reach = Quad(error) * absolute(f);
  if (numbers.drag != 0) {
    const double charged = error + kDampingError * scale;
    double full = fullness(scale, along.square, numbers.per_square);
    double full_error = charged * (along.square * numbers.per_square);
    if (full - full_error >= 1) full_error = 0;
    if (full > 1) full = 1;
    const Quad size = absolute(v) + Quad(along.size) * absolute(f);
    value = value - Quad(full * numbers.drag) * across_force(v, f, Quad(along.ratio));
    reach = Quad(charged) * absolute(f) + Quad(numbers.drag * (kDampingError * full + full_error)) * size;
  }
  return surely_rounded(value, reach);
}

}  // namespace forceshade::fast
