// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object's decisions, as signs of polynomials: in binary64 with a bound of the error, and in exact integers where the
// value does not exceed the bound. Zeros are common on parts with flat faces, and go to the integers straight.
//
// Each polynomial is written once, as a template. The compiler runs it on RoundingBound for the constant of its bound, the
// filter runs it on binary64, and the last word runs it on FixedInteger, whose types prove how many bits it takes. Coordinates
// are in units of 2^-53 mm there, and what stems from the god-object's own point is 2^24 times as large, so that its parameters
// are whole.

#include <array>
#include <cstdint>

#include "fast/meshes/mesh.h"
#include "fast/meshes/rounding_bound.h"
#include "fast/meshes/vector3.h"
#include "fast/numbers/double_double.h"
#include "fast/numbers/double_with_error.h"
#include "fast/numbers/first_stage.h"
#include "fast/stage.h"

namespace forceshade::fast {

// Tells which decisions binary64 may take, and notes them. `sure`: the number's sign, or another property of
// it, is proved. `note`: that another stage takes a decision. A kind of its own counts in tests.
struct FilteredStages {
  static constexpr bool kFilter = true;
  Stage* last = nullptr;  // where it is not null, raised to the stage of each decision that binary64 does not take
  FORCESHADE_INLINE bool sure(bool is_proved) const noexcept { return is_proved; }
  void note(Stage stage) const noexcept {
    if (last != nullptr) raise(*last, stage);
  }
};
// For tests: all decisions in integers.
struct ExactStages {
  static constexpr bool kFilter = false;
  bool sure(bool) const noexcept { return false; }
  void note(Stage) const noexcept {}
};

template <class Stages, class Exact>
FORCESHADE_INLINE auto in_integers(const Stages& stages, const Exact& exact) noexcept {
  stages.note(Stage::wide);
  return exact();
}

// value, with |error| as a bound: its sign, or that of exact().
template <class Stages, class Exact>
FORCESHADE_INLINE int sign_of(const DoubleWithError& value, const Stages& stages, const Exact& exact) noexcept {
  if (stages.sure(__builtin_fabs(value.value) > value.error)) [[likely]]
    return value.value > 0 ? 1 : -1;
  return in_integers(stages, exact);
}

inline constexpr std::uint32_t kGrid = std::uint32_t{1} << 24;  // parameters are in units of 1/kGrid

// A point of the surface, or a free one: the sum of weight[i]/2^24·corner[i], the weights' sum being 2^24.
struct Point {
  std::array<const float*, 3> corner{};
  std::array<std::uint32_t, 3> weight{};
  int count = 0;

  static Point at(const float* place) noexcept { return {{place, nullptr, nullptr}, {kGrid, 0, 0}, 1}; }
};

// ---- Bounds. Vectors have components up to 1: differences of coordinates, rounded once; offsets 2^24(p - g), which
// offset_from() computes to 2^-52 of the largest component.
using Bounds3 = Vector3<RoundingBound>;
inline constexpr RoundingBound kRoundedOnce{1 + 0x1p-52, 0x1p-53}, kOffsetBound{1 + 0x1p-51, 0x1p-52};
inline constexpr Bounds3 kDifference{kRoundedOnce, kRoundedOnce, kRoundedOnce};
inline constexpr Bounds3 kOffset{kOffsetBound, kOffsetBound, kOffsetBound};
inline constexpr Bounds3 kNormal = cross(kDifference, kDifference);

// ---- The polynomials. e, e1, e2: edges; w: p less a corner; n: normal; U: 2^24(p - g).
inline constexpr RoundingBound kAcross = dot(kNormal, kOffset);                          // n·w, n·U
inline constexpr RoundingBound kInside = dot(cross(kDifference, kOffset), kNormal);      // (e x w)·n, (e x U)·n
inline constexpr RoundingBound kArea = dot(kNormal, kNormal);                            // n·n
inline constexpr RoundingBound kAlong = dot(kOffset, kDifference);                       // w·e, U·e
inline constexpr RoundingBound kLength = dot(kDifference, kDifference);                  // e·e
inline constexpr RoundingBound kOffsetLength = dot(kOffset, kOffset);                    // U·U
inline constexpr RoundingBound kPasses = dot(cross(kDifference, kOffset), kDifference);  // (w x U)·e
inline constexpr RoundingBound kPassesFlat = dot(cross(kDifference, kOffset), kNormal);  // (w x U)·n

// The weight of a triangle's third corner: n·n less those of the others.
template <class T>
FORCESHADE_INLINE constexpr T third_weight(const T& all, const T& first, const T& second) noexcept {
  return all - (first + second);
}
inline constexpr RoundingBound kThird = third_weight(kArea, kInside, kInside);  // its unit is the sum of theirs

// The position of p relative to a triangle's plane.
struct Plane {
  Vector3<double> n;    // the triangle's normal
  double across, all;   // n·(p - a), a being a corner; n·n
  double area, size_w;  // n's unit, and the size of p - a
};

// A triangle's numbers.
struct FaceNumbers {
  Vector3<double> e1, e2, n;  // b - a, c - a, e1 x e2
  double s1, s2, area;        // sizes of e1 and e2; their product, n's unit

  FORCESHADE_INLINE explicit FaceNumbers(const Face& f) noexcept
      : e1(difference(f.corner[1].data(), f.corner[0].data())),
        e2(difference(f.corner[2].data(), f.corner[0].data())),
        n(cross(e1, e2)),
        s1(size_of(e1)),
        s2(size_of(e2)),
        area(s1 * s2) {}
};

struct ExactFace {
  ExactDifference e1, e2;
  decltype(cross(ExactDifference{}, ExactDifference{})) n;

  explicit ExactFace(const Face& f) noexcept
      : e1(exact_difference(f.corner[1].data(), f.corner[0].data())),
        e2(exact_difference(f.corner[2].data(), f.corner[0].data())),
        n(cross(e1, e2)) {}
};

inline bool is_same_point(const float* a, const float* b) noexcept {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// n·(p - a): on which side of the triangle's plane p is.
[[gnu::noinline]] inline int exact_side_of(const Face& f, const float* p) noexcept {
  // The commonest zero at a vertex of many triangles.
  for (const auto& corner : f.corner)
    if (is_same_point(corner.data(), p)) return 0;
  // The commonest zero: all in one plane across an axis.
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (f.corner[0][axis] == p[axis] && f.corner[1][axis] == p[axis] && f.corner[2][axis] == p[axis]) return 0;
  return dot(ExactFace(f).n, exact_difference(p, f.corner[0].data())).sign();
}
FORCESHADE_INLINE DoubleWithError across_of(const FaceNumbers& numbers, const Vector3<double>& w) noexcept {
  return {dot(numbers.n, w), kAcross.error * numbers.area * size_of(w)};
}
template <class Stages>
int side_of(const Face& f, const float* p, const Stages& stages) noexcept {
  return sign_of(across_of(FaceNumbers(f), difference(p, f.corner[0].data())), stages, [&] { return exact_side_of(f, p); });
}

// n·n times the weights of the triangle's corners at p's nearest point of its plane, and n·n. The weight of a corner is
// positive iff that point lies on the triangle's side of the opposite edge. One bound holds for all four.
struct Weights {
  std::array<DoubleWithError, 3> corner;
  DoubleWithError all;

  Weights() = default;
  FORCESHADE_INLINE Weights(const FaceNumbers& f, const Vector3<double>& w) noexcept {
    const double error = kThird.error * f.area * (size_of(w) * (f.s1 + f.s2) + f.area);
    const double second = dot(cross(w, f.e2), f.n), third = dot(cross(f.e1, w), f.n);
    all = {dot(f.n, f.n), error};
    corner = {{{third_weight(all.value, second, third), error}, {second, error}, {third, error}}};
  }
};
struct ExactWeights {
  std::array<FixedInteger<279>, 3> corner;
  FixedInteger<276> all;

  [[gnu::noinline]] ExactWeights(const Face& f, const float* p) noexcept {
    const ExactFace face(f);
    const ExactDifference w = exact_difference(p, f.corner[0].data());
    const auto second = dot(cross(w, face.e2), face.n), third = dot(cross(face.e1, w), face.n);
    all = dot(face.n, face.n);
    corner = {all - (second + third), second, third};
  }
};

// Along the line of an edge: where p's nearest point of it is, as e·w/e·e.
struct Foot {
  DoubleWithError along, length;

  FORCESHADE_INLINE Foot(const float* from, const float* to, const float* p) noexcept {
    const Vector3<double> e = difference(to, from), w = difference(p, from);
    const double size = size_of(e);
    along = {dot(w, e), kAlong.error * size * size_of(w)};
    length = {dot(e, e), kLength.error * size * size};
  }
};
struct ExactFoot {
  FixedInteger<138> along, length;

  [[gnu::noinline]] ExactFoot(const float* from, const float* to, const float* p) noexcept {
    const ExactDifference e = exact_difference(to, from);
    along = dot(exact_difference(p, from), e);
    length = dot(e, e);
  }
};

// ---- Fractions num/den with den > 0 against the grid of parameters.

// factor·a, the factor being no approximation.
FORCESHADE_INLINE DoubleWithError times(double factor, const DoubleWithError& a) noexcept {
  return DoubleWithError::rounded(factor * a.value, __builtin_fabs(factor) * a.error);
}
// 2^kPower·a.
template <int kPower>
FORCESHADE_INLINE DoubleWithError shifted(const DoubleWithError& a) noexcept {
  constexpr auto kFactor = static_cast<double>(std::uint64_t{1} << kPower);
  return {kFactor * a.value, kFactor * a.error};
}

// The sign of 2^25 num/den - halves.
template <class Stages, class Exact>
FORCESHADE_INLINE int compare_with_halves(const DoubleWithError& num, const DoubleWithError& den, std::uint32_t halves,
                                          const Stages& stages, const Exact& exact) noexcept {
  return sign_of(shifted<25>(num) - times(static_cast<double>(halves), den), stages, exact);
}
template <int kNum, int kDen>
int exact_compare_with_halves(const FixedInteger<kNum>& num, const FixedInteger<kDen>& den, std::uint32_t halves) noexcept {
  return num.template shifted<25>().compare(den * FixedInteger<33>(std::int64_t{halves}));
}

// The parameter at or below 2^24 num/den, and whether that is a whole number.
struct Cell {
  std::uint32_t floor;
  bool is_whole;

  bool operator==(const Cell&) const = default;
};
template <int kNum, int kDen>
Cell exact_cell(const FixedInteger<kNum>& num, const FixedInteger<kDen>& den) noexcept {
  // Within 2^-26 of the quotient, for each of the three operations is good to 2^-51, and the quotient is at most 2^24.
  auto guess = static_cast<std::int64_t>(num.approximately() / den.approximately() * 0x1p24);
  int sign = exact_compare_with_halves(num, den, static_cast<std::uint32_t>(2 * guess));
  if (sign < 0) {
    --guess;
  } else if (exact_compare_with_halves(num, den, static_cast<std::uint32_t>(2 * (guess + 1))) >= 0) {
    ++guess;
    sign = exact_compare_with_halves(num, den, static_cast<std::uint32_t>(2 * guess));
  }
  return {static_cast<std::uint32_t>(guess), sign == 0};
}
// The parameter nearest to 2^24 num/den, 0 < num < den: ties to even.
template <int kNum, int kDen>
std::uint32_t exact_nearest(const FixedInteger<kNum>& num, const FixedInteger<kDen>& den) noexcept {
  const Cell cell = exact_cell(num, den);
  const int above = exact_compare_with_halves(num, den, 2 * cell.floor + 1);
  return cell.floor + (above > 0 || (above == 0 && cell.floor % 2 == 1) ? 1 : 0);
}
// Serves quotients 2^24 num/den, 0 < 2^10 error < den: 2^24/den, and the share of a quotient that its error may be by den's
// error and by rounding. grid_parameters.g proves what quotient() charges.
template <class Real>
struct GridScale {
  Real inverse, relative;

  struct Quotient {
    Real value, error;
  };

  FORCESHADE_INLINE static GridScale over(const Real& den, const Real& error) noexcept {
    return {Real(0x1p24) / den, Real(1 + 0x1p-9) * error / den + Real(0x1p-51)};
  }
  // num is within num_error of the true one.
  FORCESHADE_INLINE Quotient quotient(const Real& num, const Real& num_error) const noexcept {
    const Real scaled = num * inverse;
    return {scaled, absolute(scaled) * relative + Real(1 + 0x1p-8) * num_error * inverse};
  }
};

// The grid's parameters of several num over one den > 0, whose inverse is computed once.
class GridParameters {
 public:
  FORCESHADE_INLINE explicit GridParameters(const DoubleWithError& den) noexcept {
    if (den.value > 0x1p10 * den.error) scale_ = GridScale<double>::over(den.value, den.error);
  }

  // The nearest one: see exact_nearest().
  template <class Stages, class Exact>
  FORCESHADE_INLINE std::uint32_t nearest(const DoubleWithError& num, const Stages& stages, const Exact& exact) const noexcept {
    const auto scaled = scale_.quotient(num.value, num.error);
    const auto nearest = static_cast<std::int64_t>(scaled.value + 0.5);
    if (stages.sure(__builtin_fabs(scaled.value - static_cast<double>(nearest)) + scaled.error < 0.5 - 0x1p-27)) [[likely]]
      return static_cast<std::uint32_t>(nearest);
    return in_integers(stages, exact);
  }

  // The one below: see exact_cell().
  template <class Stages, class Exact>
  FORCESHADE_INLINE Cell cell(const DoubleWithError& num, const Stages& stages, const Exact& exact) const noexcept {
    const auto scaled = scale_.quotient(num.value, num.error);
    const double low = scaled.value - scaled.error, high = scaled.value + scaled.error;
    const auto floor = static_cast<std::int64_t>(scaled.value);
    // The ends are rounded by less than 2^-28, for a quotient that is not refused here is at most 2^24.
    if (stages.sure(low > static_cast<double>(floor) + 0x1p-27 && high < static_cast<double>(floor) + (1 - 0x1p-27) &&
                    floor >= 0 && floor < kGrid)) [[likely]]
      return {static_cast<std::uint32_t>(floor), false};
    return in_integers(stages, exact);
  }

 private:
  GridScale<double> scale_{0, HUGE_VAL};  // with these, nothing is sure
};

// ---- The offset U = 2^24(p - g).

struct Offset {
  Vector3<double> U{};
  double size = 0;  // of U; infinite where binary64 does not hold it to 2^-52 of its size
};
using ExactOffset = Vector3<FixedInteger<95>>;

// Each 2^24 p and weight·corner is a binary64 number, and so are sums of two and their remainders. With M the largest of the
// terms, s below loses at most 2^-53(2^-53·4M + 2·2^-53·4M)·2 beside the rounding of the result: less than a quarter of
// 2^-53·|U| where |U| >= 2^-46 M.
FORCESHADE_INLINE Offset offset_from(const Point& g, const float* p, double largest_coordinate) noexcept {
  const auto component = [&](std::size_t i) {
    const auto term = [&](std::size_t c) {
      return c < static_cast<std::size_t>(g.count) ? -static_cast<double>(g.weight[c]) * static_cast<double>(g.corner[c][i])
                                                   : 0.0;
    };
    const TwoTerms first = two_sum(0x1p24 * static_cast<double>(p[i]), term(0)), other = two_sum(term(1), term(2));
    const TwoTerms s = two_sum(first.hi, other.hi);
    return s.hi + (s.lo + (first.lo + other.lo));
  };
  Offset result{{component(0), component(1), component(2)}, 0};
  const double size = size_of(result.U);
  result.size = size >= 0x1p-22 * largest_coordinate ? size : HUGE_VAL;
  return result;
}
[[gnu::noinline]] inline ExactOffset exact_offset_from(const Point& g, const float* p) noexcept {
  ExactOffset sum;
  for (int c = 0; c < g.count; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const ExactDifference w = exact_difference(p, g.corner[i]);
    const FixedInteger<25> weight(static_cast<std::int64_t>(g.weight[i]));
    const auto add = [&](const FixedInteger<95>& to, const FixedInteger<68>& by) {
      // No partial sum exceeds 2^24 times the largest difference: the weights add up to 2^24.
      return FixedInteger<95>((to + by * weight).words());
    };
    sum = {add(sum.x, w.x), add(sum.y, w.y), add(sum.z, w.z)};
  }
  return sum;
}

inline bool is_zero(const ExactOffset& U) noexcept {
  return U.x.is_zero() && U.y.is_zero() && U.z.is_zero();
}

}  // namespace forceshade::fast
