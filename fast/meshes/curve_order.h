// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The order in which triangles lie in memory.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::fast {

// The ten lower bits spread, with two free bits after each.
inline std::uint32_t spread(std::uint32_t bits) noexcept {
  bits = (bits | bits << 16) & 0x030000FFU;
  bits = (bits | bits << 8) & 0x0300F00FU;
  bits = (bits | bits << 4) & 0x030C30C3U;
  return (bits | bits << 2) & 0x09249249U;
}

// The triangles along a Z-curve through the middles of their boxes.
inline std::vector<std::uint32_t> curve_order(const mesh::TriangleMesh& mesh) {
  std::array<float, 3> low, high;
  low.fill(HUGE_VALF);
  high.fill(-HUGE_VALF);
  for (const mesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], mesh.vertices[v][i]);
        high[i] = std::max(high[i], mesh.vertices[v][i]);
      }
  const float side = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const float scale = side > 0 ? 1023 / (3 * side) : 0;
  struct Keyed {
    std::uint32_t key, triangle;
  };
  std::vector<Keyed> keyed(mesh.triangles.size()), other(keyed.size());
  for (std::size_t t = 0; t < keyed.size(); ++t) {
    std::uint32_t key = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      float sum = 0;
      for (const std::uint32_t v : mesh.triangles[t]) sum += mesh.vertices[v][i] - low[i];
      key |= spread(std::min(static_cast<std::uint32_t>(sum * scale), 1023U)) << i;
    }
    keyed[t] = {key, static_cast<std::uint32_t>(t)};
  }
  for (unsigned shift = 0; shift < 30; shift += 10) {
    std::array<std::size_t, 1025> start{};
    for (const Keyed& k : keyed) ++start[(k.key >> shift & 1023U) + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    for (const Keyed& k : keyed) other[start[k.key >> shift & 1023U]++] = k;
    keyed.swap(other);
  }
  std::vector<std::uint32_t> order(keyed.size());
  std::ranges::transform(keyed, order.begin(), [](const Keyed& k) { return k.triangle; });
  return order;
}

}  // namespace forceshade::fast
