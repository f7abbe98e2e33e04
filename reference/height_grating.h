// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// grating: U = height·cos(wave_x·x + wave_y·y + phase). Enclosures alone: where the angle is not 0 its height is
// transcendental.

#include "forceshade/reference/height_jet.h"

namespace forceshade::reference {

inline Jet<Enclosure> jet(const height::Grating& grating, const Point2& at) {
  const Enclosure height(grating.height), wave_x(grating.wave_x), wave_y(grating.wave_y);
  const Enclosure angle = wave_x * at.x + wave_y * at.y + Enclosure(grating.phase);
  const Enclosure steepness = -height * sin(angle);
  return {height * cos(angle), wave_x * steepness, wave_y * steepness};
}

}  // namespace forceshade::reference
