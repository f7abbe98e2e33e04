// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The uniform cubic B-spline on a grid of coefficients. Its gradient comes from differences of neighbouring coefficients: where
// these are all equal, it is exactly 0 in every arithmetic.

#include "fast/heights/grid.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {

// Six times the cubic B-splines at t, and two times the quadratic ones, whose sums with the differences of coefficients are
// the spline's derivative. N: a Ball.
template <class N>
struct SplineWeights {
  N cubic[4], quadratic[3];

  explicit SplineWeights(const N& t) noexcept {
    const N one = N::exactly(1), two = N::exactly(2), three = N::exactly(3), four = N::exactly(4);
    const N s = one - t, tt = t * t, ss = s * s;
    cubic[0] = ss * s;
    cubic[1] = four - (three * tt) * (two - t);
    cubic[2] = four - (three * ss) * (one + t);
    cubic[3] = tt * t;
    quadratic[0] = ss;
    quadratic[1] = one + (two * t) * s;
    quadratic[2] = tt;
  }
};

template <class N>
Jet<N> spline_jet(const HeightGrid& grid, const Place& at) noexcept {
  using R = Row<N>;
  const HeightGrid::Cell cell = grid.cell(at);
  const HeightGrid::Window<4> window(grid, cell.column - 1, cell.row - 1);
  const InCell<N> in(grid, at, cell);
  const SplineWeights<N> x(in.t), y(in.s);
  R height{}, along{}, across{};
  for (std::size_t l = 0; l < 4; ++l) {
    const R c = R::of(window[l]);
    height = height + y.cubic[l] * c;
    along = along + y.cubic[l] * (c.shifted() - c);
    if (l < 3) across = across + y.quadratic[l] * (R::of(window[l + 1]) - c);
  }
  const R cubic{{x.cubic[0], x.cubic[1], x.cubic[2], x.cubic[3]}};
  const R quadratic{{x.quadratic[0], x.quadratic[1], x.quadratic[2], N::exactly(0)}};
  const N twelve_pitches = N::exactly(12 * grid.pitch());
  return {(cubic * height).sum() / N::exactly(36), (quadratic * along).sum() / twelve_pitches,
          (cubic * across).sum() / twelve_pitches};
}

// The cubic B-splines as polynomials of t, and their derivatives: coefficients by column, the lowest power first.
alignas(32) inline constexpr double kValues[4][4] = {
    {1 / 6.0, 2 / 3.0, 1 / 6.0, 0}, {-0.5, 0, 0.5, 0}, {0.5, -1, 0.5, 0}, {-1 / 6.0, 0.5, -0.5, 1 / 6.0}};
alignas(32) inline constexpr double kSlopes[3][4] = {{-0.5, 0, 0.5, 0}, {1, -2, 1, 0}, {-0.5, 1.5, -1.5, 0.5}};

template <class Real, class Coefficient>
FORCESHADE_INLINE Real value_weight(const Real& x, const Coefficient& a) {
  return multiply_add(multiply_add(multiply_add(a(kValues[3]), x, a(kValues[2])), x, a(kValues[1])), x, a(kValues[0]));
}
template <class Real, class Coefficient>
FORCESHADE_INLINE Real slope_weight(const Real& x, const Coefficient& a) {
  return multiply_add(multiply_add(a(kSlopes[2]), x, a(kSlopes[1])), x, a(kSlopes[0]));
}

// A column of the window, or several side by side, as a function of y alone: from differences with c, the coefficient at the
// cell's own sample, so that errors are small where the map is flat, however high it lies. Real: binary64 side by side; its
// multiply_add may round once or twice.
template <class Real>
struct SplineColumn {
  Real value;        // less c, mm
  Real twice_slope;  // in pitches, mm

  // The value is computed by steps s from row to row and their differences: value - row 1 = s'/6 + (y/2)(s0 + s1) + (y^2/2) s'
  // + (y^3/6) s'', where s' = s1 - s0 and s'' = s0 - 2 s1 + s2.
  FORCESHADE_INLINE SplineColumn(const Real& row0, const Real& row1, const Real& row2, const Real& row3, const Real& c,
                                 const Real& y) noexcept
      : value(row1), twice_slope(row1) {
    const Real step0 = row1 - row0, step1 = row2 - row1, step2 = row3 - row2;
    const Real two_steps = step0 + step1, second = step1 - step0, third = (step2 - step1) - second;
    const Real y_2 = y * Real(0.5), y_3 = y * Real(1 / 3.0);
    value = multiply_add(y_2, multiply_add(y, multiply_add(y_3, third, second), two_steps),
                         multiply_add(second, Real(1 / 6.0), row1 - c));
    twice_slope = multiply_add(y, multiply_add(y, third, second + second), two_steps);
  }
};

// The jet in binary64. Four: one lane a column of the window; its Number is what a lane holds, its Two a pair of them.
template <class Four>
struct SplineValues {
  using Number = typename Four::Number;
  using Two = typename Four::Two;

  Number c;       // mm, exact
  Number rise;    // U - c, mm
  Number Ux, Uy;  // mm/mm

  // past: the position less the cell's start, mm. from: the window's first coefficient, stride: from row to row.
  FORCESHADE_INLINE SplineValues(const HeightGrid& grid, const Two& past, const float* from, std::int64_t stride) noexcept
      : c(static_cast<double>(from[stride + 1])) {
    const Two t = past * grid.per_pitch();
    const Four x(t[0]), y(t[1]);
    const auto by_column = [](const double(&a)[4]) { return Four::load(a); };
    const Four value_x = value_weight(x, by_column);
    const SplineColumn<Four> columns(Four::load(from), Four::load(from + stride), Four::load(from + 2 * stride),
                                     Four::load(from + 3 * stride), Four(c), y);
    rise = sum(value_x * columns.value);
    const Two slopes = sums(slope_weight(x, by_column) * columns.value, value_x * columns.twice_slope) * grid.per_slope();
    Ux = slopes[0];
    Uy = slopes[1];
  }
};

// The same at as many positions at a time as Real has lanes. coefficient(k, l): of the k-th column and l-th row of the windows;
// x, y: in cells, 0 to 1.
template <class Real>
struct SplineJets {
  Real rise, Ux, Uy;

  template <class Coefficient>
  FORCESHADE_INLINE SplineJets(const Coefficient& coefficient, const Real& x, const Real& y, const Pair64& per_slope) noexcept
      : rise(x), Ux(x), Uy(x) {
    const Real c = coefficient(1, 1);
    Real values[4]{c, c, c, c}, slopes_x[4]{c, c, c, c}, slopes_y[4]{c, c, c, c};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto of_column = [k](const double(&a)[4]) { return Real(a[k]); };
      const Real weight = value_weight(x, of_column);
      const SplineColumn<Real> column(coefficient(k, 0), coefficient(k, 1), coefficient(k, 2), coefficient(k, 3), c, y);
      values[k] = weight * column.value;
      slopes_x[k] = slope_weight(x, of_column) * column.value;
      slopes_y[k] = weight * column.twice_slope;
    }
    const auto sum = [](const Real a[4]) { return (a[0] + a[1]) + (a[2] + a[3]); };
    rise = (values[0] + values[2]) + (values[1] + values[3]);
    Ux = sum(slopes_x) * Real(per_slope[0]);
    Uy = sum(slopes_y) * Real(per_slope[1]);
  }
};

// spline.g: U - c and p U_x in binary64 are within this times the largest step of their exact values, a step being the
// difference of two coefficients side by side. U - c is within 110/160 of it; the rest is for adding c.
inline constexpr double kSplineError = 0x1.4p-46;

// The errors of the first stage's jet, given the largest steps. Where no step goes along an axis, the gradient along it is
// exactly 0; otherwise a step in either direction counts.
struct SplineErrors {
  double rise, Ux, Uy;

  SplineErrors(const HeightGrid& grid, double along, double across) noexcept
      : rise(kSplineError * (along > across ? along : across)),
        Ux(along > 0 ? rise * grid.per_pitch()[0] : 0),
        Uy(across > 0 ? rise * grid.per_pitch()[0] : 0) {}
};

// The jet with the errors of this very cell.
inline Jet<DoubleWithError> tracked_spline_jet(const HeightGrid& grid, const Place& at) noexcept {
  const HeightGrid::Cell cell = grid.cell(at);
  const HeightGrid::Window<4> w(grid, cell.column - 1, cell.row - 1);
  double along = 0, across = 0;
  for (std::size_t l = 0; l < 4; ++l)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto c = static_cast<double>(w[l][k]);
      if (k > 0) along = larger(along, absolute(c - static_cast<double>(w[l][k - 1])));
      if (l > 0) across = larger(across, absolute(c - static_cast<double>(w[l - 1][k])));
    }
  const SplineValues<Quad> jet(grid, at.coordinates - cell.start, w[0], w.stride());
  const SplineErrors error(grid, along, across);
  const DoubleWithError c = DoubleWithError::exactly(jet.c);
  return {error.rise > 0 ? c + DoubleWithError{jet.rise, error.rise} : c,
          along > 0 ? DoubleWithError{jet.Ux, error.Ux} : DoubleWithError::exactly(0),
          across > 0 ? DoubleWithError{jet.Uy, error.Uy} : DoubleWithError::exactly(0)};
}

template <class N>
Jet<N> jet(const HeightGrid& grid, const Place& at) noexcept {
  if (grid.interpolant() == height::Interpolant::bilinear) return bilinear_jet<N>(grid, at);
  if constexpr (std::is_same_v<N, DoubleWithError>)
    return tracked_spline_jet(grid, at);
  else
    return spline_jet<N>(grid, at);
}

}  // namespace forceshade::fast
