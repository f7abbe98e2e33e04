// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The domain and the quantum of positions, as the exact side applies them. fast/ states both again: rule 2, CONTRIBUTING.

#include <Eigen/Core>
#include <cmath>

namespace forceshade::reference {

inline constexpr float kDomainEnd = 1e4F;            // mm
inline constexpr float kPositionQuantum = 0x1p-30F;  // mm: a coordinate smaller in size is read as 0

// False for NaN.
inline bool in_domain(float coordinate) {
  return std::fabs(coordinate) <= kDomainEnd;
}
inline bool in_domain(const Eigen::Vector3f& position) {
  return in_domain(position.x()) && in_domain(position.y()) && in_domain(position.z());
}

// mm.
inline float quantised(float coordinate) {
  return std::fabs(coordinate) < kPositionQuantum ? 0.0F : coordinate;
}

}  // namespace forceshade::reference
