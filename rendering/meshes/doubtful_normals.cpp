// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/doubtful_normals.h"

#include <stdexcept>

#include "rendering/meshes/bounded_number.h"
#include "rendering/meshes/interval.h"
#include "rendering/vectors.h"

namespace forceshade::mesh {
namespace {

bool is_obtuse(const BoundedNumber& dot) {
  return dot.value < 0;
}
bool is_obtuse(const Interval& dot) {
  return dot.centre() < 0;
}

// The weights are halves of the angles, since they need only be in proportion to them. With the sides u and v of a triangle and
// the length L of u x v, tan(x/2) = L/(|u| |v| + u.v) = (|u| |v| - u.v)/L: the one of them in which nothing cancels.
// zero: of the numbers that it is computed in; exact(number) is a binary32 number as one of them.
template <class N, class Exact>
std::array<N, 3> weighted_sum(const std::vector<TrianglePoints>& triangles, const N& zero, const Exact& exact) {
  std::array<N, 3> sum{zero, zero, zero};
  for (const TrianglePoints& t : triangles) {
    const auto u = side_of_triangle(t, 1, exact), v = side_of_triangle(t, 2, exact), n = cross(u, v);
    const N length = sqrt(dot(n, n)), along = dot(u, v), product = sqrt(dot(u, u) * dot(v, v));
    const N factor = atan(is_obtuse(along) ? (product - along) / length : length / (product + along)) / length;
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + factor * n[i];
  }
  return sum;
}

// The components whose ends round to the same number.
template <class N>
std::array<std::optional<float>, 3> decided(const std::array<N, 3>& sum, const N& length) {
  std::array<std::optional<float>, 3> normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const N exact = sum[i] / length;
    const float low = exact.nearest_to_low();
    if (low == exact.nearest_to_high()) normal[i] = low == 0 ? 0.0F : low;
  }
  return normal;
}

// No component is known to lie midway between two binary32 numbers, or as near to it as the last of these does not resolve. A
// sum that it does not separate from 0 is taken for 0. The first resolves a component that is 0, whose enclosure must be
// narrower than 2^-150, where the sum does not nearly cancel.
constexpr int kFirstBits = 192, kLastBits = kFirstBits << 6;

}  // namespace

std::array<std::optional<float>, 3> normal_in_binary64(const std::vector<TrianglePoints>& triangles) {
  const auto sum = weighted_sum(triangles, BoundedNumber{}, &in_binary64);
  return decided(sum, sqrt(dot(sum, sum)));
}

Normal normal_in_intervals(const std::vector<TrianglePoints>& triangles) {
  bool has_length = false;
  for (int bits = kFirstBits; bits <= kLastBits; bits *= 2) {
    const auto exact = [bits](float number) { return Interval(bits, static_cast<double>(number)); };
    const auto sum = weighted_sum(triangles, Interval(bits), exact);
    const Interval square = dot(sum, sum);
    if (square.has_zero()) continue;
    has_length = true;
    const auto [x, y, z] = decided(sum, sqrt(square));
    if (x && y && z) return {*x, *y, *z};
  }
  if (!has_length) return {0, 0, 0};
  throw std::logic_error("a normal's component lies midway between two binary32 numbers");
}

}  // namespace forceshade::mesh
