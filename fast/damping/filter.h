// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Damping in binary64, with bounds of its errors: damping.g proves those of the parts, and the comments here add them up.
// Real: binary64, several of them, or a number that writes down what is done with it (tests/fast/recorded_number.h).

#include <algorithm>
#include <array>
#include <cstdint>

#include "fast/meshes/vector3.h"
#include "fast/numbers/first_stage.h"
#include "fast/numbers/row.h"

namespace forceshade::fast {

// At least the largest error of a part, of the scale that damping.g measures it by. What is charged leaves a third or more of
// itself over the sum of the parts; that covers the roundings of the scales, of their sums, and of the ends of an enclosure.
inline constexpr double kDampingError = 0x1p-49;

template <class Real>
FORCESHADE_INLINE Real sum_of_three(const Vector3<Real>& a) noexcept {
  return (a.x + a.y) + a.z;
}

// The velocity after a period, mm/s: v + α(r(x - x⁻) - v), as what is kept of v and what is gained. keep: 1 - α; gain: αr. Both
// are exact in binary64.
template <class Real>
struct VelocityAfter {
  Real way, kept, gained, value;  // value: before it is rounded to binary32

  FORCESHADE_INLINE VelocityAfter(const Real& v, const Real& x, const Real& before, const Real& keep, const Real& gain) noexcept
      : way(x - before), kept(keep * v), gained(gain * way), value(kept + gained) {}
};

// A velocity v beside a force f that is not 0.
template <class Real>
struct AlongForce {
  Real square;  // f²
  Real sum;     // v·f
  Real size;    // Σ|v_i f_i|

  // products: v_i f_i; squares: f_i². All are exact.
  FORCESHADE_INLINE AlongForce(const Vector3<Real>& products, const Vector3<Real>& squares) noexcept
      : square(sum_of_three(squares)),
        sum(sum_of_three(products)),
        size(sum_of_three(Vector3<Real>{absolute(products.x), absolute(products.y), absolute(products.z)})) {}

  // B (v·f)/f², with v·f moved by the margin: 1 - s, before the limits.
  FORCESHADE_INLINE Real turn(const Real& damping, const Real& margin) const noexcept {
    return damping / square * (sum + margin);
  }
};

// s f²/F₀², before the limit.
template <class Real>
FORCESHADE_INLINE Real fullness(const Real& scale, const Real& square, const Real& per_square) noexcept {
  return scale * (square * per_square);
}

// The factor of f in s f - q (v - ratio f), which is pressed(…) f - q v. ratio: v·f/f²; q: λ B_t.
template <class Real>
FORCESHADE_INLINE Real pressed(const Real& scale, const Real& drag, const Real& ratio) noexcept {
  return scale + drag * ratio;
}

// ---- Three numbers side by side; the fourth is 0.

FORCESHADE_INLINE Four32 three(float a) noexcept {
  return Four32{a, a, a, 0};
}
FORCESHADE_INLINE Four32 three(const float* a) noexcept {
  return Four32{a[0], a[1], a[2], 0};
}
FORCESHADE_INLINE Quad three_in_binary64(const float* a) noexcept {
  return {to_binary64(a[0], a[1]), Pair64{static_cast<double>(a[2]), 0}};
}
FORCESHADE_INLINE Vector3<double> each_of(const Quad& a) noexcept {
  return {a.low[0], a.low[1], a.high[0]};
}

// The roundings of the ends of an interval to binary32; of all of it where they are the same, in every lane.
struct Rounded {
  Four32 value, other;  // -0 is possible

  FORCESHADE_INLINE bool is_sure() const noexcept { return are_equal(value, other); }
};
FORCESHADE_INLINE Rounded rounded(const Quad& low, const Quad& high) noexcept {
  return {to_binary32(low), to_binary32(high)};
}

// The velocities after a period in which the hand went from `before` to x. numbers: of fast::Damping.
//
// Where α is a power of two, and x - x⁻ a binary32 number, kept and gained are exact: an error of x - x⁻ would be a coordinate
// below 2^-39 mm. Their sum often is exact, too: it is if both terms come back from it, since its error is a multiple of the
// smaller of their last places, and at most half of it then. So ties are decided: with α = 1/2 and 1000 Hz every second
// velocity is one. Else the error is 5 units of 2^-53 of the larger of |kept| and |gained| (piece velocity).
template <class Numbers>
FORCESHADE_INLINE Rounded filtered_velocity(const Quad& v, const Quad& x, const Quad& before, const Numbers& numbers) noexcept {
  const VelocityAfter<Quad> after(v, x, before, Quad(numbers.keep), Quad(numbers.gain));
  if (numbers.is_short && are_equal(after.way, to_binary64(to_binary32(after.way))) &&
      (numbers.keep == 0 ||
       (are_equal(after.value - after.kept, after.gained) && are_equal(after.value - after.gained, after.kept))))
    return rounded(after.value, after.value);
  const Quad reach = Quad(kDampingError) * (absolute(after.kept) + absolute(after.gained));
  return rounded(after.value - reach, after.value + reach);
}

// The damped force, and sure only where no component of f is above 2^26 N in size or NaN. numbers: of fast::Damping.
//
// With e = 2^-53, E = B·size/f² and primes for exact numbers, 1 - turn is off by at most 7eE (piece turn) and e|s|, and its
// product with f_i by e|s f_i|: 9e(E + 1) or less, for which the ends take 16e(E + 1). Limits make no error larger. At the
// limit S both ends are the same, and S f_i is a binary64 number, as 24 and 24 bits are.
//
// With drag F = s f - q c, with q = λ B_t and c = v - ratio f across f. q is between its ends, which are off by 6e of them
// (piece full, and B_t), and at most `across` from the one that is taken; c_i is at most |v_i| + size|f_i|/f². The rest is off
// by 15e times s|f_i| + q(|v_i| + size|f_i|/f²) (piece force). 32e of s and of q are charged.
template <class Numbers>
FORCESHADE_INLINE Rounded filtered_force(const Quad& v, const Quad& f, const Numbers& numbers) noexcept {
  const AlongForce<double> along(each_of(v * f), each_of(f * f));
  constexpr Four32 kNone{}, kUnsure{1};
  if (!(along.square > 0 && along.square < 0x1p52)) return {kNone, along.square == 0 ? kNone : kUnsure};
  const double margin = kDampingError * along.size;
  const double most = std::min((1 + kDampingError) - along.turn(numbers.damping, -margin), numbers.most);
  if (most <= 0) return {kNone, kNone};
  const double least = std::min((1 - kDampingError) - along.turn(numbers.damping, margin), numbers.most);
  if (!numbers.has_drag) return rounded(Quad(least) * f, Quad(most) * f);
  const auto drag_at = [&](double scale) {
    return numbers.drag * std::min(fullness(scale, along.square, numbers.per_square), 1.0);
  };
  const double drag = drag_at(least), across = (drag_at(most) - drag) + 2 * kDampingError * drag_at(most);
  const double inverse = 1 / along.square;
  const double error = (most - least) + 2 * kDampingError * most + across * (along.size * inverse);
  const Quad value = Quad(pressed(least, drag, along.sum * inverse)) * f - Quad(drag) * v;
  const Quad reach = Quad(error) * absolute(f) + Quad(across) * absolute(v);
  return rounded(value - reach, value + reach);
}

}  // namespace forceshade::fast
