// SPDX-License-Identifier: BSD-3-Clause
#include "properties/work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "reference/energy.h"
#include "reference/estimates.h"

namespace forceshade::reference {
namespace {

using Path = std::vector<PathPoint>;

constexpr Parameters kThesisBump{15.24F, 25.4F, 0.5F};
const std::vector<Parameters> kBumps{kThesisBump, {35.56F, 25.4F, 2}, {1.25F, 1.5F, 1}, {100, 1, 1000}, {5, 8, 0.01F}};

Law build(LawId id, const Parameters& p) {
  return std::get<Law>(Law::build(id, p));
}

double low(const Interval& value) {
  return value.low.convert_to<double>();
}

double width(const Interval& value) {
  return Multiprecision(value.high - value.low).convert_to<double>();
}

// Corners in and above the bump and beside it.
Path random_polygon(std::mt19937& random, const Parameters& p) {
  const auto uniform = [&](float from, float to) { return std::uniform_real_distribution<float>(from, to)(random); };
  Path path;
  for (int i = 0; i < 6; ++i) path.push_back({uniform(-0.7F, 0.7F) * p.width, uniform(-0.4F, 0.3F) * p.width});
  path.push_back(path.front());
  return path;
}

TEST(work, equals_quadrature_of_the_force) {
  std::mt19937 random(1);
  double worst = 0;
  for (const LawName& name : kLaws)
    for (const Parameters& p : kBumps) {
      const auto subject = std::get<properties::RenderedLaw>(properties::fast_rendering(name.id, p));
      const properties::LawClaims claims(subject.law);
      for (int i = 0; i < 60; ++i) {
        const Path path = random_polygon(random, p);
        const Interval exact = work(subject.law, path);
        const properties::Work other = work_around(subject, claims, [&] {
          std::vector<properties::PathPoint> vertices;
          for (const PathPoint& point : path) vertices.push_back({static_cast<double>(point.x), static_cast<double>(point.z)});
          return vertices;
        }());
        EXPECT_GE(width(exact), 0);
        EXPECT_LT(width(exact), 1e-50) << name.name;
        const double off = std::fabs(low(exact) - other.exact) / (other.placing + 1e-12);
        EXPECT_LT(off, 1) << name.name << ' ' << low(exact);
        worst = std::max(worst, off);
      }
    }
  std::printf("  worst difference %.2g of what rounding the positions allows\n", worst);
}

TEST(work, of_a_small_step_is_the_force_times_the_step) {
  std::mt19937 random(6);
  constexpr float kStep = 0x1p-10F;
  for (const LawName& name : kLaws) {
    const Law law = build(name.id, kThesisBump);
    for (int i = 0; i < 100; ++i) {
      // Steps of 1/64 mm, no line of jump within a step of them; deep enough to be in contact, well above the axis.
      const float x = std::floor(std::uniform_real_distribution<float>(-900, 900)(random)) / 64 + 0x1p-7F;
      const float z = std::floor(std::uniform_real_distribution<float>(-200, -1)(random)) / 64;
      const Law::Estimate at = law.estimate({x, 0, z});
      const auto fx = static_cast<double>(at.force.x.mid()), fz = static_cast<double>(at.force.z.mid());
      const auto step = static_cast<double>(kStep);
      const float half = kStep / 2;
      // No force of these changes by more than 4 K a mm there; its value at the middle is off by a quarter of a step's change.
      const double allowed = 4 * 0.5 * step * step / 4;
      EXPECT_NEAR(low(work(law, {{x - half, z}, {x + half, z}})), fx * step, allowed) << name.name << ' ' << x << ' ' << z;
      EXPECT_NEAR(low(work(law, {{x, z - half}, {x, z + half}})), fz * step, allowed) << name.name << ' ' << x << ' ' << z;
    }
  }
}

TEST(work, around_a_closed_path_is_nothing_where_the_law_is_conservative) {
  std::mt19937 random(2);
  for (const LawId id : {LawId::wall, LawId::cylinder, LawId::bump_cylinder, LawId::bump_1p})
    for (const Parameters& p : kBumps)
      for (int i = 0; i < 20; ++i) {
        const Interval around = work(build(id, p), random_polygon(random, p));
        EXPECT_LE(around.low, 0);
        EXPECT_GE(around.high, 0);
        EXPECT_LT(width(around), 1e-65);
      }
}

TEST(work, does_not_depend_on_where_a_straight_path_is_cut) {
  for (const LawName& name : kLaws) {
    const Law law = build(name.id, kThesisBump);
    const Path whole{{-16, -2}, {8, 1}}, cut{{-16, -2}, {-8, -1}, {0, 0}, {4, 0.5F}, {8, 1}};
    const Interval a = work(law, whole), b = work(law, cut);
    EXPECT_LE(std::max(a.low, b.low), std::min(a.high, b.high)) << name.name;
    EXPECT_GT(std::fabs(low(a)), 0.05) << name.name;
  }
}

TEST(work, is_nothing_above_the_surface_and_along_it) {
  for (const LawName& name : kLaws) {
    const Interval above = work(build(name.id, kThesisBump), {{-20, 7}, {20, 7}, {20, 1}, {13, 0.5F}, {13, 0}, {30, 0}});
    EXPECT_EQ(above.low, 0) << name.name;
    EXPECT_EQ(above.high, 0) << name.name;
  }
  // From the ridge down the side, as nearly as an irrational slope allows: h = 1/4, w/2 = 3/4 are rational.
  for (const LawId id : {LawId::bump_2p, LawId::bump_2p_shaded}) {
    const Interval along = work(build(id, {1.25F, 1.5F, 1}), {{0, 0.25F}, {0.75F, 0}, {0.375F, 0.125F}});
    EXPECT_LT(std::max(std::fabs(low(along)), width(along)), 1e-70) << name_of(id);
  }
}

// Up by one millimetre to the height of the line, one millimetre under it: what it generates is ½K·F_z/|F|.
double share(LawId id, const Parameters& p, float x, float height) {
  const Interval generated = work(build(id, p), {{x, height - 1}, {x, height}});
  EXPECT_LT(width(generated), 1e-60);
  return low(generated) / (0.5 * static_cast<double>(p.stiffness));
}

TEST(work, along_a_line_of_jump_is_that_of_the_side_it_belongs_to) {
  const double alpha = std::asin(25.4 / 30.48), theta = 2 * alpha / 3;
  const std::array<std::pair<LawId, double>, 5> inside{{{LawId::bump_2p, std::cos(alpha / 2)},
                                                        {LawId::bump_3p, std::cos(theta)},
                                                        {LawId::bump_1p_shaded, std::cos(alpha)},
                                                        {LawId::bump_2p_shaded, std::cos(alpha)},
                                                        {LawId::bump_3p_shaded, std::cos(alpha)}}};
  for (const auto& [id, cosine] : inside)
    for (const float sign : {-1.0F, 1.0F}) {
      EXPECT_NEAR(share(id, kThesisBump, sign * 12.7F, 0), cosine, 1e-6) << name_of(id);
      EXPECT_NEAR(share(id, kThesisBump, sign * std::nextafter(12.7F, 13.0F), 0), 1, 1e-15) << name_of(id);
    }
  // w'/2 = R/2 where w = 2R, and 1/4 where R = 1, w = 1.375: the only kind of w'/2 a position can be on.
  for (const auto& [p, x, height] :
       {std::tuple{Parameters{10, 20, 1}, 5.0F, std::sqrt(75.0F)}, {Parameters{1, 1.375F, 1}, 0.25F, 0.24206147F}})
    for (const float sign : {-1.0F, 1.0F}) {
      const double slope = 2 * std::asin(static_cast<double>(p.width / (2 * p.radius))) / 3;
      EXPECT_NEAR(share(LawId::bump_3p, p, sign * x, height), 1, 2e-6);
      EXPECT_NEAR(share(LawId::bump_3p, p, sign * std::nextafter(x, 20.0F), height), std::cos(slope), 2e-6);
    }
}

TEST(work, knows_the_half_cylinders_vertical_edge) {
  // w = 2R: on x = R the shaded force points sideways, and going up generates nothing.
  EXPECT_EQ(share(LawId::bump_1p_shaded, {10, 20, 1}, 10, 0), 0);
  // Outward at the depth D: K·D·∫x/R dx = K·D·R/2.
  const Interval outward = work(build(LawId::bump_1p_shaded, {10, 20, 1}), {{0, -2}, {10, -2}});
  EXPECT_DOUBLE_EQ(low(outward), 10);
  EXPECT_LT(width(outward), 1e-60);
}

}  // namespace
}  // namespace forceshade::reference
