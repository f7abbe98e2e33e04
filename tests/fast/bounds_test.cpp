// SPDX-License-Identifier: BSD-3-Clause
// The errors of the last stages and of the geometry, as the code itself states them, against what the proofs assume.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <variant>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "forceshade/reference.h"
#include "properties/positions.h"

namespace forceshade {
namespace {

using fast::DoubleDouble;

// A parameter set of the domain: any size of R, and bumps from almost flat to the half cylinder.
Parameters any_parameters(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto radius = static_cast<float>(std::min(1e4, 0.1001 * std::pow(10, 5 * uniform(random))));
  const double least = std::max(1e-3 / (2 * static_cast<double>(radius)), 1e-8);
  double fraction = 1;
  switch (random() % 4) {
    case 0: fraction = std::pow(least, uniform(random)); break;
    case 1: fraction = uniform(random); break;
    case 2: fraction = 1 - std::pow(2, -24 * uniform(random)); break;
    default: break;
  }
  const float width = std::clamp(static_cast<float>(2 * fraction * static_cast<double>(radius)), 1.0001e-3F, 2 * radius);
  return {radius, width, static_cast<float>(std::pow(10, 6 * uniform(random) - 3) * 0.999 + 1e-6)};
}

// docs/proofs.md, "The last stage": a component that is not on a rounding boundary is 2^-separation away from it at least. The
// enclosures of the last stage must be finer by the four bits that subtracting a boundary and asking for the sign can take.
template <class Definition>
void last_stage_sees_past_its_separation(LawId id) {
  constexpr int separation = Definition::kSeparation, count = separation > 2000 ? 50 : 100;  // the finest are slow
  using N = fast::BigFloatBall<Definition::kWideLimbs>;
  std::mt19937_64 random(3);
  std::int64_t worst = std::numeric_limits<std::int64_t>::min();
  int decided = 0;
  for (int i = 0; i < count; ++i) {
    const Parameters p = i % 4 == 0 ? Parameters{1e4F, i % 8 == 0 ? 1e-3F : 2e4F, 1e3F} : any_parameters(random);
    const fast::Built<Definition> law(p);
    const auto made = Definition::template geometry<N>(p);
    const auto geometry = [&made]() -> const auto& {
      return made;
    };
    properties::PositionSource source(std::get<reference::Law>(reference::Law::build(id, p)), random());
    for (int k = 0; k < 60; ++k) {
      const Eigen::Vector3f at = source.next().position;
      const auto is_read_as_it_is = [](float x) { return x == 0 || (std::fabs(x) >= 0x1p-30F && std::fabs(x) <= 1e4F); };
      if (!is_read_as_it_is(at.x()) || !is_read_as_it_is(at.z())) continue;
      const auto outcome = law.definition.template exact<N>(p, geometry, at.x(), at.z());
      if (outcome.contact != fast::Sign::positive) continue;
      ++decided;
      worst = std::max({worst, outcome.x.error_exponent(), outcome.z.error_exponent()});
    }
  }
  std::printf("  %s: separation 2^-%d, largest error 2^%d of %d\n", name_of(id).data(), separation, static_cast<int>(worst),
              decided);
  EXPECT_LE(worst, -separation - 4) << name_of(id);
  EXPECT_GT(decided, count) << name_of(id);
}

template <class... Definition>
void each_last_stage_sees_past_its_separation(fast::LawList<Definition...>) {
  std::size_t i = 0;
  (last_stage_sees_past_its_separation<Definition>(kLaws[i++].id), ...);
}

TEST(bounds, last_stage_sees_past_the_separation_of_each_law) {
  each_last_stage_sees_past_its_separation(fast::Laws{});
}

// The hypothesis of the proofs on the constants: the running bound of double-double says so itself for each bump built here.
TEST(bounds, geometry_in_double_double_is_good_to_its_hypothesis) {
  constexpr double kGeometry = 0x1p-94;  // relative
  std::mt19937_64 random(2);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Parameters p = any_parameters(random);
    const auto two = fast::two_polygon_face<DoubleDouble>(p.radius, p.width);
    const auto three = fast::three_polygons<DoubleDouble>(p.radius, p.width);
    const DoubleDouble half = DoubleDouble::exactly(0.5 * static_cast<double>(p.width));
    for (const DoubleDouble& constant :
         {fast::axis_depth<DoubleDouble>(p.radius, p.width), two.sine, two.cosine, two.tangent, two.tangent * half,
          three.face.sine, three.face.cosine, three.face.tangent, three.face.tangent * half, three.height, three.half_top}) {
      if (constant.hi == 0 && constant.error == 0) continue;  // d of the half cylinder
      const double relative = constant.error / std::fabs(constant.hi);
      ASSERT_LE(relative, kGeometry) << p.radius << ' ' << p.width;
      worst = std::max(worst, relative);
    }
  }
  std::printf("  worst 2^%.2f\n", std::log2(worst));
  EXPECT_GT(worst, kGeometry / 64) << "the hypothesis is idle";
}

}  // namespace
}  // namespace forceshade
