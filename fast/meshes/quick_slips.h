// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides for friction in a triangle, in binary64 and from the grid's parameters alone, as nearly every tick in contact does.
// With (k, l) the parameters of the god-object's point g, and Q those of p's nearest point q of the plane, the pull is
// |c1 e1 + c2 e2| with c = Q - (k, l), in units of 2^-24 mm; this needs neither g nor p - g. Where a decision is not sure,
// slips.h takes it from g.

#include "fast/meshes/friction.h"

namespace forceshade::fast {

// e1², e1·e2 and e2².
template <class T>
struct Gram {
  T first, mixed, second;
};
template <class C, class T>
FORCESHADE_INLINE constexpr auto pull_squared(const C& c1, const C& c2, const Gram<T>& of) noexcept {
  return c1 * (c1 * of.first + c2 * of.mixed) + c2 * (c1 * of.mixed + c2 * of.second);
}
// The change of the square of the distance from p in a step of the grid along the edge whose square is `own`. c: where the
// step begins.
template <class C, class T>
FORCESHADE_INLINE constexpr auto gain_by_step(const C& own_c, const C& other_c, const T& own, const T& mixed) noexcept {
  const auto along = own_c * own + other_c * mixed;
  return own - (along + along);
}
// A component of 2^24(p - g): from g to q, and on to p.
template <class C, class E, class N>
FORCESHADE_INLINE constexpr auto way_to_hand(const C& c1, const C& c2, const C& lift, const E& e1, const E& e2,
                                             const N& n) noexcept {
  return (c1 * e1 + c2 * e2) + lift * n;
}

// The roundings of these, for parameters and edges of components up to 1, and n's unit times `lift` up to 1.
inline constexpr RoundingBound kParameter{1, 0};
inline constexpr RoundingBound kPullSquared =
    pull_squared(kParameter, kParameter, Gram<RoundingBound>{kLength, kLength, kLength});
inline constexpr RoundingBound kGainByStep = gain_by_step(kParameter, kParameter, kLength, kLength);
inline constexpr RoundingBound kWayToHand =
    way_to_hand(kParameter, kParameter, kParameter, kDifference.x, kDifference.x, kNormal.x);

// All bounds are multiples of one, that of c. With s the larger size of the two edges, u = 2^-53, and m the size of the
// components of c where a slip begins, and 2 more: there and at each point that the slip leads to, c is below m and off by
// d <= q_error + u m. c_error = q_error + 8u m, and the factors below cover these parts, of which decide_test makes the sums;
// no |e_i·e_j| exceeds 3s².
// - The pull: 2|c·E·d| + |d·E·d| <= 24 s² m d + 12 s² d², kPullSquared of s² m², and 12u s² m² for a difference of two.
// - What a step adds: 12 s² d, and kGainByStep of s² m; at the opposite corner twice that, 28u s², and 66u s² m for its sums;
//   and 51u s² m for a difference of the two.
// - The way to the hand: 2 s d and kWayToHand of s m; 2 n's unit times lift's error, and kWayToHand of that unit and |lift|,
//   whose error is 4u|lift| at least.
// - The pressure: twice |n·w| times lift's error, 2^-10 of that for the product of both errors, and 3u of the pressure.
struct SlipBounds {
  static constexpr double kOfPull = 26, kOfGain = 80, kOfWay = 3, kOfLift = 8, kOfPressure = 3;
  static constexpr double kShareOfC = 0x1p-50;
};

template <class Stages>
class QuickSlips {
 public:
  enum class Outcome { unsure, leaves, rests };

  // across: n·(p - a), a a corner.
  FORCESHADE_INLINE QuickSlips(const FaceNumbers& face, const DoubleWithError& across, const Weights& weights,
                               const Coefficients& of, const Stages& stages) noexcept
      : face_(face),
        of_(of),
        stages_(stages),
        gram_{dot(face.e1, face.e1), dot(face.e1, face.e2), dot(face.e2, face.e2)},
        longer_(larger(face.s1, face.s2)) {
    const auto scale = GridScale<double>::over(weights.all.value, weights.all.error);
    const DoubleWithError &first = weights.corner[1], &second = weights.corner[2];
    q1_ = first.value * scale.inverse;
    q2_ = second.value * scale.inverse;
    q_error_ = scale.quotient(larger(__builtin_fabs(first.value), __builtin_fabs(second.value)), first.error).error;
    const auto lift = scale.quotient(across.value, across.error);
    lift_ = lift.value;
    lift_error_ = lift.error;
    pressure_ = 0x1p24 * (across.value * lift_);
    pressure_error_ = 0x1p24 * SlipBounds::kOfPressure * (__builtin_fabs(across.value) * lift_error_);
    is_usable_ = weights.all.value > 0x1p10 * weights.all.error && lift_error_ < 0x1p-10 * __builtin_fabs(lift_);
  }

  // From the parameters k and l, with the bit and the moves of a tick, at most most_moves. Where it is unsure or leaves the
  // triangle, these are the state after what was sure.
  FORCESHADE_INLINE Outcome run(double k, double l, bool& is_slipping, int& moves, int most_moves) noexcept {
    k_ = k;
    l_ = l;
    c1_ = q1_ - k;
    c2_ = q2_ - l;
    set_bounds();
    double pull = pull_squared(c1_, c2_, gram_);
    if (!stages_.sure(is_usable_)) return Outcome::unsure;
    for (bool is_first = true;; is_first = false) {
      const double coefficient = static_cast<double>(is_slipping ? of_.dynamic_friction : of_.static_friction);
      const int beyond = order(pull, coefficient * coefficient);
      if (beyond == 0) return Outcome::unsure;
      if (beyond < 0) return rest(pull, is_slipping);
      if (moves == most_moves) return Outcome::unsure;
      if (!is_first) set_bounds();
      const Outcome slip = slip_from(pull);
      if (slip != Outcome::rests) return slip;
      ++moves;
      is_slipping = true;
    }
  }
  double k() const noexcept { return k_; }
  double l() const noexcept { return l_; }
  // 2^24(p - g) at the rest, and the largest error of a component.
  const Vector3<double>& way_to_hand() const noexcept { return way_to_hand_; }
  double error_of_way() const noexcept { return error_of_way_; }

 private:
  // From c, for a slip and the points that it leads to.
  FORCESHADE_INLINE void set_bounds() noexcept {
    const double size = larger(__builtin_fabs(c1_), __builtin_fabs(c2_)) + 2;
    c_error_ = q_error_ + SlipBounds::kShareOfC * size;
    pull_error_ = c_error_ < 0x1p-10 * size ? SlipBounds::kOfPull * (longer_ * longer_) * (size * c_error_) : HUGE_VAL;
  }

  // The sign of pull - factor·pressure; 0 where it is not sure.
  FORCESHADE_INLINE int order(double pull, double factor) const noexcept {
    const double beyond = pull - factor * pressure_;
    if (!stages_.sure(__builtin_fabs(beyond) > pull_error_ + factor * pressure_error_)) return 0;
    return beyond > 0 ? 1 : -1;
  }

  // To where a slip ends, rounded to the grid, if that is inside the triangle: rests. pull: becomes that there.
  FORCESHADE_INLINE Outcome slip_from(double& pull) noexcept {
    // Each number is made from those before it by as few operations in a row as possible, since they are most of a slip's time.
    const double share = static_cast<double>(of_.dynamic_friction) * __builtin_sqrt(pressure_) / __builtin_sqrt(pull),
                 kept = rounded<24>(share - 0x1p-25), above = 0x1p24 * (share - kept), both = pull * pressure_;
    // The root of a quotient errs by half of what its operands do, relative; the other half is more than the roundings.
    bool is_sure =
        0x1p24 * share * (pull_error_ * pressure_ + pressure_error_ * pull) < (smaller(above, 1 - above) - 0x1p-26) * both &&
        pull_error_ < 0x1p-10 * pull;
    // The end, its cell, and where it is in that: less a half, for which the nearest whole number is the one below.
    const double x1_less = (q1_ - 0.5) - kept * c1_, x2_less = (q2_ - 0.5) - kept * c2_, x1 = x1_less + 0.5, x2 = x2_less + 0.5,
                 error = c_error_ + 0x1p-28, nearest_border = smaller(smaller(x1, x2), 0x1p24 - (x1 + x2));
    if (nearest_border < 0)
      return stages_.sure(is_sure && nearest_border < -4 * error - 0x1p-50 * (__builtin_fabs(x1) + __builtin_fabs(x2)))
                 ? Outcome::leaves
                 : Outcome::unsure;
    const double floor_1 = rounded<0>(x1_less), floor_2 = rounded<0>(x2_less), part_1 = x1_less - floor_1,
                 part_2 = x2_less - floor_2, diagonal = part_1 + part_2;
    is_sure = is_sure &&
              smaller(0.5 - larger(__builtin_fabs(part_1), __builtin_fabs(part_2)), 0.5 * __builtin_fabs(diagonal)) > error;
    // Either half of the cell has the corners beside its lowest one; the third is that one or, in the upper half, the one
    // opposite to it. Without branches, since nothing foretells which it is.
    const double upper = rounded<0>(diagonal + 0.5), c1 = q1_ - floor_1, c2 = q2_ - floor_2;
    const double first = gain_by_step(c1, c2, gram_.first, gram_.mixed),
                 second = gain_by_step(c2, c1, gram_.second, gram_.mixed), third = upper * ((first + second) + 2 * gram_.mixed),
                 least = smaller(smaller(first, second), third);
    is_sure = is_sure && smaller(smaller(__builtin_fabs(third - first), __builtin_fabs(third - second)),
                                 __builtin_fabs(first - second)) > SlipBounds::kOfGain * (longer_ * longer_) * c_error_;
    const auto is_least = [&](double gain) FORCESHADE_INLINE_BODY { return 0.5 + __builtin_copysign(0.5, least - gain); };
    const double both_up = upper * is_least(third), k = floor_1 + (is_least(first) + both_up),
                 l = floor_2 + (is_least(second) + both_up);
    c1_ = q1_ - k;
    c2_ = q2_ - l;
    const double there = pull_squared(c1_, c2_, gram_);
    is_sure = is_sure && smaller(smaller(k, l), 0x1p24 - (k + l)) > 0 && pull - there > 3 * pull_error_;
    if (!stages_.sure(is_sure)) return Outcome::unsure;
    k_ = k;
    l_ = l;
    pull = there;
    return Outcome::rests;
  }

  FORCESHADE_INLINE Outcome rest(double pull, bool& is_slipping) noexcept {
    if (is_slipping) {
      const double half = 0.5 * static_cast<double>(of_.dynamic_friction);
      const int beyond = order(pull, half * half);
      if (beyond == 0) return Outcome::unsure;
      is_slipping = beyond > 0;
    }
    way_to_hand_ = {fast::way_to_hand(c1_, c2_, lift_, face_.e1.x, face_.e2.x, face_.n.x),
                    fast::way_to_hand(c1_, c2_, lift_, face_.e1.y, face_.e2.y, face_.n.y),
                    fast::way_to_hand(c1_, c2_, lift_, face_.e1.z, face_.e2.z, face_.n.z)};
    error_of_way_ = SlipBounds::kOfWay * longer_ * c_error_ + SlipBounds::kOfLift * face_.area * lift_error_;
    return Outcome::rests;
  }

  // To the nearest whole multiple of 2^-kBits, a tie to either side: of numbers below 2^(51 - kBits) in size.
  template <int kBits>
  FORCESHADE_INLINE static double rounded(double a) noexcept {
    constexpr double kShift = 0x1.8p52 / static_cast<double>(std::uint64_t{1} << kBits);
    return (a + kShift) - kShift;
  }
  FORCESHADE_INLINE static double smaller(double a, double b) noexcept { return a < b ? a : b; }

  const FaceNumbers& face_;
  const Coefficients& of_;
  const Stages& stages_;
  Gram<double> gram_;
  double longer_;                     // of the edges' sizes
  double q1_, q2_, q_error_;          // Q
  double lift_, lift_error_;          // 2^24 n·(p - a)/n²
  double pressure_, pressure_error_;  // the square of 2^24 z, mm²
  bool is_usable_;
  double k_ = 0, l_ = 0, c1_ = 0, c2_ = 0, c_error_ = 0, pull_error_ = 0;
  Vector3<double> way_to_hand_{};
  double error_of_way_ = 0;
};

}  // namespace forceshade::fast
