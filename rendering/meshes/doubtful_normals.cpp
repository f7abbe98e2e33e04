// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/doubtful_normals.h"

#include <array>
#include <stdexcept>

#include "rendering/meshes/interval.h"

namespace forceshade::mesh {
namespace {

std::array<Interval, 3> sum_in_intervals(const std::vector<TrianglePoints>& triangles, mpfr_prec_t bits) {
  const Interval zero(bits);
  std::array<Interval, 3> sum{zero, zero, zero};
  for (const TrianglePoints& t : triangles) {
    const auto side = [&](const Vertex& end, std::size_t i) {
      return Interval(bits, static_cast<double>(end[i])) - Interval(bits, static_cast<double>(t[0][i]));
    };
    const std::array<Interval, 3> u{side(t[1], 0), side(t[1], 1), side(t[1], 2)},
        v{side(t[2], 0), side(t[2], 1), side(t[2], 2)};
    const std::array<Interval, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const auto dot = [](const std::array<Interval, 3>& a, const std::array<Interval, 3>& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const Interval length = sqrt(dot(n, n));
    // tan(x/2) = sin x/(1 + cos x), times |u| |v|. Half of the angle serves as well as the whole.
    const Interval weight = atan(length / (sqrt(dot(u, u) * dot(v, v)) + dot(u, v)));
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + weight * n[i] / length;
  }
  return sum;
}

// No component is known to lie midway between two binary32 numbers, or as near to it as the last of these does not resolve. A
// sum that it does not separate from 0 is taken for 0.
constexpr mpfr_prec_t kFirstBits = 320, kLastBits = 1 << 14;

}  // namespace

Normal normal_in_intervals(const std::vector<TrianglePoints>& triangles) {
  for (mpfr_prec_t bits = kFirstBits; bits <= kLastBits; bits *= 2) {
    const std::array<Interval, 3> sum = sum_in_intervals(triangles, bits);
    const Interval length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    if (length.has_zero()) {
      if (bits == kLastBits) return {0, 0, 0};
      continue;
    }
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
  throw std::logic_error("a normal's component lies midway between two binary32 numbers");
}

}  // namespace forceshade::mesh
