// SPDX-License-Identifier: BSD-3-Clause
#include "reference/heights/domain.h"

#include "reference/heights/all.h"

namespace forceshade::reference {
namespace {

DomainError error_of_any(const height::Shape& shape) {
  return std::visit([](const auto& one) { return error_of(one); }, shape);
}

}  // namespace

std::optional<ParameterError> first_error(const HeightMap& map, height::Mode mode, float stiffness) {
  if (const auto error = check("stiffness", "N/mm", stiffness, 0.001F, 1000)) return error;
  if (const auto error = check("number of parts", "", static_cast<float>(map.parts.size()), 1, 16)) return error;
  for (const height::Part& part : map.parts)
    if (const auto error = error_of_any(part.shape)) return error;
  const float most = mode == height::Mode::force_shaded ? 16 : 0;
  if (const auto error = check("number of surface parts", "", static_cast<float>(map.surface.size()), 0, most)) return error;
  for (const height::Part& part : map.surface)
    if (const auto error = error_of_any(part.shape)) return error;
  return std::nullopt;
}

}  // namespace forceshade::reference
