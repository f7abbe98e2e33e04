// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/doubtful_normals.h"

#include <array>
#include <stdexcept>

#include "rendering/meshes/interval.h"
#include "rendering/meshes/whole_vectors.h"

namespace forceshade::mesh {
namespace {

// The numbers from which an angle and a unit normal are computed, in units of 2^-106 mm^2 and of their squares.
struct WholeCorner {
  WholeVector normal;        // u x v, with the sides u and v
  Whole normal_square;       // > 0
  Whole dot;                 // u . v
  Whole product_of_squares;  // u^2 v^2
};

WholeCorner corner_of(const TrianglePoints& t) {
  const WholeVector u = side(t[0], t[1]), v = side(t[0], t[2]), n = cross(u, v);
  return {n, dot(n, n), dot(u, v), dot(u, u) * dot(v, v)};
}

// Half of the angle: the weights need only be in proportion to the angles. tan(x/2) = sin x/(1 + cos x) = (1 - cos x)/sin x,
// times |u| |v| above and below; the one of them in which nothing cancels.
Interval weight_of(const WholeCorner& corner, const Interval& length) {
  const int bits = length.bits();
  const Interval dot(bits, corner.dot), product = sqrt(Interval(bits, corner.product_of_squares));
  return atan(corner.dot >= 0 ? length / (product + dot) : (product - dot) / length);
}

std::array<Interval, 3> sum_in_intervals(const std::vector<WholeCorner>& corners, int bits) {
  const Interval zero(bits);
  std::array<Interval, 3> sum{zero, zero, zero};
  for (const WholeCorner& corner : corners) {
    const Interval length = sqrt(Interval(bits, corner.normal_square));
    const Interval factor = weight_of(corner, length) / length;
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + factor * Interval(bits, corner.normal[i]);
  }
  return sum;
}

// No component is known to lie midway between two binary32 numbers, or as near to it as the last of these does not resolve. A
// sum that it does not separate from 0 is taken for 0. The first resolves a component that is 0, whose enclosure must be
// narrower than 2^-150, where the sum does not nearly cancel.
constexpr int kFirstBits = 192, kLastBits = kFirstBits << 6;

}  // namespace

Normal normal_in_intervals(const std::vector<TrianglePoints>& triangles) {
  std::vector<WholeCorner> corners;
  for (const TrianglePoints& t : triangles) corners.push_back(corner_of(t));
  bool has_length = false;
  for (int bits = kFirstBits; bits <= kLastBits; bits *= 2) {
    const std::array<Interval, 3> sum = sum_in_intervals(corners, bits);
    const Interval square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
    if (square.has_zero()) continue;
    has_length = true;
    const Interval length = sqrt(square);
    Normal normal{};
    bool is_decided = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval exact = sum[i] / length;
      normal[i] = exact.nearest_to_low();
      is_decided &= normal[i] == exact.nearest_to_high();
      if (normal[i] == 0) normal[i] = 0;
    }
    if (is_decided) return normal;
  }
  if (!has_length) return {0, 0, 0};
  throw std::logic_error("a normal's component lies midway between two binary32 numbers");
}

}  // namespace forceshade::mesh
