// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Vectors of numbers of any kind.

#include <array>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

template <class N>
std::array<N, 3> difference(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class N>
std::array<N, 3> cross(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class N>
N dot(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// From the first corner to another; exact(number) is a binary32 number as one of that kind.
template <class Exact>
auto side_of_triangle(const std::array<Vertex, 3>& t, std::size_t end, const Exact& exact) {
  const auto step = [&](std::size_t i) { return exact(t[end][i]) - exact(t[0][i]); };
  return std::array{step(0), step(1), step(2)};
}

}  // namespace forceshade::mesh
