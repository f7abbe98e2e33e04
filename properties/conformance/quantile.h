// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quantiles by nearest rank.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace forceshade::conformance {

// The smallest value that so large a share of them does not exceed; 0 of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto count = static_cast<double>(values.size());
  const auto at = static_cast<std::size_t>(std::clamp(std::ceil(share * count) - 1, 0.0, count - 1));
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
  return values[at];
}

}  // namespace forceshade::conformance
