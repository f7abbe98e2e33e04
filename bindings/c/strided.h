// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arrays of numbers that lie at equal distances, counted in bytes.

#include <Eigen/Core>
#include <cstddef>

namespace forceshade::c {

// True if floats may lie at this distance.
constexpr bool is_stride(std::ptrdiff_t bytes) noexcept {
  return bytes % static_cast<std::ptrdiff_t>(alignof(float)) == 0;
}

// Element (i, j). T is a char type or float, const or not.
template <class T>
T* at(T* first, std::size_t i, std::ptrdiff_t stride, std::size_t j = 0, std::ptrdiff_t component = 0) noexcept {
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(i) * stride + static_cast<std::ptrdiff_t>(j) * component;
  return first + offset / static_cast<std::ptrdiff_t>(sizeof(T));
}

// Floats that lie one after the other, as vectors of three.
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float) && alignof(Eigen::Vector3f) == alignof(float));
inline const Eigen::Vector3f* as_vectors(const float* floats) noexcept {
  return reinterpret_cast<const Eigen::Vector3f*>(floats);
}
inline Eigen::Vector3f* as_vectors(float* floats) noexcept {
  return reinterpret_cast<Eigen::Vector3f*>(floats);
}

}  // namespace forceshade::c
