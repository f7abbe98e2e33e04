// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any part of a height map at a point, and their sum. Callers hold exact_arithmetic.

#include <stdexcept>
#include <type_traits>
#include <vector>

#include "reference/heights/all.h"
#include "reference/numbers/exponential_sum.h"

namespace forceshade::reference {

template <class N>
Jet<N> part_jet(const height::Part& part, const Point2& at) {
  const Jet<N> one = std::visit(
      [&]<class T>(const T& shape) -> Jet<N> {
        if constexpr (kFormula<T> == Formula::transcendental && std::is_same_v<N, Ball64>)
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
