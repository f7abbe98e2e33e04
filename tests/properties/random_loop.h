// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simple loop in a slice of a height map, anywhere between two heights.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "reference/height_energy.h"

namespace forceshade::reference {

// Closed, counter-clockwise; bottom and top: mm.
inline std::vector<Eigen::Vector3f> random_loop(std::mt19937& random, const Slice& slice, float bottom, float top) {
  const auto uniform = [&](float from, float to) { return std::uniform_real_distribution<float>(from, to)(random); };
  std::vector<Eigen::Vector3f> loop;
  const float length = slice.to - slice.from, middle = uniform(slice.from, slice.to),
              reach = std::min({uniform(length / 65, length / 2), middle - slice.from, slice.to - middle});
  for (int corner = 0; corner < 12; ++corner) {
    const float angle = (static_cast<float>(corner) + uniform(0, 0.9F)) * static_cast<float>(M_PI) / 6, size = uniform(0.5F, 1);
    const float s = middle + reach * size * std::cos(angle),
                z = (top + bottom) / 2 + (top - bottom) / 2 * size * std::sin(angle);
    loop.push_back(slice.along == Slice::Along::x ? Eigen::Vector3f(s, slice.at, z) : Eigen::Vector3f(slice.at, s, z));
  }
  loop.push_back(loop.front());
  return loop;
}

}  // namespace forceshade::reference
