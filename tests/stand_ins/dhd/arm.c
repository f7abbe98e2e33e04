// SPDX-License-Identifier: BSD-3-Clause
// The device's arm in a simulated hand, in m, N and s: a mass that the hand draws along its stroke. The axes are the vendor's:
// x towards the operator, y to the operator's right, z up.

#include <math.h>

#include "stand_in.h"

static const double kMass = 0.3;                                           // kg: a hand's 0.21 and the arm
static const double kSpring = 300, kDamping = 8;                           // N/m, N·s/m: towards where the hand means to be
static const double kHeight = 0.010, kDepth = 0.003;                       // m above and below the middle
static const double kStroke = 0.020;                                       // m, to each side
static const double kPeriod = 1.6, kFall = 0.4, kRise = 1.2, kMove = 0.2;  // s: when the hand goes down and up, and how long
static const double kLongestStep = 0.0005;                                 // s

static double minimum_jerk(double u) {
  u = fmin(fmax(u, 0), 1);
  return u * u * u * (10 + u * (6 * u - 15));
}

static void meant(double time, double goal[3]) {
  const double t = fmod(time, kPeriod);
  const double down = minimum_jerk((t - kFall) / kMove) - minimum_jerk((t - kRise) / kMove);
  goal[0] = 0;
  goal[1] = kStroke * sin(3.14159265358979 * time);
  goal[2] = kHeight - (kHeight + kDepth) * down;
}

void arm_begin(struct arm* arm) {
  *arm = (struct arm){0};
  meant(0, arm->position);
}

void arm_advance(struct arm* arm, double seconds) {
  const int steps = (int)fmax(1, ceil(seconds / kLongestStep));
  const double h = seconds / steps;
  for (int step = 0; step < steps; ++step) {
    double goal[3];
    arm->time += h;
    meant(arm->time, goal);
    for (int i = 0; i < 3; ++i) {
      const double pull = kSpring * (goal[i] - arm->position[i]) - kDamping * arm->velocity[i] + arm->force[i];
      arm->velocity[i] += h * pull / kMass;
      arm->position[i] += h * arm->velocity[i];
    }
  }
}
