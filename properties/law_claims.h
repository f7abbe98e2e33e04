// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The claims of docs/laws.md about each law beside its force: nominal surface, jumps and their sizes, and whether it is
// conservative. Sizes in long double, good to about 17 digits; for properties and aim, not for decisions.

#include <string>
#include <vector>

#include "forceshade/reference.h"

namespace forceshade::properties {

// A vertical line on which the force may jump by 2·K·(height - z)⁺·sin(angle/2), angle being that between the directions.
struct JumpLine {
  long double x;       // mm, > 0 or 0; its mirror image jumps likewise
  long double height;  // mm: nominal height on the line
  long double angle;   // rad
};

struct LawClaims {
  LawId id;
  long double R, w, K, d;    // mm, mm, N/mm, mm; R = w = 0 for the wall
  long double alpha, theta;  // rad: half the subtended angle; the slope of a three-polygon side
  long double h, w_prime, h_prime;
  std::vector<JumpLine> jump_lines;
  bool is_conservative;  // the law has a potential (docs/energy.md)
  long double steepest;  // largest |dH/dx| of the nominal surface where H is polygonal, else 0

  explicit LawClaims(const reference::Law& law);

  // H(x), mm: where the force begins on the way down at x. NaN is never returned; beside the bump it is 0.
  long double surface(long double x) const;

  bool is_shaded() const;
  bool has_cylinder() const { return id == LawId::cylinder || id == LawId::bump_cylinder; }

  // The places where the force jumps, in words; empty where it is continuous.
  std::vector<std::string> jumps() const;
};

}  // namespace forceshade::properties
