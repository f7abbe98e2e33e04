// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any part of a height map at a point, and their sum. Callers hold exact_arithmetic.

#include <stdexcept>
#include <type_traits>
#include <vector>

#include "forceshade/reference/heights/cap.h"
#include "forceshade/reference/heights/cone.h"
#include "forceshade/reference/heights/gaussian.h"
#include "forceshade/reference/heights/grating.h"
#include "forceshade/reference/heights/grid.h"
#include "forceshade/reference/heights/plane.h"
#include "forceshade/reference/heights/polygons.h"
#include "forceshade/reference/numbers/exponential_sum.h"

namespace forceshade::reference {

template <class T>
inline constexpr bool kIsTranscendental = std::is_same_v<T, height::Gaussian> || std::is_same_v<T, height::Grating>;

inline const height::Grid& as_shape(const std::shared_ptr<const height::Grid>& grid) {
  return *grid;
}
template <class T>
const T& as_shape(const T& shape) {
  return shape;
}

template <class N>
Jet<N> part_jet(const height::Part& part, const Point2& at) {
  const Jet<N> one = std::visit(
      [&]<class T>(const T& shape) -> Jet<N> {
        if constexpr (kIsTranscendental<T> && std::is_same_v<N, Ball64>)
          throw std::logic_error("a transcendental height in an algebraic number");
        else
          return jet<N>(as_shape(shape), at);
      },
      part.shape);
  return part.negated ? -one : one;
}

template <class N>
Jet<N> sum_jet(const std::vector<height::Part>& parts, const Point2& at) {
  Jet<N> all = Jet<N>::flat();
  for (const height::Part& part : parts) all = all + part_jet<N>(part, at);
  return all;
}

}  // namespace forceshade::reference
