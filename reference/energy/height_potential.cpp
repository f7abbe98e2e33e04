// SPDX-License-Identifier: BSD-3-Clause
#include "reference/height_energy.h"
#include "reference/heights/all.h"

namespace forceshade::reference {
namespace {

// The gradient of a map each part of which has one everywhere.
std::optional<ConstantGradient> gradient_of(const std::vector<height::Part>& parts) {
  ConstantGradient sum{0, 0};
  for (const height::Part& part : parts) {
    const auto one = std::visit([](const auto& shape) { return constant_gradient(as_shape(shape)); }, part.shape);
    if (!one) return std::nullopt;
    const Rational sign = part.negated ? -1 : 1;
    sum = {sum.x + sign * one->x, sum.y + sign * one->y};
  }
  return sum;
}

}  // namespace

std::optional<std::string> potential(const HeightMapField& law) {
  const bool is_shaded = law.mode() == height::Mode::force_shaded;
  const std::string height = !is_shaded ? "U(x, y) - z" : law.map().surface.empty() ? "-z" : "S(x, y) - z";
  const std::string spring = "K/2 max(0, " + height + ")^2";
  if (law.mode() == height::Mode::conservative) return spring;
  const std::lock_guard lock(exact_arithmetic);
  const auto gradient = gradient_of(law.map().parts);
  const auto surface = is_shaded ? gradient_of(law.map().surface) : gradient;
  if (!gradient || !surface || surface->x != gradient->x || surface->y != gradient->y) return std::nullopt;
  const bool is_level = sign(gradient->x) == 0 && sign(gradient->y) == 0;
  return is_level ? spring : spring + " / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere";
}

}  // namespace forceshade::reference
