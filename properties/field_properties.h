// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Properties of a force that follows from the position alone: continuity, unit normals, passivity, equivalence.

#include <array>
#include <stdexcept>

#include "forceshade/checks.h"
#include "properties/law_claims.h"
#include "properties/rendered.h"
#include "properties/work.h"
#include "reference/height_energy.h"

namespace forceshade::properties {

// Continuity: the force jumps nowhere but on the law's listed lines, and there by exactly the listed amount.

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

// Unit normals: the force is its magnitude times a unit vector, to within the rounding of its components; x = 0 included.

// ‖F‖ must be K·penetration, up to half a unit in the last place of each component. For bump-cylinder, a sum of two
// objects, the wall's share is taken off first. Invalid positions hold trivially.
Violation unit_normals(const RenderedLaw& rendered, const Eigen::Vector3f& position);

// The same for a height map; for a conservative height map, whose normal is left as it is, ‖F‖ must be K·penetration·√(U_x² +
// U_y² + 1).
Violation unit_normals(const RenderedHeightMap& rendered, const Eigen::Vector3f& position);

// Passivity: around a closed path the renderer gives the hand no more energy than the exact law does plus its rounding, and
// nothing but rounding where the law is conservative.

Violation passivity(const RenderedLaw& rendered, const LawClaims& claims, const std::vector<PathPoint>& vertices);

// The loop that shows how much energy a law gives (docs/energy.md); for a conservative law one through the object, which gives
// none.
struct WitnessLoop {
  std::vector<PathPoint> vertices;  // in the order in which the hand is given energy
  std::array<double, 2> bound_mJ;   // an interval around the most that a simple loop this deep can give
  double given_mJ;                  // by the exact law, rounded down; 99 % of the bound or more
};

// depth: mm, as for reference::witness.
WitnessLoop witness_loop(const reference::Law& law, float depth);

// Demands that the renderer gives around the witness loop what the exact law gives, to within its own rounding and one part in
// 10^4, and that this reaches the bound.
Violation witness_is_reached(const RenderedLaw& rendered, const LawClaims& claims, float depth);

// The energy that loops over a height map can give to the hand, for its certificate.

// Over y = 0, 12.7 mm to both sides of x = 0 or as far as 250 cells of the finest grid go.
reference::Slice certified_slice(const HeightMap& map);

// At depths of 0.5 and 2 mm, as far as they are in the domain. Throws reference::NotEnclosed and Interrupted.
std::vector<LoopEnergy> loop_energies(const RenderedHeightMap& rendered, const Monitor& monitor = {});

// Equivalence: the renderer's force is the exact force rounded to binary32, bit for bit, and its status is right.

// Compares an answer already given with a rounding already done.
Violation difference(const Eigen::Vector3f& position, const Rendered& answer, const reference::Rounded& exact);

// The violation where the reference throws: an answer that is not known is not known to be right.
std::string not_decided(const Eigen::Vector3f& position, const std::domain_error& error);

template <class Reference>
Violation equivalence(const RenderedField<Reference>& rendered, const Eigen::Vector3f& position) {
  try {
    return difference(position, rendered.force_at(position), rendered.law.round_to_binary32(position));
  } catch (const std::domain_error& error) {
    return not_decided(position, error);
  }
}

}  // namespace forceshade::properties
