// SPDX-License-Identifier: BSD-3-Clause
#include "fast/heights/domain.h"

#include "fast/heights/all.h"

namespace forceshade::fast {

MaybeError first_error(const HeightMap& map, height::Mode mode, float stiffness) noexcept {
  using namespace height_limits;
  if (const auto error = first_outside({{"stiffness", "N/mm", stiffness, kSmallestStiffness, kLargestStiffness},
                                        {"number of parts", "", static_cast<float>(map.parts.size()), 1, kMostParts}}))
    return error;
  for (const height::Part& part : map.parts)
    if (const auto error = std::visit([](const auto& shape) { return error_of(shape); }, part.shape)) return error;
  const float most = mode == height::Mode::force_shaded ? kMostParts : 0;
  if (const auto error = first_outside({{"number of surface parts", "", static_cast<float>(map.surface.size()), 0, most}}))
    return error;
  for (const height::Part& part : map.surface)
    if (const auto error = std::visit([](const auto& shape) { return error_of(shape); }, part.shape)) return error;
  return std::nullopt;
}

}  // namespace forceshade::fast
