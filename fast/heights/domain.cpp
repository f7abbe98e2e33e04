// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/heights/domain.h"

#include <cmath>
#include <initializer_list>

#include "forceshade/fast/domain.h"
#include "forceshade/fast/heights/limits.h"

namespace forceshade::fast {
namespace {

using namespace height_limits;
using MaybeError = std::optional<ParameterError>;

MaybeError first_outside(std::initializer_list<ParameterError> numbers) noexcept {
  for (const ParameterError& number : numbers)
    if (!(number.value >= number.low && number.value <= number.high)) return number;
  return std::nullopt;
}

ParameterError symmetric(const char* name, const char* unit, float value, float largest) noexcept {
  return {name, unit, value, -largest, largest};
}
ParameterError centre_x(float x) noexcept {
  return symmetric("centre x", "mm", x, kLargestCoordinate);
}
ParameterError centre_y(float y) noexcept {
  return symmetric("centre y", "mm", y, kLargestCoordinate);
}
ParameterError height_of(float value) noexcept {
  return symmetric("height", "mm", value, kLargestHeight);
}
ParameterError cap_radius(float radius) noexcept {
  return {"radius", "mm", radius, kSmallestRadius, kLargestRadius};
}
// A cap as wide as the whole cylinder or sphere would be infinitely steep at its rim.
ParameterError cap_width(float radius, float width) noexcept {
  return {"width", "mm", width, kSmallestWidth, std::nextafter(2 * radius, 0.0F)};
}

MaybeError error_of(const height::Plane& p) noexcept {
  return first_outside({symmetric("slope x", "", p.slope_x, kLargestSlope), symmetric("slope y", "", p.slope_y, kLargestSlope),
                        height_of(p.height)});
}
MaybeError error_of(const height::Cone& c) noexcept {
  return first_outside(
      {centre_x(c.x), centre_y(c.y), height_of(c.height), {"radius", "mm", c.radius, kSmallestReach, kLargestReach}});
}
MaybeError error_of(const height::CylinderCap& c) noexcept {
  return first_outside({centre_x(c.x), cap_radius(c.radius), cap_width(c.radius, c.width)});
}
MaybeError error_of(const height::SphereCap& c) noexcept {
  return first_outside({centre_x(c.x), centre_y(c.y), cap_radius(c.radius), cap_width(c.radius, c.width)});
}
MaybeError error_of(const height::Gaussian& g) noexcept {
  return first_outside(
      {centre_x(g.x), centre_y(g.y), height_of(g.height), {"sigma", "mm", g.sigma, kSmallestReach, kLargestReach}});
}
MaybeError error_of(const height::Grating& g) noexcept {
  return first_outside({height_of(g.height), symmetric("wave x", "rad/mm", g.wave_x, kLargestSlope),
                        symmetric("wave y", "rad/mm", g.wave_y, kLargestSlope),
                        symmetric("phase", "rad", g.phase, kLargestSlope)});
}
// Of a sample or a knot.
MaybeError error_of_value(float value) noexcept {
  const float size = std::fabs(value);
  if (value == 0 || (size >= kPositionQuantum && size <= kLargestHeight)) return std::nullopt;
  return ParameterError{"size of a value", "mm", size, kPositionQuantum, kLargestHeight};
}
MaybeError error_of(const height::Polygons& p) noexcept {
  if (const auto error = first_outside({{"number of knots", "", static_cast<float>(p.knots.size()), kFewestKnots, kMostKnots}}))
    return error;
  for (const height::Knot& knot : p.knots) {
    if (const auto error = first_outside({symmetric("knot x", "mm", knot.x, kLargestCoordinate)})) return error;
    if (const auto error = error_of_value(knot.height)) return error;
  }
  for (std::size_t i = 1; i < p.knots.size(); ++i) {
    const double step = static_cast<double>(p.knots[i].x) - static_cast<double>(p.knots[i - 1].x);
    if (!(step >= static_cast<double>(kSmallestReach)))
      return ParameterError{"step between knots", "mm", static_cast<float>(step), kSmallestReach, 2 * kLargestCoordinate};
  }
  return std::nullopt;
}
MaybeError error_of(const std::shared_ptr<const height::Grid>& grid) noexcept {
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

}  // namespace

MaybeError first_error(const HeightMap& map, height::Rendering rendering, float stiffness) noexcept {
  if (const auto error = first_outside({{"stiffness", "N/mm", stiffness, kSmallestStiffness, kLargestStiffness},
                                        {"number of parts", "", static_cast<float>(map.parts.size()), 1, kMostParts}}))
    return error;
  for (const height::Part& part : map.parts)
    if (const auto error = std::visit([](const auto& shape) { return error_of(shape); }, part.shape)) return error;
  const float most = rendering == height::Rendering::force_shaded ? kMostParts : 0;
  if (const auto error = first_outside({{"number of surface parts", "", static_cast<float>(map.surface.size()), 0, most}}))
    return error;
  for (const height::Part& part : map.surface)
    if (const auto error = std::visit([](const auto& shape) { return error_of(shape); }, part.shape)) return error;
  return std::nullopt;
}

}  // namespace forceshade::fast
