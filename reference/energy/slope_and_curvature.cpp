// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy/slope_and_curvature.h"

#include <cmath>
#include <stdexcept>

#include "reference/heights/all.h"

namespace forceshade::reference {

SlopeAndCurvature slope_and_curvature(const std::vector<height::Part>& parts, const Enclosure& x, double inside) {
  SlopeAndCurvature sum = section::level();
  for (const height::Part& part : parts) {
    const SlopeAndCurvature one =
        std::visit([&](const auto& shape) { return slope_and_curvature_of(as_shape(shape), x, inside); }, part.shape);
    sum = part.negated ? SlopeAndCurvature{sum.slope - one.slope, sum.curvature - one.curvature}
                       : SlopeAndCurvature{sum.slope + one.slope, sum.curvature + one.curvature};
  }
  return sum;
}

Kink kink_between(const height::Part& part, double from, double to) {
  return std::visit([&](const auto& shape) { return kink_of(as_shape(shape), from, to); }, part.shape);
}

void add_grid_lines(const height::Part& part, double from, double to, std::size_t most, std::vector<double>& lines) {
  const auto* grid = std::get_if<std::shared_ptr<const height::Grid>>(&part.shape);
  if (grid == nullptr) return;
  const double pitch = static_cast<double>((*grid)->pitch), middle = 0.5 * ((*grid)->columns - 1.0);
  if ((to - from) / pitch > static_cast<double>(most))
    throw std::invalid_argument("the section crosses too many cells of a grid");
  // A product of at most 26 and 24 bits: exact.
  for (double i = std::floor(from / pitch + middle); (i - middle) * pitch < to; ++i)
    if ((i - middle) * pitch > from) lines.push_back((i - middle) * pitch);
}

}  // namespace forceshade::reference
