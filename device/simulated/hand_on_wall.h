// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hand on a virtual wall under the servo loop, supervisor and passivity controller included, in simulated time.

#include "device/simulated/model.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

struct HandOnWall {
  Model model = premium_1_5();
  double rate = 1000;      // Hz, of the loop
  float stiffness = 0.5F;  // N/mm
  Passivity passivity = Passivity::damping;
  bool presses = false;  // it rests, meaning to be 6 mm below the surface; else it makes strokes 3 mm below it
  double seconds = 6;
};

// The result. The hand comes down within 1.5 s; it means to stay at its depth from then on.
struct FeltOnWall {
  double energy = 0;  // mJ: the most that the hand and the arm were given, less what was taken from them, at any time
  double swing = 0;   // mm: the farthest that the tip moved along the wall's normal within a tenth of a second, from 1.5 s on
  ServoResult run;
};

FeltOnWall felt_on(const HandOnWall& wall);

}  // namespace forceshade::device
