// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sampled maps: bilinear, and the uniform cubic B-spline, as the tensor products of their basis polynomials and of these
// polynomials' derivatives.

#include <array>
#include <utility>

#include "forceshade/reference/heights/jet.h"

namespace forceshade::reference {

// One axis of a grid.
struct GridCell {
  long index;
  float pitch;
  std::uint32_t count;

  // Cell ⌊where/pitch + (samples - 1)/2⌋.
  static GridCell at(double where, float pitch, std::uint32_t samples) {
    const Rational place = Rational(where) / Rational(static_cast<double>(pitch)) + Rational(samples - 1.0) / Rational(2);
    // Truncated by the division of whole numbers, then corrected to the floor.
    const CORE::BigInt whole = CORE::numerator(place) / CORE::denominator(place);
    const long index = whole.longValue();
    return {place < Rational(static_cast<double>(index)) ? index - 1 : index, pitch, samples};
  }

  // What is left of that: in [0, 1) inside the cell.
  template <class N>
  N t(const N& coordinate) const {
    return coordinate / N(static_cast<double>(pitch)) + N(0.5 * (count - 1.0) - static_cast<double>(index));
  }

  // Where sample index + k is kept.
  std::size_t sample(long k, height::Edge edge) const {
    const long n = count, i = index + k;
    if (edge == height::Edge::tile) return static_cast<std::size_t>((i % n + n) % n);
    return static_cast<std::size_t>(i < 0 ? 0 : i >= n ? n - 1 : i);
  }
};

template <class N, std::size_t kOrder>
struct Basis {
  std::array<N, kOrder> value, slope;
};

template <class N>
Basis<N, 2> linear_basis(const N& t) {
  return {{N(N(1.0) - t), t}, {N(-1.0), N(1.0)}};
}

template <class N>
Basis<N, 4> cubic_basis(const N& t) {
  const N one(1.0), two(2.0), three(3.0), four(4.0), six(6.0), nine(9.0), twelve(12.0);
  const N s = one - t;
  return {{N(s * s * s / six), N((three * t * t * t - six * t * t + four) / six),
           N((one + three * t + three * t * t - three * t * t * t) / six), N(t * t * t / six)},
          {N(-(three * s * s) / six), N((nine * t * t - twelve * t) / six), N((three + six * t - nine * t * t) / six),
           N(three * t * t / six)}};
}

// kFirst: of the samples that a cell takes, relative to its own.
template <class N, std::size_t kOrder>
Jet<N> tensor_product(const height::Grid& grid, long first, const GridCell& column, const GridCell& row,
                      const Basis<N, kOrder>& bx, const Basis<N, kOrder>& by) {
  const N pitch(static_cast<double>(grid.pitch));
  Jet<N> sum = Jet<N>::flat();
  for (std::size_t l = 0; l < kOrder; ++l) {
    const std::size_t j = row.sample(first + static_cast<long>(l), grid.edge);
    N value(0.0), slope(0.0);
    for (std::size_t k = 0; k < kOrder; ++k) {
      const std::size_t i = column.sample(first + static_cast<long>(k), grid.edge);
      const N c(static_cast<double>(grid.values[j * grid.columns + i]));
      value = value + c * bx.value[k];
      slope = slope + c * bx.slope[k];
    }
    sum = sum + Jet<N>{value * by.value[l], slope * by.value[l], value * by.slope[l]};
  }
  return {sum.U, sum.Ux / pitch, sum.Uy / pitch};
}

template <class N>
Jet<N> cell_jet(const height::Grid& grid, const GridCell& column, const GridCell& row, const N& x, const N& y) {
  const N t = column.t(x), s = row.t(y);
  if (grid.interpolant == height::Interpolant::bilinear)
    return tensor_product<N, 2>(grid, 0, column, row, linear_basis(t), linear_basis(s));
  return tensor_product<N, 4>(grid, -1, column, row, cubic_basis(t), cubic_basis(s));
}

template <class N>
Jet<N> jet(const height::Grid& grid, const Point2& at) {
  return cell_jet(grid, GridCell::at(at.x, grid.pitch, grid.columns), GridCell::at(at.y, grid.pitch, grid.rows), N(at.x),
                  N(at.y));
}

}  // namespace forceshade::reference
