/* SPDX-License-Identifier: BSD-3-Clause */
/* What a force costs where this runs: for each law, ns for one of 1000 forces that are computed together, by the fastest of five times
 * 2000 such calls, since a clock may count milliseconds. Half of the positions are in contact. Prints "LAW NANOSECONDS". */
#include <stdio.h>
#include <time.h>

#include "forceshade.h"

enum { kCount = 1000, kCalls = 2000, kTimes = 5 };

int main(void) {
  static const char* const laws[] = {"wall",    "cylinder",       "bump-cylinder",  "bump-1p",       "bump-2p",
                                     "bump-3p", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"};
  static float positions[3 * kCount], forces[3 * kCount];
  uint32_t state = 1;
  for (int i = 0; i < kCount; ++i) {
    float random[2];
    for (int k = 0; k < 2; ++k) {
      state = state * 1664525u + 1013904223u;
      random[k] = (float)(state >> 8) * 0x1p-24f;
    }
    positions[3 * i] = 30 * random[0] - 15;
    positions[3 * i + 2] = 4 * random[1] - 2;
  }
  const forceshade_law parameters = {sizeof parameters, 15.24f, 25.4f, 0.5f};
  const forceshade_batch batch = {sizeof batch, kCount, positions, 12, 4, forces, 12, 4, NULL, 0, 1};
  for (size_t i = 0; i < sizeof laws / sizeof *laws; ++i) {
    forceshade_subject law;
    if (forceshade_law_new(laws[i], &parameters, &law) != FORCESHADE_OK) return 1;
    double least = 1e9;
    for (int k = 0; k < kTimes; ++k) {
      const clock_t begin = clock();
      for (int call = 0; call < kCalls; ++call)
        if (forceshade_forces(law, &batch, NULL) != FORCESHADE_OK) return 1;
      const double taken = 1e9 / CLOCKS_PER_SEC * (double)(clock() - begin) / kCount / kCalls;
      if (taken < least) least = taken;
    }
    printf("%s %.1f\n", laws[i], least);
  }
  return 0;
}
