// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "forceshade/reference/height_energy.h"
#include "forceshade/reference/height_jet.h"

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
  Answer operator()(const std::shared_ptr<const height::Grid>& grid) const {
    const auto& values = grid->values;
    return level_if(std::all_of(values.begin(), values.end(), [&](float value) { return value == values.front(); }));
  }

  static Answer level_if(bool is_level) { return is_level ? Answer(Gradient{0, 0}) : std::nullopt; }
};

// Of a map each part of which has one everywhere.
std::optional<Gradient> constant_gradient(const HeightMap& map) {
  Gradient sum{0, 0};
  for (const height::Part& part : map.parts) {
    const auto one = std::visit(ConstantGradient{}, part.shape);
    if (!one) return std::nullopt;
    const Rational sign = part.negated ? -1 : 1;
    sum = {sum.x + sign * one->x, sum.y + sign * one->y};
  }
  return sum;
}

}  // namespace

std::optional<std::string> potential(const HeightLaw& law) {
  const std::string spring = "K/2 max(0, U(x, y) - z)^2";
  if (law.rendering() == height::Rendering::conservative) return spring;
  const std::lock_guard lock(slow_numbers);
  const auto gradient = constant_gradient(law.map());
  if (!gradient) return std::nullopt;
  const bool is_level = sign(gradient->x) == 0 && sign(gradient->y) == 0;
  if (law.rendering() == height::Rendering::true_height)
    return is_level ? spring : spring + " / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere";
  return is_level ? std::optional<std::string>("K/2 max(0, -z)^2") : std::nullopt;
}

}  // namespace forceshade::reference
