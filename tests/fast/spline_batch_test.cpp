// SPDX-License-Identifier: BSD-3-Clause
// A batch on a B-spline answers no lane whose force lies so near a tie that binary64 cannot decide its sides apart, none whose
// slopes are too small beside their errors, and nearly all others. The stiffness is chosen so that forces come as near to ties
// as that.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fast/heights/spline.h"
#include "fast/heights/spline_force.h"
#include "forceshade/fast.h"

namespace forceshade::fast {
namespace {

using N = BigFloatBall<32>;

HeightGrid rough_grid(std::mt19937& random) {
  std::uniform_real_distribution<float> height(-0.5F, 0.5F);
  height::Grid grid{16, 16, 0.3F, height::Edge::tile, height::Interpolant::cubic_spline, {}};
  for (int i = 0; i < 16 * 16; ++i) grid.values.push_back(height(random));
  return HeightGrid(std::make_shared<const height::Grid>(std::move(grid)));
}

// The exact components, enclosed.
std::array<N, 3> components(const HeightGrid& grid, const float* position, height::Mode mode, double K) {
  const auto [U, Ux, Uy, decided] = spline_jet<N>(grid, Place(position[0], position[1]));
  const N z = N::exactly(static_cast<double>(position[2]));
  N M = N::exactly(K) * (mode == height::Mode::force_shaded ? -z : U - z);
  if (mode != height::Mode::conservative) M = M / square_root(N::exactly(1) + (Ux * Ux + Uy * Uy));
  return {-(M * Ux), -(M * Uy), M};
}

// The number's distance from the tie nearest to it, relative to it.
double distance_from_tie(const N& value) {
  const double head = approximately(value);
  const auto near = static_cast<float>(head);
  double least = 1;
  for (const float beyond : {std::nextafter(near, HUGE_VALF), std::nextafter(near, -HUGE_VALF)}) {
    const double tie = 0.5 * (static_cast<double>(near) + static_cast<double>(beyond));
    least = std::min(least, std::fabs(approximately(value - N::exactly(tie)) / head));
  }
  return least;
}

TEST(spline_batch, answers_no_lane_beside_a_tie_and_nearly_every_other) {
#if defined(__x86_64__)
  if (!is_available(InstructionSet::avx512)) GTEST_SKIP() << "no AVX-512 here";
  std::mt19937 random(9);
  const HeightGrid grid = rough_grid(random);
  std::uniform_real_distribution<float> place(-1.5F, 1.5F), depth(-3, -1), stiffness(0.5F, 1);
  int beside = 0, level = 0, apart = 0, apart_and_unknown = 0;
  for (int i = 0; i < 2500; ++i) {
    const auto mode = height::kModes[random() % 3].mode;
    const auto K = static_cast<double>(stiffness(random));
    const SplineMap map(grid, mode, K);
    float positions[3 * kSplineBatch], forces[3 * kSplineBatch];
    for (std::size_t lane = 0; lane < kSplineBatch; ++lane) {
      positions[3 * lane] = place(random);
      positions[3 * lane + 1] = place(random);
      positions[3 * lane + 2] = depth(random);
    }
    const unsigned known = kAvx512SplineFunctions.forces(map, positions, forces);
    for (std::size_t lane = 0; lane < kSplineBatch; ++lane) {
      double nearest = 1;
      for (const N& component : components(grid, positions + 3 * lane, mode, K))
        nearest = std::min(nearest, distance_from_tie(component));
      const bool is_known = (known >> lane & 1) != 0;
      const Jet<N> exact = spline_jet<N>(grid, Place(positions[3 * lane], positions[3 * lane + 1]));
      if (std::fabs(approximately(exact.Ux)) < 0.99 * map.sure.Ux || std::fabs(approximately(exact.Uy)) < 0.99 * map.sure.Uy) {
        ++level;
        EXPECT_FALSE(is_known) << "slopes too small beside their errors";
      }
      // The window is 2⁻³³ wide to each side, of which errors of binary64 take a little.
      if (nearest < 0x1.fp-34) {
        ++beside;
        EXPECT_FALSE(is_known) << "a force 2^" << std::log2(nearest) << " of itself from a tie";
      } else if (nearest > 0x1.2p-32) {
        ++apart;
        apart_and_unknown += !is_known;
      }
    }
  }
  std::printf("  %d beside a tie, %d level along an axis; %d apart from ties, of which %d are left to a later stage\n", beside,
              level, apart, apart_and_unknown);
  EXPECT_GT(beside, 80);
  EXPECT_GT(level, 5);
  EXPECT_LT(apart_and_unknown, apart / 50) << "small slopes, and nothing else";
#endif
}

}  // namespace
}  // namespace forceshade::fast
