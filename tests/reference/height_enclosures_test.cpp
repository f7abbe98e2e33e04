// SPDX-License-Identifier: BSD-3-Clause
// Every energy of a height map is a finite interval or a refusal in words, however steep or fine the map is.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "forceshade/fast.h"
#include "reference/energy.h"
#include "reference/energy/height_circulation.h"
#include "reference/height_energy.h"
#include "reference/numbers/taylor_coefficients.h"
#include "tests/properties/random_loop.h"
#include "tests/support/drawn.h"
#include "tests/support/words.h"

namespace forceshade::reference {
namespace {

using Along = Slice::Along;
using height::Mode;

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();

HeightMapField build(HeightMap map, Mode mode, float stiffness = 1) {
  return std::get<HeightMapField>(HeightMapField::build(std::move(map), mode, stiffness));
}

double number(const Multiprecision& value) {
  return value.convert_to<double>();
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  // Every binade alike.
  float size(double low, double high) {
    return static_cast<float>(std::clamp(std::exp2(uniform(std::log2(low), std::log2(high))), low, high));
  }
  float either_sign(double low, double high) { return is(0.5) ? size(low, high) : -size(low, high); }
  bool is(double share) { return uniform(0, 1) < share; }
  int below(int count) { return static_cast<int>(uniform(0, count)); }

 private:
  std::mt19937 engine_;
};

// slack: of the value that is compared.
bool holds(const Ball64& enclosed, long double value, long double slack) {
  return enclosed.low() - slack <= value && value <= enclosed.high() + slack;
}

TEST(series, balls_of_a_function_hold_its_values_and_little_more) {
  Random random(1);
  int wide = 0, narrow = 0;
  for (int i = 0; i < 3000; ++i) {
    const long double mid = static_cast<long double>(random.either_sign(1e-6, 1e3)), rad = random.size(1e-15, 30);
    const Ball64 x(mid, rad);
    const auto [sine, cosine] = sine_and_cosine(x);
    const Ball64 squared = square(x), power = exp(x);
    for (int k = -10; k <= 10; ++k) {
      const long double at = mid + rad * static_cast<long double>(k) / 10;
      // `at` itself is rounded, by as much as may take it out of the ball.
      const long double slack = 0x1p-62L * (1 + std::fabs(at));
      EXPECT_TRUE(holds(sine, std::sin(at), slack)) << mid << " ± " << rad;
      EXPECT_TRUE(holds(cosine, std::cos(at), slack)) << mid << " ± " << rad;
      EXPECT_TRUE(holds(squared, at * at, 4 * slack * std::fabs(at))) << mid << " ± " << rad;
      EXPECT_TRUE(holds(power, std::exp(at), 2 * slack * std::exp(at))) << mid << " ± " << rad;
    }
    const long double most = std::fabs(mid) + rad, slack = 1 + 0x1p-50L;
    EXPECT_GE(squared.low(), -0x1p-60L * most * most) << mid << " ± " << rad;
    EXPECT_LE(squared.high(), most * most * slack) << mid << " ± " << rad;
    for (const Ball64& wave : {sine, cosine})
      EXPECT_TRUE(wave.low() >= -1 - 0x1p-8L && wave.high() <= 1 + 0x1p-8L) << mid << " ± " << rad;
    EXPECT_LE(power.high(), std::exp(mid + rad) * (1 + 1e-4L));
    if (rad > 0.1L) {
      ++wide;
      continue;
    }
    ++narrow;
    EXPECT_LE(sine.rad(), std::fabs(std::cos(mid)) * rad + rad * rad + 1e-15L) << mid << " ± " << rad;
    EXPECT_LE(cosine.rad(), std::fabs(std::sin(mid)) * rad + rad * rad + 1e-15L) << mid << " ± " << rad;
    EXPECT_LE(power.rad(), std::exp(mid) * (rad + rad * rad + 1e-15L)) << mid << " ± " << rad;
  }
  EXPECT_GT(wide, 100);
  EXPECT_GT(narrow, 100);
}

TEST(series, what_is_not_finite_is_no_ball) {
  const long double nan = std::nanl("");
  EXPECT_THROW(ball(0, kInfinity), Undecided);
  EXPECT_THROW(ball(-kInfinity, 0), Undecided);
  EXPECT_THROW(ball(nan, 1), Undecided);
  EXPECT_THROW(ball(0, nan), Undecided);
  EXPECT_THROW(ball(1, 0), Undecided);
  EXPECT_NO_THROW(ball(1, 1));
  EXPECT_THROW(exp(Ball64(0, kInfinity)), Undecided);
  EXPECT_THROW(exp(Ball64(1e6L, 0)), Undecided) << "more than a long double holds";
  EXPECT_EQ(sine_and_cosine(Ball64(0, kInfinity))[0].rad(), 1);
  EXPECT_EQ(sine_and_cosine(Ball64(nan, 0))[1].rad(), 1);
}

TEST(enclosure, of_what_is_not_finite_or_not_in_order_is_refused) {
  const Multiprecision one(1), two(2), infinite(std::numeric_limits<double>::infinity()), nan(std::nan(""));
  EXPECT_NO_THROW(interval(one, two));
  EXPECT_NO_THROW(interval(one, one));
  for (const auto& [low, high] :
       {std::pair{two, one}, {one, infinite}, {Multiprecision(-infinite), one}, {nan, one}, {one, nan}})
    EXPECT_THROW(interval(low, high), NotEnclosed) << low << ' ' << high;
  EXPECT_THROW(interval(Enclosure(nan)), NotEnclosed);
}

struct Verdict {
  SliceBound bound;
  std::vector<Eigen::Vector3f> witness;
  Interval generated;
  double share = 0;  // of the bound that the witness generates
};

void expect_enclosed(const Interval& value, const std::string& what) {
  EXPECT_TRUE(std::isfinite(number(value.low)) && std::isfinite(number(value.high))) << what;
  EXPECT_LE(value.low, value.high) << what;
}

// Finite, in order, and no less than what the witness generates.
Verdict verdict(const HeightMapField& law, const Slice& slice, float depth, const std::string& what) {
  Verdict v{loop_bound(law, slice, depth), witness(law, slice, depth), {}};
  v.generated = work(law, v.witness);
  for (const Interval& value : {v.bound.counter_clockwise, v.bound.clockwise, v.bound.most(), v.generated})
    expect_enclosed(value, what);
  EXPECT_GE(v.bound.counter_clockwise.low, 0) << what;
  EXPECT_GE(v.bound.clockwise.low, 0) << what;
  EXPECT_LE(v.generated.low, v.bound.most().high) << what;
  v.share = v.bound.most().high > 0 ? number(Multiprecision(v.generated.low / v.bound.most().high)) : 1;
  return v;
}

TEST(height_enclosures, of_fine_gratings_are_narrow_and_met) {
  // Three waves of 0.3 mm, from gentle to as steep as a wall.
  for (const Mode mode : {Mode::true_height, Mode::force_shaded})
    for (const float h : {0.01F, 0.1F, 1.0F, 20.0F}) {
      const std::string what = "height " + std::to_string(h);
      const HeightMapField law = build({{{height::Grating{h, 19.44F, 0, 0}}}}, mode);
      const Verdict v = verdict(law, {Along::x, 0, -0.5F, 0.5F}, 0.5F, what);
      const double most = number(v.bound.most().high);
      EXPECT_LE(number(Multiprecision(v.bound.most().high - v.bound.most().low)), 1e-7 * most) << what;
      EXPECT_GE(v.share, 0.998) << what;
    }
}

TEST(height_enclosures, of_a_hundred_fine_waves_are_finite_and_narrow) {
  for (const float h : {1.0F, 20.0F}) {
    const SliceBound bound = loop_bound(build({{{height::Grating{h, 19.44F, 0, 0}}}}, Mode::force_shaded), {}, 0.5F);
    for (const Interval& sense : {bound.counter_clockwise, bound.clockwise}) {
      expect_enclosed(sense, "height " + std::to_string(h));
      EXPECT_LE(number(Multiprecision(sense.high - sense.low)), 2e-5 * number(sense.high)) << h;
      EXPECT_GT(number(sense.high), 10) << h;
    }
  }
}

TEST(height_enclosures, of_fine_gratings_equal_the_closed_forms) {
  for (const double h : {0.125, 1.0, 20.0})
    for (const double wave : {8.0, 19.5}) {
      const double steepness = h * wave, D = 0.125;
      const HeightMap map{{{height::Grating{static_cast<float>(h), static_cast<float>(wave), 0, 0}}}};
      const auto upright = [&](double angle) { return 1 / std::hypot(1, steepness * std::sin(angle)); };
      const auto area = [&](double angle) { return std::asin(steepness * std::cos(angle) / std::hypot(1, steepness)) / wave; };
      // A piece of a flank, all of which generates energy.
      const Slice flank{Along::x, 0, static_cast<float>(1 / wave), static_cast<float>(1.25 / wave)};
      const double from = static_cast<double>(flank.from) * wave, to = static_cast<double>(flank.to) * wave;
      const double shaded = D * (area(from) - area(to)) + D * D / 2 * (upright(to) - upright(from));
      const SliceBound on_flank = loop_bound(build(map, Mode::force_shaded), flank, static_cast<float>(D));
      EXPECT_NEAR(number(on_flank.counter_clockwise.low), shaded, 1e-7 * shaded) << h << ' ' << wave;
      EXPECT_NEAR(number(on_flank.counter_clockwise.high), shaded, 1e-7 * shaded) << h << ' ' << wave;
      // From flank to crest and back, at every crest and in every valley, of which there are three.
      const Slice waves{Along::x, 0, static_cast<float>(-1.5 * M_PI / wave), static_cast<float>(1.5 * M_PI / wave)};
      const double generated = 3 * D * D / 2 * (1 - upright(M_PI / 2));
      const SliceBound bound = loop_bound(build(map, Mode::true_height), waves, static_cast<float>(D));
      for (const Interval& sense : {bound.counter_clockwise, bound.clockwise}) {
        EXPECT_NEAR(number(sense.low), generated, 2e-7 * generated) << h << ' ' << wave;
        EXPECT_NEAR(number(sense.high), generated, 2e-7 * generated) << h << ' ' << wave;
      }
    }
}

// A part of any kind and size in the domain, near the slice, so that the slice meets it.
height::Part random_part(Random& random, double reach) {
  const auto near = [&] { return static_cast<float>(random.uniform(-reach, reach)); };
  const auto cap_width = [&](float radius) {
    return random.is(0.3) ? std::nextafter(2 * radius, 0.0F)
                          : std::min(random.size(1e-3, 1e3), std::nextafter(2 * radius, 0.0F));
  };
  const bool is_negated = random.is(0.5);
  const float radius = random.size(0.1, 1e3);
  const double most_wave = std::min(1e3, 30 / reach);
  const auto drawn = [&](const auto& number) {
    switch (number.meaning) {
      case height::Meaning::centre: return near();
      case height::Meaning::height: return random.either_sign(1e-6, 1e3);
      case height::Meaning::slope: return random.either_sign(1e-3, 1e3);
      case height::Meaning::wave: return random.either_sign(most_wave / 1e4, most_wave);
      case height::Meaning::reach: return random.size(1e-3, 1e3);
      case height::Meaning::radius: return radius;
      case height::Meaning::chord: break;
    }
    return cap_width(radius);
  };
  const auto polygons = [&] {
    height::Polygons polygons{{{static_cast<float>(-1.5 * reach), 0}}};
    for (int i = 0; i < 6; ++i)
      polygons.knots.push_back(
          {polygons.knots.back().x + 0.0011F + static_cast<float>(random.uniform(0, reach)), random.either_sign(1e-6, 1e3)});
    return polygons;
  };
  const auto grid = [&] {
    const auto interpolant = random.is(0.5) ? height::Interpolant::bilinear : height::Interpolant::cubic_spline;
    height::Grid grid{9, 5, std::clamp(static_cast<float>(reach / 4), 0.001F, 100.0F), height::Edge::tile, interpolant, {}};
    const double most = static_cast<double>(random.size(1e-6, 1e3));
    for (int i = 0; i < 45; ++i) grid.values.push_back(random.either_sign(1e-7, most));
    return std::make_shared<const height::Grid>(grid);
  };
  return {height::shape_of_kind(random.below(height::kKinds), drawn, polygons, grid), is_negated};
}

// The energy that the fast path generates along a path, by the force at the middle of 500 steps a segment, and its largest
// error.
struct Walked {
  double generated = 0, tolerance = 0;  // mJ
};

Walked walked(const fast::HeightMapField& law, const std::vector<Eigen::Vector3f>& path) {
  constexpr int kSteps = 500;
  Walked sum;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3d from = path[i - 1].cast<double>(), step = (path[i].cast<double>() - from) / kSteps;
    Eigen::Vector3d last = law.force(path[i - 1]).cast<double>();
    for (int k = 0; k < kSteps; ++k) {
      const Eigen::Vector3d force = law.force((from + (k + 0.5) * step).cast<float>()).cast<double>();
      sum.generated += force.dot(step);
      // A step may be wrong by all that the force changes on it; positions and forces are rounded by 2^-24 of their size.
      sum.tolerance += (step.norm() + 0x1p-23 * from.norm()) * (force - last).norm() + 0x1p-23 * force.norm() * step.norm();
      last = force;
    }
  }
  return sum;
}

TEST(height_enclosures, of_random_maps_are_finite_and_in_order_or_refused) {
  Random random(5);
  std::mt19937 loops(7);
  std::size_t met = 0, wide = 0, refused = 0, outside = 0, none = 0, felt = 0;
  double best = 0;
  const std::size_t maps = tests::drawn(120);
  for (std::size_t i = 0; i < maps; ++i) {
    const double reach = static_cast<double>(random.size(2e-3, 20));
    HeightMap map;
    for (int parts = 1 + random.below(3); parts > 0; --parts) map.parts.push_back(random_part(random, reach));
    const bool is_shaded = random.is(0.6);
    if (is_shaded && random.is(0.3)) map.surface.push_back(random_part(random, reach));
    const HeightMapField law = build(map, is_shaded ? Mode::force_shaded : Mode::true_height, random.size(1e-3, 1e3));
    const Slice slice{random.is(0.5) ? Along::x : Along::y, static_cast<float>(random.uniform(-reach, reach)),
                      static_cast<float>(-reach), static_cast<float>(reach)};
    const float depth = random.size(1e-4, 100);
    const std::string what = "map " + std::to_string(i) + ", depth " + std::to_string(depth);
    if (slice_error(law, slice, depth)) {
      ++outside;
      continue;
    }
    try {
      const Verdict v = verdict(law, slice, depth, what);
      // Nowhere below the highest place by more than the depth.
      const auto fast = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, law.mode(), law.stiffness()));
      const auto top = static_cast<float>(tallest(law, slice)), bottom = std::nextafter(top - depth, top);
      for (int loop = 0; loop < 5; ++loop) {
        const Walked around = walked(fast, random_loop(loops, slice, bottom, top + depth / 4));
        EXPECT_LE(around.generated, number(v.bound.counter_clockwise.high) + around.tolerance) << what;
        EXPECT_LE(-around.generated, number(v.bound.clockwise.high) + around.tolerance) << what;
        if (std::fabs(around.generated) > around.tolerance) ++felt;
        best = std::max(best, (std::fabs(around.generated) - around.tolerance) / number(v.bound.most().high));
      }
      const double most = number(v.bound.most().high), width = most - number(v.bound.most().low);
      const auto K = static_cast<double>(law.stiffness()), D = static_cast<double>(depth);
      if (v.witness.empty()) {
        EXPECT_LE(most, 2e-12 * K * D * D) << what;
        ++none;
      } else if (v.share >= 0.99) {
        ++met;
      }
      if (most > 0 && !v.witness.empty() && v.share < 0.99)
        std::printf("  %s: the witness generates %.4f of it\n", what.c_str(), v.share);
      if (width > 1e-4 * most && width > 1e-9) {
        ++wide;
        std::printf("  %s: between %.6g and %.6g mJ\n", what.c_str(), most - width, most);
      }
    } catch (const NotEnclosed& error) {
      ++refused;
      std::printf("  %s: %s\n", what.c_str(), error.what());
    }
  }
  std::printf("  %zu met to 99 %%, %zu without a witness, %zu wide, %zu refused, %zu outside the domain\n", met, none, wide,
              refused, outside);
  std::printf("  %zu of the loops are felt; the best generates %.0f %% of its bound\n", felt, 100 * best);
  EXPECT_GE(met, tests::drawn(50));
  EXPECT_GE(felt, tests::drawn(50));
  EXPECT_LE(wide + refused, tests::drawn(2));
}

TEST(height_enclosures, of_laws_are_finite_and_in_order) {
  Random random(6);
  const std::size_t bumps = tests::drawn(60);
  for (std::size_t i = 0; i < bumps; ++i) {
    const float R = random.size(0.1, 1e4),
                w = random.is(0.3) ? std::nextafter(2 * R, 0.0F) : random.size(1e-3, 2 * static_cast<double>(R));
    for (const LawName& name : kLaws) {
      const auto built = Law::build(name.id, {R, w, random.size(1e-3, 1e3)});
      const Law* law = std::get_if<Law>(&built);
      if (law == nullptr) continue;
      const float depth = random.size(1e-4, 1e4);
      if (depth_error(*law, depth)) continue;
      const LoopBound bound = loop_bound(*law, depth);
      for (const Interval& value : {bound.counter_clockwise, bound.clockwise, bound.anywhere})
        expect_enclosed(value, std::string(name.name) + ' ' + std::to_string(R) + ' ' + std::to_string(w));
      const Interval generated = work(*law, witness(*law, depth));
      expect_enclosed(generated, std::string(name.name));
      EXPECT_LE(generated.low, bound.anywhere.high) << name.name;
    }
  }
}

TEST(height_enclosures, refuse_a_cone_whose_apex_is_missed_by_less_than_64_bits_show) {
  const HeightMapField law = build({{{height::Cone{0.3F, 0, 3, 4}}}}, Mode::true_height);
  const Slice slice{Along::x, 1e-35F, -1, 1};
  const auto words = [](const auto& f) -> std::string { return tests::thrown_by<NotEnclosed>(f); };
  EXPECT_EQ(words([&] { loop_bound(law, slice, 1); }).find("not enclosed: the height map is so steep or so fine"), 0U);
  EXPECT_EQ(words([&] { witness(law, slice, 1); }).find("not enclosed: "), 0U);
  EXPECT_EQ(words([&] { work(law, {{-1, 1e-35F, 1}, {1, 1e-35F, 1}}); }).find("not enclosed: "), 0U);
}

TEST(monitor, is_told_how_far_it_is_and_stops_all_three) {
  const HeightMapField law = build({{{height::Grating{1, 19.44F, 0, 0}}}}, Mode::force_shaded);
  const Slice slice{Along::x, 0, -0.5F, 0.5F};
  const auto path = witness(law, slice, 0.5F);
  std::atomic<bool> stop{false};
  for (const auto& compute : std::initializer_list<std::function<void(const Monitor&)>>{
           [&](const Monitor& monitor) { loop_bound(law, slice, 0.5F, monitor); },
           [&](const Monitor& monitor) { witness(law, slice, 0.5F, monitor); },
           [&](const Monitor& monitor) { work(law, path, monitor); }}) {
    stop = false;
    std::vector<double> seen;
    compute(Monitor([&](double done) { seen.push_back(done); }, stop).part(0.25, 0.75));
    ASSERT_GT(seen.size(), 20U);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_GE(seen.front(), 0.25);
    EXPECT_LT(seen.front(), 0.3);
    EXPECT_GT(seen.back(), 0.6);
    EXPECT_LE(seen.back(), 0.75);
    std::size_t reports = 0;
    const Monitor impatient([&](double) { stop = ++reports == 10; }, stop);
    EXPECT_THROW(compute(impatient), Interrupted);
    EXPECT_EQ(reports, 10U) << "stopped at once";
  }
  EXPECT_FALSE(potential(law)) << "and lets others compute";
}

}  // namespace
}  // namespace forceshade::reference
