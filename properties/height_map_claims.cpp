// SPDX-License-Identifier: BSD-3-Clause
#include "properties/height_map_claims.h"

#include "reference/height_energy.h"

namespace forceshade::properties {

HeightMapClaims::HeightMapClaims(const reference::HeightMapField& law)
    : mode(law.mode()),
      stiffness(static_cast<double>(law.stiffness())),
      is_conservative(reference::potential(law).has_value()) {
  const auto add = [&](const std::vector<height::Part>& all, double& sum) {
    for (const height::Part& part : all) {
      parts.push_back(reference::outline(part));
      sum += parts.back().steepest;
    }
  };
  add(law.map().parts, steepest);
  map_parts = parts.size();
  add(law.map().surface, steepest_surface);
  if (mode != height::Mode::force_shaded) steepest_surface = steepest;
}

GradientChange HeightMapClaims::gradient_change(double x, double y, double reach) const {
  GradientChange sum;
  for (std::size_t i = 0; i < map_parts; ++i) {
    const GradientChange one = parts[i].gradient_change(x, y, reach);
    sum.rate += one.rate;
    sum.kink = sum.kink || one.kink;
  }
  return sum;
}

std::vector<std::string> HeightMapClaims::jumps() const {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < map_parts; ++i)
    for (const std::string& kink : parts[i].kinks)
      words.push_back("part " + std::to_string(i + 1) + ", " + parts[i].kind + ": " + kink);
  return words;
}

}  // namespace forceshade::properties
