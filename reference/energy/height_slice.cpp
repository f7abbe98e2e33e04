// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "reference/energy/height_circulation.h"
#include "reference/heights/all.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

constexpr float kMostCells = 65536;

}  // namespace

double tallest(const HeightMapField& law, const Slice& slice) {
  const bool is_shaded = law.mode() == height::Mode::force_shaded;
  const Segment way = segment_of(slice);
  const double largest_x = std::max(size_of(way.x0), size_of(way.x1)), largest_y = std::max(size_of(way.y0), size_of(way.y1));
  double sum = 0;
  for (const height::Part& part : is_shaded ? law.map().surface : law.map().parts)
    sum += std::visit([&](const auto& shape) { return tallest(as_shape(shape), largest_x, largest_y); }, part.shape);
  return sum;
}

std::optional<ParameterError> slice_error(const HeightMapField& law, const Slice& slice, float depth) {
  const auto outside = [](const char* name, const char* unit, float value, float low, float high) {
    return value >= low && value <= high ? std::nullopt
                                         : std::optional<ParameterError>(ParameterError{name, unit, value, low, high});
  };
  if (const auto error = outside("at", "mm", slice.at, -kDomainEnd, kDomainEnd)) return error;
  if (const auto error = outside("from", "mm", slice.from, -kDomainEnd, std::nextafter(kDomainEnd, 0.0F))) return error;
  if (const auto error = outside("to", "mm", slice.to, std::nextafter(slice.from, kDomainEnd), kDomainEnd)) return error;
  for (const auto* parts : {&law.map().parts, &law.map().surface})
    for (const height::Part& part : *parts)
      if (const auto* grid = std::get_if<std::shared_ptr<const height::Grid>>(&part.shape))
        if (const auto error = outside("number of cells", "", (slice.to - slice.from) / (*grid)->pitch, 0, kMostCells))
          return error;
  // A loop returns up to a quarter of its depth above the highest place.
  const auto height = static_cast<float>(tallest(law, slice));
  if (const auto error = outside("largest height", "mm", height, 0, kDomainEnd / 2)) return error;
  const float reach = std::max({std::fabs(slice.from), std::fabs(slice.to), height});
  return outside("depth", "mm", depth, reach / kDomainEnd, (kDomainEnd - height) / 2);
}

}  // namespace forceshade::reference
