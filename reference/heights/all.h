// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every kind of height map, as the exact side has it: what reference/heights/kind.h lists.

// clang-format off
#define FORCESHADE_HEIGHT_KIND(kind) <reference/heights/kind.h>
// clang-format on
#include "rendering/height_kinds.inc"
#undef FORCESHADE_HEIGHT_KIND

namespace forceshade::reference {

inline const height::Grid& as_shape(const std::shared_ptr<const height::Grid>& grid) {
  return *grid;
}
template <class T>
const T& as_shape(const T& shape) {
  return shape;
}

// The formula of the variant's alternative.
template <class T>
inline constexpr Formula kFormula = formula<typename height::KindOf<T>::type>();

}  // namespace forceshade::reference
