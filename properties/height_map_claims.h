// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The claims of docs/height-maps.md about a height map beside its height: where it has kinks, how steep it is and how fast its
// gradient turns. Bounds and places in binary64, for properties and aim, not for decisions.

#include <string>
#include <vector>

#include "forceshade/reference.h"
#include "reference/heights/outline.h"

namespace forceshade::properties {

using GradientChange = reference::GradientChange;
using reference::Lines;
using reference::Rim;
using PartShape = reference::Outline;  // of one part of a map

struct HeightMapClaims {
  height::Mode mode;
  double stiffness;  // N/mm
  bool is_conservative;
  double steepest = 0;           // mm/mm: bounds the length of the gradient that the direction comes from
  double steepest_surface = 0;   // and of that of the surface which depth is measured from
  std::vector<PartShape> parts;  // of the map, then of a surface of its own
  std::size_t map_parts;

  explicit HeightMapClaims(const reference::HeightMapField& law);

  // The change of the gradient that the direction comes from.
  GradientChange gradient_change(double x, double y, double reach) const;

  // The places where the force jumps, in words; empty where it is continuous.
  std::vector<std::string> jumps() const;
};

}  // namespace forceshade::properties
