// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Height maps on grids of given values, and the real-time law of a map.

#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <utility>
#include <variant>

#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::tests {

inline float uniform(std::mt19937_64& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

inline std::shared_ptr<const height::Grid> grid(std::uint32_t columns, std::uint32_t rows, float pitch, height::Edge edge,
                                                height::Interpolant interpolant,
                                                const std::function<float(std::uint32_t, std::uint32_t)>& value) {
  height::Grid g{columns, rows, pitch, edge, interpolant, {}};
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) g.values.push_back(value(i, j));
  return std::make_shared<const height::Grid>(std::move(g));
}

inline fast::HeightMapField fast_law(const HeightMap& map, height::Mode mode, float stiffness = 0.5F) {
  return std::get<fast::HeightMapField>(fast::HeightMapField::build(map, mode, stiffness));
}

}  // namespace forceshade::tests
