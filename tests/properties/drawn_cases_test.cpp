// SPDX-License-Identifier: BSD-3-Clause
// The draws have every kind of case: a property that holds says nothing of cases that never come.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "properties/generators.h"
#include "properties/height_map_subject.h"
#include "properties/height_positions.h"
#include "properties/law_subject.h"
#include "properties/mesh_path.h"
#include "properties/spread.h"

namespace forceshade::properties {
namespace {

bool has_few_bits(float number) {
  int exponent = 0;
  const float scaled = std::ldexp(std::frexp(number, &exponent), 6);
  return scaled == std::round(scaled);
}

// Every end of the domain, with numbers of few bits and of many.
TEST(drawn_cases, parameters_reach_every_end_of_the_domain) {
  std::map<std::string, std::set<bool>> few_bits_with;
  ParameterSource source(3);
  for (int i = 0; i < 20000; ++i) {
    const Parameters p = source.next();
    const bool few = has_few_bits(p.radius) && has_few_bits(p.stiffness);
    if (p.radius == 0.1F) few_bits_with["smallest radius"].insert(has_few_bits(p.stiffness));
    if (p.radius == 1e4F) few_bits_with["largest radius"].insert(has_few_bits(p.stiffness));
    if (p.stiffness == 1e-3F) few_bits_with["smallest stiffness"].insert(has_few_bits(p.radius));
    if (p.stiffness == 1e3F) few_bits_with["largest stiffness"].insert(has_few_bits(p.radius));
    if (p.width == 1e-3F) few_bits_with["smallest width"].insert(few);
    if (p.width == 2 * p.radius) few_bits_with["largest width"].insert(few);
  }
  EXPECT_EQ(few_bits_with.size(), 6U);
  for (const auto& [end, kinds] : few_bits_with) EXPECT_EQ(kinds.size(), 2U) << end;
}

TEST(drawn_cases, positions_lie_all_around_the_rim_of_a_part) {
  const HeightMap map{{{height::SphereCap{1, -2, 5, 8}}}};
  const auto subject = std::get<RenderedHeightMap>(fast_rendering(map, height::Mode::true_height, 0.5F));
  const HeightMapClaims claims(subject.law);
  HeightPositionSource source(subject.law, claims, 3);
  std::array<int, 4> quarters{};
  for (int i = 0; i < 4000; ++i) {
    const auto [x, y] = source.on_a_line();
    const double across = static_cast<double>(x) - 1, up = static_cast<double>(y) + 2;
    if (std::fabs(std::hypot(across, up) - 4) < 1e-4) ++quarters[(across < 0 ? 1U : 0U) + (up < 0 ? 2U : 0U)];
  }
  for (const int count : quarters) EXPECT_GT(count, 200);
}

// Both sides of the axis are the same distance from it, on opposite sides.
TEST(drawn_cases, pairs_across_the_axis_are_mirror_images_in_it) {
  const reference::Law law = std::get<RenderedLaw>(fast_rendering(LawId::bump_cylinder, {15.24F, 25.4F, 0.5F})).law;
  const LawClaims claims(law);
  int across = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const NearbyPair pair = pair_of(law).draw(seed);
    if (!pair.across_axis) continue;
    ++across;
    const Eigen::Vector3f b = pair.b(claims);
    const double d = static_cast<double>(claims.d), above = static_cast<double>(pair.a.z()) + d;
    EXPECT_EQ(b.x(), -pair.a.x());
    EXPECT_EQ(b.y(), pair.a.y());
    EXPECT_NEAR(static_cast<double>(b.z()) + d, -above, 1e-6 * (d + std::fabs(above)));
  }
  EXPECT_GT(across, 150);
}

// The first number beyond the domain is among the positions that are not valid, in each coordinate.
TEST(drawn_cases, paths_on_a_mesh_leave_the_domain_by_one_step) {
  const mesh::TriangleMesh triangle{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
  const float beyond = std::nextafter(1e4F, INFINITY);
  std::array<int, 3> first{}, no_number{}, infinite{};
  MeshPath path(triangle, 3);
  for (int i = 0; i < 200000; ++i) {
    const std::array<float, 3> position = path.next();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float coordinate = position[axis];
      EXPECT_EQ(path.kind() == PathKind::invalid || std::fabs(coordinate) <= 1e4F, true) << coordinate;
      first[axis] += coordinate == beyond;
      no_number[axis] += std::isnan(coordinate);
      infinite[axis] += std::isinf(coordinate);
    }
  }
  for (const auto& counts : {first, no_number, infinite})
    for (const int count : counts) EXPECT_GT(count, 0);
}

// Another stiffness is drawn, rendered, and named.
TEST(drawn_cases, a_height_map_is_spread_over_stiffnesses) {
  const HeightMap map{{{height::Plane{0, 0, 0}}}};
  const HeightMapSubject subject("plane", map, height::Mode::true_height, 0.5F);
  std::set<float> forces;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const DrawnSubject drawn = subject.with_drawn_parameters(seed);
    const float force = drawn.subject->renderer().open()->step({0, 0, -1}).force.z();
    forces.insert(force);
    EXPECT_EQ(force, ParameterSource(seed).next().stiffness) << "1 mm below a plane";
    EXPECT_EQ(force, drawn.subject->open_reference()->step({0, 0, -1}).force.z());
  }
  EXPECT_EQ(forces.size(), 20U);
}

}  // namespace
}  // namespace forceshade::properties
