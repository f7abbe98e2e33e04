// SPDX-License-Identifier: BSD-3-Clause
// The reference's height maps where no rounded force shows it: comparisons, digits, decisions that no precision takes,
// refusals. Forces of every kind are those of height_golden_test.

#include <gtest/gtest.h>

#include <cmath>

#include "forceshade/reference.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;
using height::Mode;
using reference::HeightMapField;

// 4 by 3 samples, 2 mm apart.
std::shared_ptr<const height::Grid> grid(height::Interpolant interpolant, height::Edge edge, std::vector<float> values) {
  height::Grid grid{4, 3, 2, edge, interpolant, std::move(values)};
  return std::make_shared<const height::Grid>(std::move(grid));
}

TEST(height_reference, compares_a_force_with_rational_numbers) {
  const auto slope = std::get<HeightMapField>(HeightMapField::build({{{height::Plane{0.75F, 0, 2}}}}, Mode::true_height, 1));
  EXPECT_EQ(slope.compare({4, 7, 0.5F}, 0, "-27/10"), 0);  // 4.5 (-3/5, 0, 4/5)
  EXPECT_EQ(slope.compare({4, 7, 0.5F}, 1, "0"), 0);
  EXPECT_EQ(slope.compare({4, 7, 0.5F}, 2, "18/5"), 0);
  EXPECT_EQ(slope.compare({4, 7, 0.5F}, 2, "18000000000000000000000001/5000000000000000000000000"), -1);
  EXPECT_EQ(slope.compare({4, 7, 0.5F}, 2, "17999999999999999999999999/5000000000000000000000000"), 1);
  EXPECT_EQ(slope.compare({4, 7, 5}, 2, "1"), -1) << "free";
  EXPECT_EQ(slope.compare({4, 20000, 0}, 2, "-1"), 1) << "invalid";
}

TEST(height_reference, writes_digits_of_what_has_more_zeros_than_there_is_memory) {
  HeightMap map{{{height::Gaussian{0, 0, 1, 1}}, {height::Plane{0, 0, 1}}}};
  const auto tail = std::get<HeightMapField>(HeightMapField::build(map, Mode::true_height, 1));
  // exp(-1000^2/2) = 10^-217147.24, of a slope a thousand times that and a gap of half a millimetre.
  const reference::DecimalMapForce digits = tail.decimal({1000, 0, 0.5F}, 5);
  EXPECT_EQ(digits.status, Status::contact);
  EXPECT_EQ(digits.x.substr(digits.x.find('e')), "e-217145");
  EXPECT_EQ(digits.y, "0");
  EXPECT_EQ(tail.decimal({1000, 0, 2}, 5).status, Status::free);
  // The plane's height there, and a tail above it.
  const reference::DecimalMapForce above = tail.decimal({100, 0, 1}, 5);  // exp(-100^2/2) = 10^-2171.47
  EXPECT_EQ(above.status, Status::contact);
  EXPECT_EQ(above.z.substr(0, 2174), "0." + std::string(2171, '0') + "3");
  EXPECT_EQ(above.y, "0");
  EXPECT_EQ(tail.decimal({20000, 0, 1}, 5).status, Status::invalid);
}

// Positions at which no number of bits decides: what is left beside a surface, a tie or 0 is too small, or nothing.
TEST(height_reference, decides_where_no_precision_does) {
  const height::Gaussian hill{0, 0, 1, 1};
  const auto law = [](HeightMap map, Mode mode = Mode::true_height, float stiffness = 1) {
    return std::get<HeightMapField>(HeightMapField::build(std::move(map), mode, stiffness));
  };
  const HeightMapField nothing = law({{{hill}, {hill, true}}});
  EXPECT_EQ(nothing.round_to_binary32({1, 1, 0}).status, Status::free) << "parts that cancel";
  EXPECT_EQ(nothing.round_to_binary32({1, 1, 1}).status, Status::free);
  EXPECT_EQ(nothing.round_to_binary32({1, 1, -1}).force, Vector3f(0, 0, 1));

  // A Gaussian's far tail above and below a plane: contact, or none, with a force that rounds to 0.
  const height::Gaussian narrow{0, 0, 1, 0.2F};
  const height::Plane level{0, 0, 0.5F};
  for (const float x : {10.0F, 12.8F, 1e4F}) {
    const auto above = law({{{narrow}, {level}}}).round_to_binary32({x, 0, 0.5F});
    EXPECT_EQ(above.status, Status::contact) << x;
    EXPECT_EQ(above.force, Vector3f(0, 0, 0)) << x;
    EXPECT_EQ(law({{{narrow, true}, {level}}}).round_to_binary32({x, 0, 0.5F}).status, Status::free) << x;
  }
  // K (1/2 - z) is a tie, 1 + 2^-24; the tail moves it off, the way of its sign; its slope moves it down where the depth is not
  // its own.
  const auto z_force = [&](bool negated, Mode mode, float z) {
    return law({{{hill, negated}, {level}}}, mode, 1).round_to_binary32({80, 0, z}).force.z();
  };
  const float z = -0x1.000002p-1F;
  EXPECT_EQ(law({{{level}}}).round_to_binary32({80, 0, z}).force.z(), 1) << "a tie: to even";
  EXPECT_EQ(z_force(false, Mode::true_height, z), 0x1.000002p+0F);
  EXPECT_EQ(z_force(true, Mode::true_height, z), 1);
  EXPECT_EQ(z_force(false, Mode::conservative, z), 0x1.000002p+0F);
  // 1.5·(1 + 2^-23) is a tie, which rounds up to even: the tail's slope takes it below.
  const auto shaded = [&](std::vector<height::Part> parts) {
    return law({std::move(parts)}, Mode::force_shaded, 1.5F).round_to_binary32({80, 0, -0x1.000002p+0F}).force.z();
  };
  EXPECT_EQ(shaded({{level}}), 0x1.800004p+0F);
  EXPECT_EQ(shaded({{hill}, {level}}), 0x1.800002p+0F);

  // Two Gaussians, as far away and as high, one of them a dent: on the line between them they cancel, their slopes do not.
  const HeightMap pair{{{height::Gaussian{-3, 0, 1, 1}}, {height::Gaussian{3, 0, 1, 1}, true}}};
  EXPECT_EQ(law(pair).round_to_binary32({0, 2, 0}).status, Status::free);
  EXPECT_EQ(law(pair, Mode::conservative, 0.5F).round_to_binary32({0, 2, -0x1.000002p-1F}).force.z(), 0x1.000002p-2F);
}

TEST(height_reference, refuses_numbers_outside_the_domain) {
  const auto error = [](height::Shape shape, float stiffness = 1) {
    const auto built = HeightMapField::build({{{std::move(shape)}}}, Mode::true_height, stiffness);
    return std::holds_alternative<ParameterError>(built) ? std::get<ParameterError>(built).message() : "built";
  };
  EXPECT_EQ(error(height::Plane{1, 1, 1}), "built");
  EXPECT_EQ(error(height::Plane{1, 1, 1}, 0), "stiffness is 0 N/mm; expected 0.001 to 1000 N/mm");
  EXPECT_EQ(error(height::SphereCap{0, 0, 5, 10}), "width is 10 mm; expected 0.001 to 9.999999 mm");
  EXPECT_EQ(error(grid(height::Interpolant::bilinear, height::Edge::tile, {1, 2, 3})),
            "number of values is 3; expected 12 to 12");
  std::vector<float> values(12, 1);
  values[7] = NAN;
  EXPECT_EQ(error(grid(height::Interpolant::bilinear, height::Edge::tile, values)),
            "size of a value is nan mm; expected 9.313226e-10 to 10000 mm");
  EXPECT_TRUE(std::holds_alternative<ParameterError>(HeightMapField::build({}, Mode::true_height, 1))) << "no parts";
}

// A level surface that z lies on, beside numbers that are 0 or nearly so.
TEST(height_reference, tells_what_cancels_from_what_all_but_cancels) {
  const auto level = std::make_shared<const height::Grid>(
      height::Grid{2, 2, 0.3F, height::Edge::clamp, height::Interpolant::bilinear, {0.3F, 0.3F, 0.3F, 0.3F}});
  const auto rounded = [&](const height::Gaussian& hill, bool negated) {
    const HeightMap map{{{level}, {hill, negated}}};
    const auto law = std::get<HeightMapField>(HeightMapField::build(map, Mode::true_height, 1));
    return law.round_to_binary32({0.1F, 10, 0.3F}).status;
  };
  EXPECT_EQ(rounded({0, 0, 0, 1}, false), Status::free) << "a hill of height 0";
  EXPECT_EQ(rounded({0, 0, 1, 1}, true), Status::free) << "a dent 10 sigmas off, 10^-22 deep";
  EXPECT_EQ(rounded({0, 0, 1, 1}, false), Status::contact);
  EXPECT_EQ(rounded({0, 0, 1, 1e-3F}, true), Status::free) << "10^-21714738 deep";
  EXPECT_EQ(rounded({0, 0, 1, 1e-3F}, false), Status::contact) << "as high";
}

}  // namespace
}  // namespace forceshade
