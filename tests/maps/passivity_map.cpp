// SPDX-License-Identifier: BSD-3-Clause
// Prints how stiff a sampled wall may be over Coulomb friction and damping, simulated and in theory: the CSV of
// tests/maps/passivity_map.sh.

#include <cmath>
#include <cstdio>

#include "tests/device/sampled_wall.h"

int main() {
  using namespace forceshade::device;
  constexpr int kPoints = 16;
  const auto spaced = [](double low, double high, int i) { return low * std::pow(high / low, i / (kPoints - 1.0)); };
  std::printf("coulomb_N,damping_N_s_per_m,simulated_N_per_mm,passive_N_per_mm\n");
  for (int row = 0; row < kPoints; ++row)
    for (int column = 0; column < kPoints; ++column) {
      const SampledWall wall{.damping = spaced(0.05, 2, row), .coulomb = spaced(0.0015, 0.06, column)};
      std::printf("%.5g,%.5g,%.5g,%.5g\n", wall.coulomb, wall.damping, largest_quiet_stiffness(wall) / 1e3,
                  passive_stiffness(wall) / 1e3);
    }
}
