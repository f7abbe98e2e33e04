// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ways through triangles, exactly, and turns of a closed surface around a point.

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <span>

#include "rendering/meshes/predicates.h"

namespace forceshade::tests {

// 1 where the segment goes through the inside of the triangle from behind, -1 from in front, 0 where it does not; nothing where
// it meets its border or its plane's ends.
inline std::optional<int> crossing(const mesh::TrianglePoints& t, const mesh::Vertex& from, const mesh::Vertex& to) {
  const int begin = mesh::side_of(t[0], t[1], t[2], from), end = mesh::side_of(t[0], t[1], t[2], to);
  if (begin == end) return begin == 0 ? std::nullopt : std::optional(0);
  std::array<int, 3> turns{};
  for (std::size_t i = 0; i < 3; ++i) turns[i] = mesh::side_of(from, to, t[i], t[(i + 1) % 3]);
  const auto [least, most] = std::ranges::minmax(turns);
  if (least < 0 && most > 0) return 0;
  if (least == 0 || most == 0 || begin == 0 || end == 0) return std::nullopt;
  return end > begin ? 1 : -1;
}

// Counts the turns of triangles with an area around the point; nothing where it is on one.
inline std::optional<int> winding(std::span<const mesh::TrianglePoints> triangles, const mesh::Vertex& x,
                                  std::mt19937_64& random) {
  for (int tries = 0; tries < 20; ++tries) {
    mesh::Vertex far{};
    for (float& coordinate : far) coordinate = static_cast<float>(std::uniform_real_distribution(-9000.0, 9000.0)(random));
    if (std::ranges::none_of(far, [](float coordinate) { return std::fabs(coordinate) > 5000; })) continue;
    int total = 0;
    bool is_decided = true;
    for (const mesh::TrianglePoints& triangle : triangles) {
      const auto crosses = crossing(triangle, x, far);
      is_decided = is_decided && crosses.has_value();
      if (!is_decided) break;
      total += *crosses;
    }
    if (is_decided) return total;
  }
  return std::nullopt;
}

// The straight way goes through a triangle from a side that blocks.
inline bool passes(std::span<const mesh::TrianglePoints> triangles, mesh::Sides sides, const mesh::Vertex& from,
                   const mesh::Vertex& to) {
  return std::ranges::any_of(triangles, [&](const mesh::TrianglePoints& triangle) {
    const int crosses = crossing(triangle, from, to).value_or(0);
    return crosses == -1 || (crosses == 1 && sides == mesh::Sides::both);
  });
}

}  // namespace forceshade::tests
