// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The uniform cubic B-spline on a grid of coefficients. Its gradient comes from differences of neighbouring coefficients: where
// these are all equal, it is exactly 0 in every arithmetic.

#include "forceshade/fast/first_stage.h"
#include "forceshade/fast/height_grid.h"

namespace forceshade::fast {

// Six times the cubic B-splines at t, and two times the quadratic ones, whose sums with the differences of coefficients are
// the spline's derivative. T: a Ball, or binary64 side by side.
template <class T>
struct SplineWeights {
  T cubic[4], quadratic[3];

  FORCESHADE_INLINE explicit SplineWeights(const T& t) noexcept {
    const T one = exactly(1), two = exactly(2), three = exactly(3), four = exactly(4);
    const T s = one - t, tt = t * t, ss = s * s;
    cubic[0] = ss * s;
    cubic[1] = four - (three * tt) * (two - t);
    cubic[2] = four - (three * ss) * (one + t);
    cubic[3] = tt * t;
    quadratic[0] = ss;
    quadratic[1] = one + (two * t) * s;
    quadratic[2] = tt;
  }

  FORCESHADE_INLINE static T exactly(double value) noexcept {
    if constexpr (requires { T::exactly(value); })
      return T::exactly(value);
    else
      return T{} + value;
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

// height_spline.g: 12(U - c) and 12 p U_x in binary64 are within this times the largest step of their exact values; c is the
// coefficient at the cell's own sample, a step the difference of two coefficients side by side.
inline constexpr double kSplineError = 0x1.cp-42;

// The errors of the first stage's jet, given the largest steps. Where no step goes along an axis, the gradient along it is
// exactly 0; otherwise a step in either direction counts.
struct SplineErrors {
  double U, Ux, Uy;

  SplineErrors(const HeightGrid& grid, double largest_value, double along, double across) noexcept {
    const double step = kSplineError * (along > across ? along : across);
    U = step > 0 ? step / 12 + 0x1.01p-53 * largest_value : 0;  // the second is for adding c
    Ux = along > 0 ? step * grid.per_twelve_pitches() : 0;
    Uy = across > 0 ? step * grid.per_twelve_pitches() : 0;
  }
};

// The jet in binary64. From differences with c: its errors are small where the map is flat, however high it lies.
struct SplineValues {
  double U, Ux, Uy;

  FORCESHADE_INLINE SplineValues(const HeightGrid& grid, const Place& at) noexcept {
    using R = Row<double>;
    const HeightGrid::Cell cell = grid.cell(at);
    const HeightGrid::Window<4> window(grid, cell.column - 1, cell.row - 1);
    const SplineWeights<Pair64> w((at.coordinates - cell.start) * grid.per_pitch());
    const auto c = static_cast<double>(window[1][1]);
    const R c0 = R::of(window[0]) - c, c1 = R::of(window[1]) - c, c2 = R::of(window[2]) - c, c3 = R::of(window[3]) - c;
    const R height = (w.cubic[0][1] * c0 + w.cubic[1][1] * c1) + (w.cubic[2][1] * c2 + w.cubic[3][1] * c3);
    const R across = (w.quadratic[0][1] * (c1 - c0) + w.quadratic[1][1] * (c2 - c1)) + w.quadratic[2][1] * (c3 - c2);
    const R cubic{Pair64{w.cubic[0][0], w.cubic[1][0]}, Pair64{w.cubic[2][0], w.cubic[3][0]}};
    const R quadratic{Pair64{w.quadratic[0][0], w.quadratic[1][0]}, Pair64{w.quadratic[2][0], 0}};
    U = c + (cubic * height).sum() * (1.0 / 36);
    Ux = (quadratic * (height.shifted() - height)).sum() * grid.per_twelve_pitches();
    Uy = (cubic * across).sum() * grid.per_twelve_pitches();
  }
};

// With the errors of this very cell.
inline Jet<Tracked> tracked_spline_jet(const HeightGrid& grid, const Place& at) noexcept {
  const HeightGrid::Cell cell = grid.cell(at);
  const HeightGrid::Window<4> w(grid, cell.column - 1, cell.row - 1);
  double value = 0, along = 0, across = 0;
  for (std::size_t l = 0; l < 4; ++l)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto c = static_cast<double>(w[l][k]);
      value = larger(value, absolute(c));
      if (k > 0) along = larger(along, absolute(c - static_cast<double>(w[l][k - 1])));
      if (l > 0) across = larger(across, absolute(c - static_cast<double>(w[l - 1][k])));
    }
  const SplineValues jet(grid, at);
  const SplineErrors error(grid, value, along, across);
  return {{jet.U, error.U}, {jet.Ux, error.Ux}, {jet.Uy, error.Uy}};
}

template <class N>
Jet<N> jet(const HeightGrid& grid, const Place& at) noexcept {
  if (grid.interpolant() == height::Interpolant::bilinear) return bilinear_jet<N>(grid, at);
  if constexpr (std::is_same_v<N, Tracked>)
    return tracked_spline_jet(grid, at);
  else
    return spline_jet<N>(grid, at);
}

}  // namespace forceshade::fast
