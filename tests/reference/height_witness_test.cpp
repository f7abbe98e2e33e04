// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "reference/height_energy.h"
#include "tests/height_maps/height_examples.h"

namespace forceshade::reference {
namespace {

using Along = Slice::Along;
using Eigen::Vector3d;
using Eigen::Vector3f;
using height::Mode;
using Path = std::vector<Vector3f>;

constexpr std::array kActive{Mode::true_height, Mode::force_shaded};
constexpr std::array kSlices{Slice{Along::x, 1.3F, -7, 6}, Slice{Along::y, 0.7F, -5, 6}};

HeightMapField build(const HeightMap& map, Mode mode, float K) {
  return std::get<HeightMapField>(HeightMapField::build(map, mode, K));
}

double along(const Slice& slice, const Vector3f& corner) {
  return static_cast<double>(slice.along == Along::x ? corner.x() : corner.y());
}

bool is_simple(const Slice& slice, const Path& path) {
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_2> corners;
  for (std::size_t i = 1; i < path.size(); ++i) corners.emplace_back(along(slice, path[i]), path[i].z());
  return CGAL::is_simple_2(corners.begin(), corners.end());
}

// Over the corners and some places between them, by the second program's heights.
double deepest(const HeightExample& example, Mode mode, const Path& path) {
  double most = -1e9;
  for (std::size_t i = 1; i < path.size(); ++i)
    for (int k = 0; k <= 8; ++k) {
      const Vector3d from = path[i - 1].cast<double>(), at = from + k / 8.0 * (path[i].cast<double>() - from);
      most = std::max(most, (mode == Mode::true_height ? example.U(at.x(), at.y()) : 0) - at.z());
    }
  return most;
}

TEST(height_witness, is_a_simple_loop_no_deeper_than_asked_that_generates_99_percent_of_the_bound) {
  double worst = 1;
  std::size_t longest = 0;
  for (const HeightExample& example : height_examples())
    for (const Mode mode : kActive)
      for (const Slice& slice : kSlices)
        for (const float depth : {0.05F, 0.5F, 20.0F}) {
          const std::string what =
              std::string(example.name) + ' ' + std::to_string(depth) + (slice.along == Along::x ? " x" : " y");
          const HeightMapField law = build(example.map, mode, 0.5F);
          ASSERT_FALSE(slice_error(law, slice, depth)) << what;
          const SliceBound bound = loop_bound(law, slice, depth);
          const Path loop = witness(law, slice, depth);
          if (bound.most().high == 0) {
            EXPECT_TRUE(loop.empty()) << what;
            continue;
          }
          ASSERT_GT(loop.size(), 4U) << what;
          EXPECT_EQ(loop.front(), loop.back()) << what;
          EXPECT_TRUE(is_simple(slice, loop)) << what;
          for (const Vector3f& corner : loop) {
            EXPECT_EQ(slice.along == Along::x ? corner.y() : corner.x(), slice.at) << what;
            EXPECT_TRUE(along(slice, corner) >= static_cast<double>(slice.from) &&
                        along(slice, corner) <= static_cast<double>(slice.to))
                << what;
          }
          EXPECT_LE(deepest(example, mode, loop), static_cast<double>(depth) + 1e-12) << what;
          const Interval generated = work(law, loop);
          EXPECT_LE(generated.low, bound.most().high) << what;
          EXPECT_GE(generated.low, 0.99 * bound.most().high) << what;
          longest = std::max(longest, loop.size());
          worst = std::min(worst, Multiprecision(generated.low / bound.most().high).convert_to<double>());
        }
  std::printf("  generates %.2f %% of the bound or more; at most %zu corners\n", 100 * worst, longest);
}

TEST(height_witness, goes_round_kinks_closer_than_a_binary32_step) {
  // Half a step between the rim, where the ridge is as good as upright, and the knot beyond it.
  const HeightMap map{
      {{height::CylinderCap{0, 0.5F, std::nextafter(1.0F, 0.0F)}}, {height::Polygons{{{-0.5F, 0}, {0, 0.25F}, {0.5F, 0}}}}}};
  const Slice slice{Along::x, 0.25F, -1, 1};
  const HeightMapField law = build(map, Mode::force_shaded, 1);
  const Path loop = witness(law, slice, 0.5F);
  EXPECT_TRUE(is_simple(slice, loop));
  EXPECT_GE(work(law, loop).low, 0.99 * loop_bound(law, slice, 0.5F).most().high);
}

TEST(height_witness, of_a_field_with_a_potential_is_none) {
  for (const HeightExample& example : height_examples())
    EXPECT_TRUE(witness(build(example.map, Mode::conservative, 1), {}, 2).empty());
}

}  // namespace
}  // namespace forceshade::reference
