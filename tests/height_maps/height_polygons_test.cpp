// SPDX-License-Identifier: BSD-3-Clause
// Polygons as height maps, and force shading over them, beside the laws of the thesis that they generalise.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;
using height::Mode;

// Bumps whose numbers are all binary32: Pythagorean triples, and rational sin(arcsin(w/2R)/3) = 5/13 for the last.
struct Bump {
  float radius, width, height, top_width, top_height;  // of two polygons; of three, 0 where they are irrational
};
constexpr Bump kRationalBumps[] = {{5, 8, 2, 0, 0},
                                   {13, 10, 1, 0, 0},
                                   {13.0F / 8, 24.0F / 8, 1, 0, 0},
                                   {2197.0F / 256, 4070.0F / 256, 0, 1690.0F / 256, 1200.0F / 256}};

std::vector<height::Part> polygons(const Bump& b) {
  const float half = b.width / 2, top = b.top_width / 2;
  if (b.height != 0) return {{height::Polygons{{{-half, 0}, {0, b.height}, {half, 0}}}}};
  return {{height::Polygons{{{-half, 0}, {-top, b.top_height}, {top, b.top_height}, {half, 0}}}}};
}

// The bump's law, and the same as height maps on both sides, at positions over the bump, beside it, and on its ridge.
int compare(LawId id, const Bump& b, const HeightMap& map, Mode mode) {
  const auto law = std::get<reference::Law>(reference::Law::build(id, {b.radius, b.width, 0.5F}));
  const auto fast = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, mode, 0.5F));
  const auto truth = std::get<reference::HeightMapField>(reference::HeightMapField::build(map, mode, 0.5F));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int contacts = 0;
  for (int i = 0; i < 400; ++i) {
    const float x = i % 20 == 0 ? 0 : i % 20 == 1 ? -b.width / 2 : 0.6F * b.width * uniform(random);
    const float z = i % 7 == 0 ? std::round(8 * uniform(random)) / 8 : (b.height + b.top_height) * uniform(random);
    const reference::Rounded exact = law.round_to_binary32({x, 0, z});
    const fast::Evaluation got = fast.evaluate({x, 0.25F, z});
    const reference::Rounded reference = truth.round_to_binary32({x, 0.25F, z});
    EXPECT_EQ(got.status, exact.status) << x << ' ' << z;
    EXPECT_EQ(got.force, exact.force) << x << ' ' << z;
    EXPECT_EQ(reference.status, exact.status) << x << ' ' << z;
    EXPECT_EQ(reference.force, exact.force) << x << ' ' << z;
    contacts += got.status == Status::contact;
  }
  return contacts;
}

TEST(height_polygons, are_the_bumps_of_the_thesis_bit_for_bit) {
  for (const Bump& b : kRationalBumps)
    EXPECT_GT(compare(b.height != 0 ? LawId::bump_2p : LawId::bump_3p, b, {polygons(b)}, Mode::true_height), 100);
}

TEST(height_polygons, shaded_by_a_cap_are_the_shaded_bumps_of_the_thesis_bit_for_bit) {
  for (const Bump& b : kRationalBumps) {
    const HeightMap map{{{height::CylinderCap{0, b.radius, b.width}}}, polygons(b)};
    EXPECT_GT(compare(b.height != 0 ? LawId::bump_2p_shaded : LawId::bump_3p_shaded, b, map, Mode::force_shaded), 100);
  }
}

// The thesis's own bump: h is no binary32, so the ridge is moved by its rounding and the force with it.
TEST(height_polygons, miss_a_bump_whose_height_is_irrational_by_the_rounding_of_a_knot) {
  const Parameters bump{15.24F, 25.4F, 0.5F};
  const double half = 0.5 * static_cast<double>(bump.width), radius = static_cast<double>(bump.radius);
  const auto h = static_cast<float>(radius - std::sqrt(radius * radius - half * half));
  const auto law = std::get<reference::Law>(reference::Law::build(LawId::bump_2p_shaded, bump));
  const HeightMap map{{{height::CylinderCap{0, bump.radius, bump.width}}},
                      {{height::Polygons{{{-bump.width / 2, 0}, {0, h}, {bump.width / 2, 0}}}}}};
  const auto polygons = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, Mode::force_shaded, bump.stiffness));
  // Half a unit of the knot's last place, times K, and half a unit of each answer's.
  const float most = 0.5F * 0x1p-22F * bump.stiffness + 2 * 0x1p-23F;
  for (int i = 0; i < 1000; ++i) {
    const Vector3f position(0.0125F * static_cast<float>(i), 0, 6 - 0.0075F * static_cast<float>(i));
    const Vector3f miss = polygons.force(position) - law.round_to_binary32(position).force;
    EXPECT_LE(miss.cwiseAbs().maxCoeff(), most) << position.transpose();
  }
}

TEST(height_polygons, give_a_knot_to_the_side_with_larger_x_and_are_level_beyond_their_ends) {
  const HeightMap map{{{height::Polygons{{{-4, 1}, {0, 4}, {1, 4}, {4, 0}}}}}};
  const auto law = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, Mode::true_height, 1));
  EXPECT_EQ(law.force({-4, 0, -4}), Vector3f(-3, 0, 4)) << "slope 3/4, depth 5";
  EXPECT_EQ(law.force({0, 7, -1}), Vector3f(0, 0, 5)) << "level";
  EXPECT_EQ(law.force({1, 7, -1}), Vector3f(4, 0, 3)) << "slope -4/3, depth 5";
  EXPECT_EQ(law.force({4, 0, -5}), Vector3f(0, 0, 5)) << "beyond the end";
  EXPECT_EQ(law.force({-5, 0, -5}), Vector3f(0, 0, 6)) << "before the beginning";
}

TEST(height_polygons, a_surface_beside_another_rendering_is_refused) {
  const HeightMap map{{{height::Plane{}}}, {{height::Plane{}}}};
  for (const auto& [mode, name] : height::kModes) {
    const auto built = fast::HeightMapField::build(map, mode, 1);
    EXPECT_EQ(std::holds_alternative<fast::HeightMapField>(built), mode == Mode::force_shaded) << name;
    if (const auto* error = std::get_if<ParameterError>(&built)) {
      EXPECT_EQ(error->message(), "number of surface parts is 1; expected 0 to 0");
    }
  }
}

}  // namespace
}  // namespace forceshade
