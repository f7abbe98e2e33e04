// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/heights/domain.h"

#include <cmath>

namespace forceshade::reference {
namespace {

using Error = std::optional<ParameterError>;

Error check(const char* name, const char* unit, float value, float low, float high) {
  return value >= low && value <= high ? std::nullopt : Error(ParameterError{name, unit, value, low, high});
}

Error check_centre(float x, float y) {
  if (const auto error = check("centre x", "mm", x, -10000, 10000)) return error;
  return check("centre y", "mm", y, -10000, 10000);
}

Error check_height(float value) {
  return check("height", "mm", value, -10000, 10000);
}

Error check_value(float value) {
  return value == 0 ? std::nullopt : check("size of a value", "mm", std::fabs(value), std::ldexp(1.0F, -30), 10000);
}

Error check_cap(float radius, float width) {
  if (const auto error = check("radius", "mm", radius, 0.1F, 10000)) return error;
  return check("width", "mm", width, 0.001F, std::nextafter(2 * radius, 0.0F));
}

struct CheckShape {
  Error operator()(const height::Plane& p) const {
    if (const auto error = check("slope x", "", p.slope_x, -1000, 1000)) return error;
    if (const auto error = check("slope y", "", p.slope_y, -1000, 1000)) return error;
    return check_height(p.height);
  }
  Error operator()(const height::Cone& c) const {
    if (const auto error = check_centre(c.x, c.y)) return error;
    if (const auto error = check_height(c.height)) return error;
    return check("radius", "mm", c.radius, 0.001F, 10000);
  }
  Error operator()(const height::CylinderCap& c) const {
    if (const auto error = check_centre(c.x, 0)) return error;
    return check_cap(c.radius, c.width);
  }
  Error operator()(const height::SphereCap& c) const {
    if (const auto error = check_centre(c.x, c.y)) return error;
    return check_cap(c.radius, c.width);
  }
  Error operator()(const height::Gaussian& g) const {
    if (const auto error = check_centre(g.x, g.y)) return error;
    if (const auto error = check_height(g.height)) return error;
    return check("sigma", "mm", g.sigma, 0.001F, 10000);
  }
  Error operator()(const height::Grating& g) const {
    if (const auto error = check_height(g.height)) return error;
    if (const auto error = check("wave x", "rad/mm", g.wave_x, -1000, 1000)) return error;
    if (const auto error = check("wave y", "rad/mm", g.wave_y, -1000, 1000)) return error;
    return check("phase", "rad", g.phase, -1000, 1000);
  }
  Error operator()(const height::Polygons& p) const {
    if (const auto error = check("number of knots", "", static_cast<float>(p.knots.size()), 2, 1025)) return error;
    for (const height::Knot& knot : p.knots) {
      if (const auto error = check("knot x", "mm", knot.x, -10000, 10000)) return error;
      if (const auto error = check_value(knot.height)) return error;
    }
    for (std::size_t i = 1; i < p.knots.size(); ++i) {
      const double step = static_cast<double>(p.knots[i].x) - static_cast<double>(p.knots[i - 1].x);
      if (step < static_cast<double>(0.001F))
        return ParameterError{"step between knots", "mm", static_cast<float>(step), 0.001F, 20000};
    }
    return std::nullopt;
  }
  Error operator()(const std::shared_ptr<const height::Grid>& grid) const {
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
};

}  // namespace

std::optional<ParameterError> first_error(const HeightMap& map, height::Rendering rendering, float stiffness) {
  if (const auto error = check("stiffness", "N/mm", stiffness, 0.001F, 1000)) return error;
  if (const auto error = check("number of parts", "", static_cast<float>(map.parts.size()), 1, 16)) return error;
  for (const height::Part& part : map.parts)
    if (const auto error = std::visit(CheckShape{}, part.shape)) return error;
  const float most = rendering == height::Rendering::force_shaded ? 16 : 0;
  if (const auto error = check("number of surface parts", "", static_cast<float>(map.surface.size()), 0, most)) return error;
  for (const height::Part& part : map.surface)
    if (const auto error = std::visit(CheckShape{}, part.shape)) return error;
  return std::nullopt;
}

}  // namespace forceshade::reference
