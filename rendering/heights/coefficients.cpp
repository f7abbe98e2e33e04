// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/heights/coefficients.h"

#include <algorithm>
#include <cmath>

namespace forceshade::heights {
namespace {

// The pole of the filter 6/(z + 4 + 1/z): M. Unser, "Splines: a perfect fit for signal and image processing", 1999.
const double kPole = std::sqrt(3.0) - 2;
constexpr std::int64_t kTerms = 40;  // kPole^40 is below 2^-75

// The sample that stands for one beyond the edge. A clamped spline has c(-1) = c(0), as heights that are mirrored half a
// sample beyond the edge have.
std::int64_t within(std::int64_t i, std::int64_t n, height::Edge edge) {
  if (edge == height::Edge::tile) return (i % n + n) % n;
  const std::int64_t j = (i % (2 * n) + 2 * n) % (2 * n);
  return j < n ? j : 2 * n - 1 - j;
}

// Along one axis of n steps, for `lanes` neighbours side by side at once: c⁺(k) = 6 s(k) + z c⁺(k - 1), then
// c(k) = z (c(k + 1) - c⁺(k)).
void filter(double* data, std::int64_t n, std::int64_t stride, std::int64_t lanes, height::Edge edge) {
  const auto at = [&](std::int64_t k, std::int64_t lane) -> double& { return data[k * stride + lane]; };
  std::vector<double> edge_value(static_cast<std::size_t>(lanes));
  const auto sum_from = [&](std::int64_t first, std::int64_t step, std::int64_t lane) {
    double sum = 0, weight = 1;
    for (std::int64_t k = 0; k < kTerms; ++k, weight *= kPole) sum += weight * at(within(first + step * k, n, edge), lane);
    return sum;
  };
  for (std::int64_t lane = 0; lane < lanes; ++lane) edge_value[static_cast<std::size_t>(lane)] = 6 * sum_from(0, -1, lane);
  for (std::int64_t lane = 0; lane < lanes; ++lane) at(0, lane) = edge_value[static_cast<std::size_t>(lane)];
  for (std::int64_t k = 1; k < n; ++k)
    for (std::int64_t lane = 0; lane < lanes; ++lane) at(k, lane) = 6 * at(k, lane) + kPole * at(k - 1, lane);
  for (std::int64_t lane = 0; lane < lanes; ++lane)
    edge_value[static_cast<std::size_t>(lane)] =
        edge == height::Edge::tile ? -kPole * sum_from(n - 1, 1, lane) : kPole / (kPole - 1) * at(n - 1, lane);
  for (std::int64_t lane = 0; lane < lanes; ++lane) at(n - 1, lane) = edge_value[static_cast<std::size_t>(lane)];
  for (std::int64_t k = n - 2; k >= 0; --k)
    for (std::int64_t lane = 0; lane < lanes; ++lane) at(k, lane) = kPole * (at(k + 1, lane) - at(k, lane));
}

}  // namespace

void make_coefficients(std::vector<float>& values, std::uint32_t columns, std::uint32_t rows, height::Edge edge,
                       const Monitor& monitor) {
  constexpr std::uint32_t kLanes = 64;  // some lines of the cache, and some ms at most
  std::vector<double> data(values.begin(), values.end());
  for (std::size_t row = 0; row < rows; ++row) {
    monitor.at(0.5 * static_cast<double>(row) / rows);
    filter(&data[row * columns], columns, 1, 1, edge);
  }
  for (std::uint32_t column = 0; column < columns; column += kLanes) {
    monitor.at(0.5 + 0.5 * column / columns);
    filter(&data[column], rows, columns, std::min(kLanes, columns - column), edge);
  }
  for (std::size_t i = 0; i < data.size(); ++i) values[i] = static_cast<float>(data[i]);
}

}  // namespace forceshade::heights
