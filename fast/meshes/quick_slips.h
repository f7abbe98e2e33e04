// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What friction decides in a triangle, in binary64 and from the grid's parameters alone: nearly every tick in contact is that.
// With (k, l) the parameters of the god-object's point g, those of p's nearest point q of the plane are Q, and the pull is
// |c1 e1 + c2 e2| with c = Q - (k, l), in units of 2^-24 mm; it needs neither g nor p - g. One bound holds for each decision
// (docs/friction.md, "Decisions in binary64"). Where one is not sure, slips.h decides from g.

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
// By how much the square of the distance from p grows by a step of the grid, less its length: along e1, if `own` is e1². c: as
// it is where the step begins.
template <class C, class T>
FORCESHADE_INLINE constexpr auto twice_along(const C& own_c, const C& other_c, const T& own, const T& mixed) noexcept {
  const auto along = own_c * own + other_c * mixed;
  return along + along;
}
// A component of 2^24(p - g): from g to q, and up to p.
template <class C, class E, class N>
FORCESHADE_INLINE constexpr auto to_hand(const C& c1, const C& c2, const C& lift, const E& e1, const E& e2,
                                         const N& n) noexcept {
  return c1 * e1 + c2 * e2 + lift * n;
}

// The roundings, where the products of a parameter and of an edge's largest component are up to 1, and those of lift and n's
// unit. What the parameters' own errors add is in QuickSlips.
inline constexpr RoundingBound kWhole{1, 0};
inline constexpr Gram<RoundingBound> kGram{kLength, kLength, kLength};
inline constexpr RoundingBound kPullSquared = pull_squared(kWhole, kWhole, kGram);
inline constexpr RoundingBound kStep = kLength - twice_along(kWhole, kWhole, kLength, kLength);
inline constexpr RoundingBound kToHand = to_hand(kWhole, kWhole, kWhole, kDifference.x, kDifference.x, kNormal.x);

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
        longer_(face.s1 > face.s2 ? face.s1 : face.s2) {
    is_usable_ = weights.all.value > 0x1p10 * weights.all.error;
    const auto scale = GridScale<double>::over(weights.all.value, weights.all.error);
    const auto first = scale.quotient(weights.corner[1].value, weights.corner[1].error),
               second = scale.quotient(weights.corner[2].value, weights.corner[2].error),
               lift = scale.quotient(across.value, across.error);
    q1_ = first.value;
    q2_ = second.value;
    q_error_ = first.error > second.error ? first.error : second.error;
    lift_ = {lift.value, lift.error};
    pressure_ = shifted<24>(across * lift_);
  }

  // From the parameters k and l, and with the bit and the moves of a tick, at most most_moves: what is sure. Where that is
  // neither a rest nor that a slip would leave the triangle, it is the state after some slips.
  FORCESHADE_INLINE Outcome run(double k, double l, bool& is_slipping, int& moves, int most_moves) noexcept {
    k_ = k;
    l_ = l;
    Pull here = pull_at(k, l);
    for (;;) {
      const double coefficient = static_cast<double>(is_slipping ? of_.dynamic_friction : of_.static_friction);
      const DoubleWithError beyond = here.square - times(coefficient * coefficient, pressure_);
      if (!stages_.sure(is_usable_ && __builtin_fabs(beyond.value) > beyond.error)) return Outcome::unsure;
      if (beyond.value < 0) return rest(here, is_slipping);
      if (moves == most_moves) return Outcome::unsure;
      double to_k = 0, to_l = 0;
      const Outcome slip = end_of_slip(here, to_k, to_l);
      if (slip != Outcome::rests) return slip;
      const Pull there = pull_at(to_k, to_l);
      if (!stages_.sure(there.square.value + there.square.error < (1 - 0x1p-50) * (here.square.value - here.square.error)))
        return Outcome::unsure;
      ++moves;
      is_slipping = true;
      k_ = to_k;
      l_ = to_l;
      here = there;
    }
  }
  double k() const noexcept { return k_; }
  double l() const noexcept { return l_; }
  // 2^24(p - g) at the rest, and the largest error of a component.
  const Vector3<double>& to_hand() const noexcept { return to_hand_; }
  double error_to_hand() const noexcept { return error_to_hand_; }

 private:
  // The pull at a point: its square, c, the largest error of a component of c, and the largest |c| times the edge's size.
  struct Pull {
    DoubleWithError square;
    double c1, c2, c_error, size;
  };
  // The true pull differs from that of c and true edges by at most 2|c·E·d| + |d·E·d|, d being the error of c, and no |E_ij|
  // exceeds 3 s_i s_j.
  FORCESHADE_INLINE Pull pull_at(double k, double l) const noexcept {
    Pull at;
    at.c1 = q1_ - k;
    at.c2 = q2_ - l;
    const double size_1 = __builtin_fabs(at.c1), size_2 = __builtin_fabs(at.c2);
    at.c_error = kSlack * (q_error_ + DoubleWithError::kUnit * larger(size_1, size_2));
    at.size = larger(size_1 * face_.s1, size_2 * face_.s2);
    const double off = at.c_error * longer_;
    at.square = {pull_squared(at.c1, at.c2, gram_),
                 kSlack * (kPullSquared.error * at.size * at.size + 24 * (at.size + off) * off)};
    return at;
  }

  // Where a slip from a point that is not held there ends, rounded to the grid: rests, if that is inside the triangle.
  FORCESHADE_INLINE Outcome end_of_slip(const Pull& from, double& k, double& l) const noexcept {
    const DoubleWithError& pull = from.square;
    const double share =
                     0x1p24 * static_cast<double>(of_.dynamic_friction) * __builtin_sqrt(pressure_.value * (1 / pull.value)),
                 left = floor_of(share), above = share - left, both = pull.value * pressure_.value;
    // The root of a quotient errs by half of what its operands do, relative.
    const double share_error =
        share * ((0.5 + 0x1p-8) * (pull.error * pressure_.value + pressure_.error * pull.value) + 0x1p-50 * both);
    bool is_sure = pull.error < 0x1p-10 * pull.value && pressure_.error < 0x1p-10 * pressure_.value &&
                   share_error < (above - 0x1p-26) * both && share_error < (1 - above - 0x1p-26) * both;
    const double x1 = q1_ - 0x1p-24 * left * from.c1, x2 = q2_ - 0x1p-24 * left * from.c2;
    const double size = larger(__builtin_fabs(from.c1), __builtin_fabs(from.c2));
    const double error = kSlack * (q_error_ + 0x1p-52 * size) + 0x1p-28;
    const double sum = x1 + x2;
    if (x1 < 0 || x2 < 0 || sum > 0x1p24) {
      const double out = 4 * error + 0x1p-48 * (__builtin_fabs(x1) + __builtin_fabs(x2));
      return stages_.sure(is_sure && (x1 < -out || x2 < -out || sum > 0x1p24 + out)) ? Outcome::leaves : Outcome::unsure;
    }
    const double floor_1 = floor_of(x1), floor_2 = floor_of(x2), part_1 = x1 - floor_1, part_2 = x2 - floor_2,
                 diagonal = part_1 + part_2 - 1;
    is_sure = is_sure && part_1 > error && part_1 < 1 - error && part_2 > error && part_2 < 1 - error &&
              __builtin_fabs(diagonal) > 2 * error;
    // The corners of the cell's lower triangle are a base and a step along either side from it; so are those of the upper one,
    // with steps back.
    const double is_upper = diagonal > 0 ? 1.0 : 0.0, step = 1 - 2 * is_upper, base_1 = floor_1 + is_upper,
                 base_2 = floor_2 + is_upper;
    const double c1 = step * (q1_ - base_1), c2 = step * (q2_ - base_2);
    const double along_1 = gram_.first - twice_along(c1, c2, gram_.first, gram_.mixed),
                 along_2 = gram_.second - twice_along(c2, c1, gram_.second, gram_.mixed);
    const double size_1 = __builtin_fabs(c1), size_2 = __builtin_fabs(c2),
                 most = larger(size_1 * face_.s1, size_2 * face_.s2) + longer_,
                 c_error = q_error_ + DoubleWithError::kUnit * larger(size_1, size_2),
                 along_error = kSlack * longer_ * (kStep.error * most + 12 * longer_ * c_error);
    is_sure = is_sure && __builtin_fabs(along_1) > along_error && __builtin_fabs(along_2) > along_error &&
              __builtin_fabs(along_1 - along_2) > 2 * along_error;
    const double first = along_1 < 0 && along_1 < along_2 ? step : 0, second = along_2 < 0 && along_2 < along_1 ? step : 0;
    k = base_1 + first;
    l = base_2 + second;
    return stages_.sure(is_sure && k > 0 && l > 0 && k + l < 0x1p24) ? Outcome::rests : Outcome::unsure;
  }

  FORCESHADE_INLINE Outcome rest(const Pull& here, bool& is_slipping) noexcept {
    if (is_slipping) {
      const double half = 0.5 * static_cast<double>(of_.dynamic_friction);
      const DoubleWithError beyond = here.square - times(half * half, pressure_);
      if (!stages_.sure(__builtin_fabs(beyond.value) > beyond.error)) return Outcome::unsure;
      is_slipping = beyond.value > 0;
    }
    const double c1 = here.c1, c2 = here.c2;
    to_hand_ = {fast::to_hand(c1, c2, lift_.value, face_.e1.x, face_.e2.x, face_.n.x),
                fast::to_hand(c1, c2, lift_.value, face_.e1.y, face_.e2.y, face_.n.y),
                fast::to_hand(c1, c2, lift_.value, face_.e1.z, face_.e2.z, face_.n.z)};
    error_to_hand_ = kSlack * (kToHand.error * larger(here.size, __builtin_fabs(lift_.value) * face_.area) +
                               2 * (here.c_error * longer_ + lift_.error * face_.area));
    return Outcome::rests;
  }

  // Of numbers below 2^51 in size that are not within 2^-53 of a whole one.
  FORCESHADE_INLINE static double floor_of(double a) noexcept {
    constexpr double kRounds = 0x1.8p52;
    return (a - 0.5 + kRounds) - kRounds;
  }
  FORCESHADE_INLINE static double larger(double a, double b) noexcept { return a > b ? a : b; }

  static constexpr double kSlack = 1 + 0x1p-40;

  const FaceNumbers& face_;
  const Coefficients& of_;
  const Stages& stages_;
  Gram<double> gram_;
  double longer_;  // of the edges' sizes
  double q1_, q2_, q_error_;
  DoubleWithError lift_, pressure_;  // 2^24 n·(p - a)/n², and the square of 2^24 times the pressure
  bool is_usable_;
  double k_ = 0, l_ = 0;
  Vector3<double> to_hand_{};
  double error_to_hand_ = 0;
};

}  // namespace forceshade::fast
