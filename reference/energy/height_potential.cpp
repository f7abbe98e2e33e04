// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "forceshade/reference/height_energy.h"
#include "forceshade/reference/heights/jet.h"

namespace forceshade::reference {
namespace {

struct Gradient {
  Rational x, y;
};

struct ConstantGradient {
  using Answer = std::optional<Gradient>;

  Answer operator()(const height::Plane& p) const {
    return Gradient{Rational(static_cast<double>(p.slope_x)), Rational(static_cast<double>(p.slope_y))};
  }
  Answer operator()(const height::Cone& c) const { return level_if(c.height == 0); }
  Answer operator()(const height::CylinderCap&) const { return std::nullopt; }
  Answer operator()(const height::SphereCap&) const { return std::nullopt; }
  Answer operator()(const height::Gaussian& g) const { return level_if(g.height == 0); }
  Answer operator()(const height::Grating& g) const { return level_if(g.height == 0 || (g.wave_x == 0 && g.wave_y == 0)); }
  Answer operator()(const height::Polygons& p) const {
    return level_if(std::ranges::all_of(p.knots, [&](const height::Knot& knot) { return knot.height == p.knots[0].height; }));
  }
  Answer operator()(const std::shared_ptr<const height::Grid>& grid) const {
    return level_if(std::ranges::all_of(grid->values, [&](float value) { return value == grid->values[0]; }));
  }

  static Answer level_if(bool is_level) { return is_level ? Answer(Gradient{0, 0}) : std::nullopt; }
};

// Of a map each part of which has one everywhere.
std::optional<Gradient> constant_gradient(const std::vector<height::Part>& parts) {
  Gradient sum{0, 0};
  for (const height::Part& part : parts) {
    const auto one = std::visit(ConstantGradient{}, part.shape);
    if (!one) return std::nullopt;
    const Rational sign = part.negated ? -1 : 1;
    sum = {sum.x + sign * one->x, sum.y + sign * one->y};
  }
  return sum;
}

}  // namespace

std::optional<std::string> potential(const HeightMapField& law) {
  const bool is_shaded = law.rendering() == height::Rendering::force_shaded;
  const std::string height = !is_shaded ? "U(x, y) - z" : law.map().surface.empty() ? "-z" : "S(x, y) - z";
  const std::string spring = "K/2 max(0, " + height + ")^2";
  if (law.rendering() == height::Rendering::conservative) return spring;
  const std::lock_guard lock(exact_arithmetic);
  const auto gradient = constant_gradient(law.map().parts);
  const auto surface = is_shaded ? constant_gradient(law.map().surface) : gradient;
  if (!gradient || !surface || surface->x != gradient->x || surface->y != gradient->y) return std::nullopt;
  const bool is_level = sign(gradient->x) == 0 && sign(gradient->y) == 0;
  return is_level ? spring : spring + " / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere";
}

}  // namespace forceshade::reference
