// SPDX-License-Identifier: BSD-3-Clause
// The constants of the first stages, against the laws' own code on numbers that track their error
// (tests/support/error_number.h).
//
// Over every box tried, the tracked bound must be within kErrorBound, and over some box it must exceed half of it: so a
// constant half as large is refused. Gappa proves the bounds between the boxes (fast/*.g, docs/proofs.md); this test runs the
// code and not a copy of it.

#include <gtest/gtest.h>

#include <random>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "forceshade/fast.h"
#include "tests/support/drawn.h"
#include "tests/support/error_number.h"

namespace forceshade {
namespace {

using fast::DoubleDouble;
using tests::ErrorNumber;

constexpr double kRounded = 0x1.00001p-53;  // relative error of a constant rounded to binary64 from double-double
constexpr double kGeometry = 0x1p-94;       // relative error of a constant in double-double: checked below

void declare_tail(double head, double tail) {
  ErrorNumber::declare(tail, 0x1p-53 * std::fabs(tail) + kGeometry * head);
}
void declare_rounded(double constant) {
  ErrorNumber::declare(constant, kRounded * constant);
}
void declare_gap(const fast::LinearGap& gap) {
  ErrorNumber::declare(gap.height_tail, kGeometry * gap.height);
  declare_tail(gap.slope.head, gap.slope.tail);
}

void declare_distance(const fast::Split& d) {
  declare_tail(d.head, d.tail);
  declare_tail(2 * d.head, 2 * d.tail);
}

// Declares the errors of a law's rounded constants, by their names in the laws; the rest is exact.
template <class Definition>
void declare_constants(const Definition& law) {
  if constexpr (requires { law.d; }) declare_distance(law.d);
  if constexpr (requires { law.gap.top; }) {
    declare_gap(law.gap.top);
    declare_gap(law.gap.side);
  } else if constexpr (requires { law.gap; }) {
    declare_gap(law.gap);
  }
  if constexpr (requires { law.K_sine; }) declare_rounded(law.K_sine);
  if constexpr (requires { law.K_cosine; }) declare_rounded(law.K_cosine);
  if constexpr (requires { law.shading; }) declare_rounded(law.shading.K_over_R);
}

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

struct Box {
  float x, other_x, z, other_z;
};

// Points and small boxes around the line z = surface, from touching it to far below, and on both sides of every edge.
std::vector<Box> boxes(const Parameters& p, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double R = static_cast<double>(p.radius), half = 0.5 * static_cast<double>(p.width),
               d = std::sqrt((R - half) * (R + half));
  const double t = std::sin(std::asin(half / R) / 3), top = R * t, theta = 2 * std::asin(half / R) / 3;
  std::vector<double> xs{0, 0x1p-30, half, half * (1 - 0x1p-20), std::nextafter(p.width / 2, 2e4F), top, 1.5 * half};
  for (int i = 0; i < 4; ++i) xs.push_back(half * uniform(random));
  xs.push_back(half * std::pow(2, -30 * uniform(random)));
  std::vector<Box> found;
  const auto add = [&](double x, double z, double size) {
    if (std::fabs(x) > 1e4 || std::fabs(z) > 1e4 || (z != 0 && std::fabs(z) < 0x1p-30) || (x != 0 && x < 0x1p-30)) return;
    const auto end = [&](double from) { return static_cast<float>(from * (1 + size * uniform(random))); };
    const auto fx = static_cast<float>(x), fz = static_cast<float>(z);
    found.push_back({random() % 2 == 0 ? fx : -fx, 0, fz, size == 0 ? fz : end(z)});
    found.back().other_x = size == 0 ? found.back().x : end(static_cast<double>(found.back().x));
  };
  for (const double x : xs) {
    // Just clear of doubt: a gap of little more than 2^-27 of the height.
    for (const double slope : {half / (R + d), std::tan(theta)})
      add(x, slope * (half - x) - 0x1p-27 * (1 + 0.25 * uniform(random)) * slope * half, 0);
    // The surfaces of the laws at x, and where the forces of bump-cylinder cancel by half, above x = 0.
    const double side = std::max(0.0, half - x);
    std::vector<double> surfaces{
        0, side * half / (R + d), std::min(side, half - top) * std::tan(theta), -(R + d) / 3, -0.6 * (R + d), -d};
    if (x < R) surfaces.push_back(std::sqrt((R - x) * (R + x)) - d);
    if (x < R) surfaces.push_back(-std::sqrt((R - x) * (R + x)) - d);
    for (const double surface : surfaces) {
      for (int i = -2; i <= 2; ++i) {
        float z = static_cast<float>(surface);
        for (int k = 0; k < std::abs(i); ++k) z = std::nextafter(z, i < 0 ? -2e4F : 2e4F);
        add(x, static_cast<double>(z), 0);
      }
      const double depth = surface - (half + R) * std::pow(2, -28 * uniform(random));
      add(x, depth, 0);
      add(x, depth, 0x1p-12);
      add(x, surface - 1e4 * uniform(random), 0x1p-12);
    }
  }
  return found;
}

struct DoubleWithError {
  double worst = 0;
  int decided_boxes = 0, decided_points = 0, doubted = 0, outside = 0;
};

template <class Definition>
DoubleWithError track(const Parameters& p, std::mt19937_64& random) {
  const fast::Built<Definition> law(p);
  ErrorNumber::declare_nothing();
  declare_constants(law.definition);
  const auto first_stage = [&](const Box& box) {
    return law.definition.first_stage(ErrorNumber::between(box.x, box.other_x), ErrorNumber::between(box.z, box.other_z));
  };
  DoubleWithError result;
  for (Box box : boxes(p, random)) {
    auto force = first_stage(box);
    const bool is_point = box.x == box.other_x && box.z == box.other_z;
    // A box that straddles an edge or a surface is tried again as its corner.
    const bool is_clear = force.x.narrow() && force.z.narrow() && (!force.doubt).certain() && force.contact.certain();
    if (!is_point && !is_clear) force = first_stage({box.x, box.x, box.z, box.z});
    if (!(!force.doubt).certain()) {
      ++result.doubted;
    } else if (!force.contact.certain()) {
      ++result.outside;
    } else {
      ++(is_point || !is_clear ? result.decided_points : result.decided_boxes);
      result.worst = std::max({result.worst, force.x.relative_error(), force.z.relative_error()});
    }
  }
  return result;
}

template <class Definition>
DoubleWithError track_many() {
  std::mt19937_64 random(1);
  DoubleWithError all;
  for (std::size_t i = 0; i < tests::drawn(400); ++i) {
    const DoubleWithError one = track<Definition>(any_parameters(random), random);
    all.worst = std::max(all.worst, one.worst);
    all.decided_boxes += one.decided_boxes;
    all.decided_points += one.decided_points;
    all.doubted += one.doubted;
    all.outside += one.outside;
  }
  std::printf("  tracked %.2f, constant %.2f (units of 2^-53); %d boxes, %d points, %d in doubt, %d without contact\n",
              all.worst * 0x1p53, Definition::kErrorBound * 0x1p53, all.decided_boxes, all.decided_points, all.doubted,
              all.outside);
  EXPECT_GT(all.decided_boxes, 1000);
  EXPECT_GT(all.decided_points, 10000);
  EXPECT_GT(all.outside, 1000);
  return all;
}

template <class Definition>
void accepts_its_constant_and_refuses_half_of_it() {
  const DoubleWithError all = track_many<Definition>();
  EXPECT_LE(all.worst, Definition::kErrorBound);
  if (Definition::kErrorBound > 0) {
    EXPECT_GT(all.worst, 0.5 * Definition::kErrorBound) << "half the constant would pass";
  }
}

// f<Definition>() for each law of the list.
template <class... Definition, class F>
void for_each_law(fast::LawList<Definition...>, const F& f) {
  std::size_t i = 0;
  const auto one = [&]<class D>() {
    std::printf("%s\n", kLaws[i].name.data());
    SCOPED_TRACE(kLaws[i++].name);
    f.template operator()<D>();
  };
  (one.template operator()<Definition>(), ...);
}

TEST(bounds, of_each_law_accept_its_constant_and_refuse_half_of_it) {
  for_each_law(fast::Laws{}, []<class Definition>() { accepts_its_constant_and_refuses_half_of_it<Definition>(); });
}

// docs/proofs.md, "The last stage": a component that is not on a rounding boundary is 2^-separation away from it at least. The
// enclosures of the last stage must be finer by the four bits that subtracting a boundary and asking for the sign can take.
template <class Definition>
void last_stage_sees_past_its_separation() {
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
    const std::vector<Box> all = boxes(p, random);
    for (int k = 0; k < 40; ++k) {
      const Box& box = all[random() % all.size()];
      const auto outcome = law.definition.template exact<N>(p, geometry, box.x, box.z);
      if (outcome.contact != fast::Sign::positive) continue;
      ++decided;
      worst = std::max({worst, outcome.x.error_exponent(), outcome.z.error_exponent()});
    }
  }
  std::printf("  separation 2^-%d, largest error 2^%d of %d\n", separation, static_cast<int>(worst), decided);
  EXPECT_LE(worst, -separation - 4);
  EXPECT_GT(decided, count);
}

TEST(bounds, last_stage_sees_past_the_separation_of_each_law) {
  for_each_law(fast::Laws{}, []<class Definition>() { last_stage_sees_past_its_separation<Definition>(); });
}

// The hypothesis of the proofs on the constants: the running bound of double-double says so itself for each bump built here.
TEST(bounds, geometry_in_double_double_is_good_to_its_hypothesis) {
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
