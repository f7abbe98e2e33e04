// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sampled maps: bilinear, and the uniform cubic B-spline, as the tensor products of their basis polynomials and of these
// polynomials' derivatives.

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "reference/heights/kind.h"
#include "text/number_text.h"

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

  // The rest of that: in [0, 1) inside the cell.
  template <class N>
  N t(const N& coordinate) const {
    return coordinate / N(static_cast<double>(pitch)) + N(0.5 * (count - 1.0) - static_cast<double>(index));
  }

  // The place of sample index + k.
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

template <>
constexpr Formula formula<height::Grid>() {
  return Formula::polynomial;
}

inline DomainError error_of(const std::shared_ptr<const height::Grid>& grid) {
  if (grid == nullptr) return ParameterError{"grid", "", 0, 1, 1};
  if (const auto error = check("columns", "", static_cast<float>(grid->columns), 2, 32768)) return error;
  if (const auto error = check("rows", "", static_cast<float>(grid->rows), 2, 32768)) return error;
  if (const auto error = check("pitch", "mm", grid->pitch, 0.001F, 100)) return error;
  const std::size_t count = std::size_t{grid->columns} * grid->rows;
  if (grid->values.size() != count) {
    const auto wanted = static_cast<float>(count);
    return ParameterError{"number of values", "", static_cast<float>(grid->values.size()), wanted, wanted};
  }
  for (const float value : grid->values)
    if (const auto error = check_value(value)) return error;
  return std::nullopt;
}

// The lines of a grid across one axis; returns the cell at the start. Beyond a clamped grid nothing changes.
inline long cut_lines(const height::Grid& grid, std::uint32_t count, float from, float to, const Cell& one, Cuts& cuts) {
  const bool is_clamped = grid.edge == height::Edge::clamp;
  const long least = -3, most = static_cast<long>(count);
  const auto place = [&](long line) {
    return (static_cast<double>(line) - 0.5 * (count - 1.0)) * static_cast<double>(grid.pitch);  // exact: 41 bits
  };
  long cell = GridCell::at(static_cast<double>(from), grid.pitch, count).index;
  const bool is_backwards = to < from;
  if (is_clamped) cell = std::clamp(cell, least, most);
  const long step = is_backwards ? -1 : 1;
  for (long line = is_backwards ? cell : cell + 1;; line += step) {
    const double at = place(line);
    if (is_backwards ? at <= static_cast<double>(to) : at >= static_cast<double>(to)) break;
    if (is_clamped && (line <= least || line > most)) break;
    const auto t = [&]<class N>() -> N {
      return (N(at) - Cuts::number<N>(from)) / (Cuts::number<N>(to) - Cuts::number<N>(from));
    };
    cuts.add(t, {step * one.column, step * one.row});
  }
  return cell;
}

inline void cut(const height::Grid& grid, Cuts& cuts) {
  const Segment& way = cuts.segment();
  cuts.cells.back().column = cut_lines(grid, grid.columns, way.x0, way.x1, {1, 0}, cuts);
  cuts.cells.back().row = cut_lines(grid, grid.rows, way.y0, way.y1, {0, 1}, cuts);
}
template <class N>
Jet<N> jet_in(const height::Grid& grid, const OnWay<N>& at) {
  const GridCell column{at.cell.column, grid.pitch, grid.columns}, row{at.cell.row, grid.pitch, grid.rows};
  // Beyond a clamped grid all places are alike.
  const auto within = [&](const GridCell& axis, const N& coordinate) {
    if (grid.edge == height::Edge::tile || (axis.index > -3 && axis.index < static_cast<long>(axis.count))) return coordinate;
    return N((static_cast<double>(axis.index) - 0.5 * (axis.count - 1.0)) * static_cast<double>(grid.pitch));
  };
  return cell_jet(grid, column, row, within(column, at.x), within(row, at.y));
}

inline std::optional<ConstantGradient> constant_gradient(const height::Grid& grid) {
  return level_if(std::ranges::all_of(grid.values, [&](float value) { return value == grid.values[0]; }));
}

inline double tallest(const height::Grid& grid, double, double) {
  double most = 0;
  for (const float value : grid.values) most = std::max(most, size_of(value));
  return most;
}

// Largest sizes of the differences between neighbouring values, edges included.
struct Differences {
  double along = 0, across = 0;                // of two side by side in x, in y
  double second_along = 0, second_across = 0;  // of three
  double mixed = 0;                            // of four around a cell
  double kink = 0;                             // of second_along and second_across the larger
  long kink_column = 0, kink_row = 0;          // and where it is

  explicit Differences(const height::Grid& grid) {
    const long columns = grid.columns, rows = grid.rows;
    const auto beyond = [&](long i, long n) {
      return grid.edge == height::Edge::tile ? (i + n) % n : std::clamp(i, 0L, n - 1);
    };
    const auto grow = [](double& largest, double size) { largest = std::max(largest, std::fabs(size)); };
    for (long j = 0; j < rows; ++j)
      for (long i = 0; i < columns; ++i) {
        const auto value = [&](long k, long l) {
          return static_cast<double>(
              grid.values[static_cast<std::size_t>(beyond(j + l, rows) * columns + beyond(i + k, columns))]);
        };
        const double here = value(0, 0), right = value(1, 0), up = value(0, 1);
        grow(along, right - here);
        grow(across, up - here);
        grow(mixed, value(1, 1) - right - up + here);
        const double in_x = right - 2 * here + value(-1, 0), in_y = up - 2 * here + value(0, -1);
        grow(second_along, in_x);
        grow(second_across, in_y);
        if (const double size = std::max(std::fabs(in_x), std::fabs(in_y)); size > kink) {
          kink = size;
          kink_column = i;
          kink_row = j;
        }
      }
  }
};

inline Outline outline_of(const height::Grid& grid) {
  const Differences differences(grid);
  const auto pitch = static_cast<double>(grid.pitch);
  const Lines columns{pitch, grid.columns}, rows{pitch, grid.rows};
  const bool is_bilinear = grid.interpolant == height::Interpolant::bilinear;
  Outline shape{.kind = is_bilinear ? "bilinear grid" : "cubic-spline grid",
                .steepest = std::hypot(differences.along, differences.across) / pitch};
  shape.reach = std::min(0.6 * pitch * std::max(grid.columns, grid.rows), 1e4);
  shape.columns = columns;
  shape.rows = rows;
  if (is_bilinear) {
    if (differences.kink > 0)
      shape.kinks = {"its cell lines, the gradient by up to " + forceshade::digits(differences.kink / pitch, 3) + " at (" +
                     forceshade::digits(columns.at(differences.kink_column), 6) + ", " +
                     forceshade::digits(rows.at(differences.kink_row), 6) + ") mm"};
    shape.gradient_change = [=, rate = differences.mixed / (pitch * pitch)](double x, double y, double reach) {
      return GradientChange{rate, std::min(columns.distance(x), rows.distance(y)) <= reach + kOutlineSlack};
    };
  } else {
    // The second derivatives are averages of second differences, with weights that add up to 1.
    const double rate = std::max(differences.second_along, differences.second_across) + differences.mixed;
    shape.gradient_change = [rate = rate / (pitch * pitch)](auto...) { return GradientChange{rate, false}; };
  }
  return shape;
}

}  // namespace forceshade::reference
