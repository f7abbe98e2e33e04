// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A part's shape as it is evaluated: a grid is measured, all else is what include/forceshade/height_map.h says.

#include <memory>
#include <variant>

#include "fast/heights/grid.h"
#include "forceshade/height_map.h"

namespace forceshade::fast {

template <class T>
struct Evaluated {
  using type = T;
};
template <>
struct Evaluated<std::shared_ptr<const height::Grid>> {
  using type = HeightGrid;
};
template <class... T>
struct Evaluated<std::variant<T...>> {
  using type = std::variant<typename Evaluated<T>::type...>;
};
using EvaluatedShape = Evaluated<height::Shape>::type;

}  // namespace forceshade::fast
