// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/insides.h"

#include <algorithm>
#include <optional>

#include "rendering/meshes/whole_vectors.h"

namespace forceshade::mesh {
namespace {

using Corners = std::array<WholeVector, 3>;

Corners corners_of(const TrianglePoints& t) {
  const Vertex origin{};
  return {side(origin, t[0]), side(origin, t[1]), side(origin, t[2])};
}

WholeVector normal_of(const Corners& t) {
  return cross(difference(t[1], t[0]), difference(t[2], t[0]));
}

// True if a side of s has t on its outer side, in one plane.
bool is_beside(const Corners& s, const Corners& t) {
  const WholeVector n = normal_of(s);
  for (std::size_t i = 0; i < 3; ++i) {
    const WholeVector along = difference(s[(i + 1) % 3], s[i]);
    if (std::ranges::all_of(t, [&](const WholeVector& x) { return dot(cross(along, difference(x, s[i])), n) <= 0; }))
      return true;
  }
  return false;
}

// The ends, along a direction, of what the inside of s has in a plane, where corners have these heights over it; nothing where
// the corners are not on both sides of it.
std::optional<std::array<WholeFraction, 2>> cut(const Corners& s, const std::array<Whole, 3>& heights,
                                                const WholeVector& along) {
  const auto [low, high] = std::minmax({heights[0], heights[1], heights[2]});
  if (low >= 0 || high <= 0) return {};
  std::array<WholeFraction, 2> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (heights[i] == 0) ends[count++] = {dot(s[i], along), 1};
    if (heights[i] * heights[next] >= 0) continue;
    const Whole drop = heights[i] - heights[next], over = dot(s[next], along) * heights[i] - dot(s[i], along) * heights[next];
    ends[count++] = drop > 0 ? WholeFraction{over, drop} : WholeFraction{-over, -drop};
  }
  if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
  return ends;
}

}  // namespace

bool insides_meet(const TrianglePoints& of_s, const TrianglePoints& of_t) {
  const Corners s = corners_of(of_s), t = corners_of(of_t);
  const WholeVector n_s = normal_of(s), n_t = normal_of(t), along = cross(n_s, n_t);
  const auto heights = [](const Corners& corners, const WholeVector& n, const WholeVector& origin) {
    const auto height = [&](std::size_t i) { return dot(n, difference(corners[i], origin)); };
    return std::array{height(0), height(1), height(2)};
  };
  const std::array<Whole, 3> of_s_corners = heights(s, n_t, t[0]);
  if (std::ranges::all_of(along, [](const Whole& component) { return component == 0; }))
    return of_s_corners[0] == 0 && !is_beside(s, t) && !is_beside(t, s);
  const auto in_s = cut(s, of_s_corners, along), in_t = cut(t, heights(t, n_s, s[0]), along);
  return in_s && in_t && (*in_s)[0] < (*in_t)[1] && (*in_t)[0] < (*in_s)[1];
}

}  // namespace forceshade::mesh
