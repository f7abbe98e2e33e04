// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Work that a renderer's force does along a path, beside the exact law's on the same points and a bound of the rounding.

#include <utility>
#include <vector>

#include "properties/law_claims.h"
#include "properties/rendered.h"

namespace forceshade::properties {

struct PathPoint {
  double x, z;  // mm
};

struct Work {
  double rendered = 0;  // mJ given to the hand by the renderer
  double exact = 0;     // mJ by the exact law at the same binary32 positions, with the same weights
  double rounding = 0;  // mJ: how far the two may differ when every force component is off by half a unit in its last place
  double placing = 0;   // mJ: what rounding the positions themselves to binary32 may have done to either
  double turnover = 0;  // mJ: the sum of the sizes of all that was added up in `rendered`

  // mJ: a bound of what adding up in binary64 loses of these sums: 2^-53 of all sizes for each of less than 2^16 additions,
  // twice that for the terms' own roundings. The sizes that `exact` is made of add up to `turnover` and `rounding` at most.
  double summing() const { return 0x1p-36 * (turnover + rounding); }

  // One point of a quadrature: the force there, along the step that it stands for, mm.
  void add(const Eigen::Vector3f& force, const Eigen::Matrix<long double, 3, 1>& exact_force, const Eigen::Vector3d& step);
};

// Along the closed polygon through `vertices`. Each edge is cut where the force has a kink or a jump and each piece is
// integrated by 15-point Gauss-Legendre, so on a conservative law `exact` is zero but for `placing`.
Work work_around(const RenderedLaw& rendered, const LawClaims& claims, const std::vector<PathPoint>& vertices);

}  // namespace forceshade::properties
