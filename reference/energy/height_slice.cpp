// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "forceshade/reference/energy/height_circulation.h"
#include "forceshade/reference/position.h"

namespace forceshade::reference {
namespace {

constexpr float kMostCells = 65536;

struct Tallest {
  double largest_x, largest_y;  // mm, of the slice

  double operator()(const height::Plane& p) const {
    return size(p.height) + size(p.slope_x) * largest_x + size(p.slope_y) * largest_y;
  }
  double operator()(const height::Cone& c) const { return size(c.height); }
  double operator()(const height::CylinderCap& c) const { return cap(c.radius, c.width); }
  double operator()(const height::SphereCap& c) const { return cap(c.radius, c.width); }
  double operator()(const height::Gaussian& g) const { return size(g.height); }
  double operator()(const height::Grating& g) const { return size(g.height); }
  double operator()(const height::Polygons& p) const {
    double most = 0;
    for (const height::Knot& knot : p.knots) most = std::max(most, size(knot.height));
    return most;
  }
  double operator()(const std::shared_ptr<const height::Grid>& grid) const {
    double most = 0;
    for (const float value : grid->values) most = std::max(most, size(value));
    return most;
  }

  // A part in a million more than R - sqrt(R² - (w/2)²).
  static double cap(float radius, float width) {
    const double R = size(radius), half = size(width) / 2;
    return half * half / (R + std::sqrt((R - half) * (R + half))) * (1 + 1e-6);
  }
  static double size(float value) { return std::fabs(static_cast<double>(value)); }
};

}  // namespace

double tallest(const HeightMapField& law, const Slice& slice) {
  const bool is_shaded = law.rendering() == height::Rendering::force_shaded;
  const Way way = way_of(slice);
  const Tallest of{std::max(Tallest::size(way.x0), Tallest::size(way.x1)),
                   std::max(Tallest::size(way.y0), Tallest::size(way.y1))};
  double sum = 0;
  for (const height::Part& part : is_shaded ? law.map().surface : law.map().parts) sum += std::visit(of, part.shape);
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
