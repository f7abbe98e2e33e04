// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// grid: what a sampled map is beside its values, which are in fast/heights/grid.h and spline.h.

#include <memory>

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/spline.h"

namespace forceshade::fast {

inline MaybeError error_of(const std::shared_ptr<const height::Grid>& grid) noexcept {
  using namespace height_limits;
  if (grid == nullptr) return ParameterError{"grid", "", 0, 1, 1};
  const auto samples = [](const char* name, std::uint32_t count) {
    return ParameterError{name, "", static_cast<float>(count), kFewestSamples, kMostSamples};
  };
  if (const auto error = first_outside({samples("columns", grid->columns),
                                        samples("rows", grid->rows),
                                        {"pitch", "mm", grid->pitch, kSmallestPitch, kLargestPitch}}))
    return error;
  const std::size_t count = std::size_t{grid->columns} * grid->rows;
  if (grid->values.size() != count) {
    const auto wanted = static_cast<float>(count);
    return ParameterError{"number of values", "", static_cast<float>(grid->values.size()), wanted, wanted};
  }
  for (const float value : grid->values)
    if (const auto error = error_of_value(value)) return error;
  return std::nullopt;
}

inline void add_terms(const HeightGrid& grid, const Place& at, ExactTerms& terms) noexcept {
  terms.add_rational(jet<Fraction>(grid, at));
}
// A spline's weights are cubic in x/p and in y/p, divided by 36.
inline DenominatorBits denominator_bits(const std::shared_ptr<const height::Grid>& grid) noexcept {
  const std::size_t bits = odd_bits(grid->pitch);
  if (grid->interpolant == height::Interpolant::bilinear) return {3 * bits, 2 * bits};
  return {6 * bits + 4, 6 * bits + 4};
}

}  // namespace forceshade::fast
