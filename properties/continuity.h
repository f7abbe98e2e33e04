// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Continuity: the force jumps nowhere but on the law's listed lines, and there by exactly the listed amount.

#include "properties/law_claims.h"
#include "properties/rendered.h"

namespace forceshade::properties {

// The change that the law allows between two positions: a jump of known size, and how far rounding and slope may carry from it.
struct AllowedChange {
  long double jump;   // N: |F(a) - F(b)| is this
  long double reach;  // N: give or take this
  bool is_known;      // false where two lines lie between the positions and no single size is listed
};

AllowedChange allowed_change(const reference::Law& law, const LawClaims& claims, const Eigen::Vector3f& a,
                             const Eigen::Vector3f& b);

// a and b valid and near each other; neighbours in binary32 make the sharpest test.
Violation continuity(const RenderedLaw& rendered, const LawClaims& claims, const Eigen::Vector3f& a, const Eigen::Vector3f& b);

}  // namespace forceshade::properties
