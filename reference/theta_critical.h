// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Counts the polygons that a bump needs, by the thesis's theta-critical hypothesis (5.2): shading makes a flat polygon feel
// round as long as the part of the cylinder that it stands for subtends less than some angle.

#include <string>
#include <utility>

#include "forceshade/law.h"

namespace forceshade::reference {

// The angle that each of `polygons` >= 1 equal parts of the exposed cylinder subtends, 2 arcsin(w/2R) over their number: in
// degrees, correctly rounded to `digits`. Figure 5-5 of the thesis has it for one, two and three.
std::string subtended_degrees(const Parameters& bump, unsigned polygons, unsigned digits);

// An angle that is a rational number of degrees or of radians, exactly.
struct RationalAngle {
  RationalAngle(double degrees);  // NOLINT(google-explicit-constructor): every binary64 number is rational
  // "3/10"
  RationalAngle(std::string number_, bool is_radians_) : number(std::move(number_)), is_radians(is_radians_) {}

  std::string number;
  bool is_radians = false;
};

// The fewest equal parts of which each subtends less than `theta_critical`, from kLeastThetaCritical to 180 degrees. Decided
// exactly.
inline constexpr double kLeastThetaCritical = 1e-6;
unsigned polygons_needed(const Parameters& bump, const RationalAngle& theta_critical);

}  // namespace forceshade::reference
