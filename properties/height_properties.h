// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Continuity and passivity of height maps.

#include "properties/height_map_claims.h"
#include "properties/rendered.h"
#include "properties/work.h"

namespace forceshade::properties {

// Between a and b, valid and near each other, the force changes by no more than the map's height and gradient allow; across a
// kink, by the magnitude times the distance of the two directions.
Violation continuity(const RenderedHeightMap& rendered, const HeightMapClaims& claims, const Eigen::Vector3f& a,
                     const Eigen::Vector3f& b);

// The gradient that is felt, -F_x/F_z and -F_y/F_z, does not jump between a and b, both in contact, where nothing but a cell
// line of a grid may lie between them. A cubic spline's does not, a bilinear grid's does.
Violation gradient_across_cells(const RenderedHeightMap& rendered, const HeightMapClaims& claims, const Eigen::Vector3f& a,
                                const Eigen::Vector3f& b);

// Around a closed polygon the renderer gives no more energy than the exact law does plus its rounding; where the map is
// conservative, none but rounding and quadrature.
Violation passivity(const RenderedHeightMap& rendered, const HeightMapClaims& claims,
                    const std::vector<Eigen::Vector3f>& corners);

}  // namespace forceshade::properties
