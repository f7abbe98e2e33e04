// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "properties/law_claims.h"
#include "reference/energy.h"

namespace forceshade::reference {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};
constexpr std::array kActive{LawId::bump_2p, LawId::bump_3p, LawId::bump_1p_shaded, LawId::bump_2p_shaded,
                             LawId::bump_3p_shaded};

struct Case {
  Parameters p;
  float depth;
};

// The ends of the domain, bumps whose w' is a binary32, and every size between.
std::vector<Case> cases() {
  std::vector<Case> all{{kBump, 2},
                        {kBump, 9},
                        {{10, 20, 1}, 2},
                        {{10, 20, 1}, 30},
                        {{1, 1.375F, 1}, 0.5F},
                        {{0.1F, 0.2F, 1000}, 1e-5F},
                        {{0.1F, 0.2F, 1000}, 1e4F},
                        {{1e4F, 2e4F, 1}, 1},
                        {{1e4F, 2e4F, 1}, 1e4F},
                        {{1e4F, 0.001F, 0.001F}, 1},
                        {{1e4F, 0.001F, 0.001F}, 1e4F},
                        {{1e4F, std::nextafter(2e4F, 0.0F), 1}, 1}};
  std::mt19937 random(5);
  const auto spread = [&](double low, double high) {
    return static_cast<float>(low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random)));
  };
  for (int i = 0; i < 40; ++i) {
    const float R = spread(0.1, 1e4), w = std::min(2 * R, i % 2 == 0 ? spread(1e-3, 2.0 * R) : 2 * R * spread(0.1, 1.01));
    all.push_back(
        {{R, w, spread(1e-3, 1e3)}, std::max(R / 1e4F, std::min(1e4F, i % 4 < 2 ? spread(R / 1e4, 1e4) : R * spread(0.1, 1)))});
  }
  return all;
}

// The deepest a path is below the nominal surface: at a corner, or where the surface has one.
long double deepest(const Law& law, const std::vector<PathPoint>& path) {
  const properties::LawClaims claims(law);
  long double most = -1e9L;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const long double x0 = path[i - 1].x, z0 = path[i - 1].z, x1 = path[i].x, z1 = path[i].z;
    most = std::max(most, claims.surface(x1) - z1);
    for (const long double corner : {-claims.w / 2, -claims.w_prime / 2, 0.0L, claims.w_prime / 2, claims.w / 2})
      if ((x0 - corner) * (x1 - corner) < 0)
        most = std::max(most, claims.surface(corner) - (z0 + (z1 - z0) * (corner - x0) / (x1 - x0)));
  }
  return most;
}

bool is_simple(const std::vector<PathPoint>& path) {
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_2> corners;
  for (std::size_t i = 1; i < path.size(); ++i) corners.emplace_back(path[i].x, path[i].z);
  return CGAL::is_simple_2(corners.begin(), corners.end());
}

TEST(witness, is_a_simple_loop_no_deeper_than_asked_that_generates_99_percent_of_the_bound) {
  double worst = 1;
  std::size_t longest = 0;
  for (const LawId id : kActive)
    for (const auto& [p, depth] : cases()) {
      const Law law = std::get<Law>(Law::build(id, p));
      ASSERT_FALSE(depth_error(law, depth)) << depth;
      const LoopBound bound = loop_bound(law, depth);
      const std::vector<PathPoint> loop = witness(law, depth);
      const std::string what = std::string(name_of(id)) + ' ' + std::to_string(p.radius) + ' ' + std::to_string(p.width) + ' ' +
                               std::to_string(depth);
      if (bound.anywhere.high == 0) {
        EXPECT_TRUE(loop.empty()) << what;
        continue;
      }
      const Interval generated = work(law, loop);
      ASSERT_EQ(loop.front().x, loop.back().x) << what;
      ASSERT_EQ(loop.front().z, loop.back().z) << what;
      EXPECT_LE(generated.low, bound.anywhere.high) << what;
      EXPECT_GE(generated.low, 0.99 * bound.anywhere.high) << what;
      EXPECT_LE(deepest(law, loop), static_cast<long double>(depth)) << what;
      // The ridge of the largest bump is at the end of the domain, where the two sides of the loop touch.
      EXPECT_TRUE((id == LawId::bump_2p_shaded && p.width == 2e4F) || is_simple(loop)) << what;
      for (const PathPoint& corner : loop) {
        EXPECT_LE(std::max(std::fabs(corner.x), std::fabs(corner.z)), 1e4F) << what;
        for (const float x : {corner.x, corner.z}) EXPECT_FALSE(x == 0 && std::signbit(x)) << what << ": -0";
      }
      longest = std::max(longest, loop.size());
      worst = std::min(worst, Multiprecision(generated.low / bound.anywhere.high).convert_to<double>());
    }
  std::printf("  generates %.2f %% of the bound or more; at most %zu corners\n", 100 * worst, longest);
  EXPECT_LE(longest, 250U);
}

TEST(witness, of_a_conservative_law_is_none) {
  for (const LawId id : {LawId::wall, LawId::cylinder, LawId::bump_cylinder, LawId::bump_1p})
    EXPECT_TRUE(witness(std::get<Law>(Law::build(id, kBump)), 2).empty());
}

}  // namespace
}  // namespace forceshade::reference
