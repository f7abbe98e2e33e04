// SPDX-License-Identifier: BSD-3-Clause
// The properties of docs/damping.md in rational numbers, on random paths of a hand and springs that come and go, which
// RapidCheck draws and makes simpler; the paths that come nearest to the bound of sampling; and dampers that just break each.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/properties.h"
#include "properties/binary32.h"
#include "properties/split_mix.h"
#include "tests/support/drawn.h"
#include "tests/support/with_rapidcheck.h"

namespace forceshade {
namespace {

using damping::Parameters;
using properties::show;
using properties::Violation;
using Rational3 = std::array<mpq_class, 3>;

mpq_class rational(float a) {
  return static_cast<double>(a);
}
Rational3 rational(const Eigen::Vector3f& a) {
  return {rational(a.x()), rational(a.y()), rational(a.z())};
}
mpq_class product(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Rational3 difference(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
// The most by which the rounding of a force to binary32 changes its product with a.
mpq_class rounding(const Rational3& force, const Rational3& a) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (abs(force[i]) * mpq_class(0x1p-24) + mpq_class(0x1p-150)) * abs(a[i]);
  return sum;
}

struct Step {
  Eigen::Vector3f position{0, 0, 0}, spring{0, 0, 0};  // mm, N
  damping::Limits limits = {};                         // of the face that the spring is of
};
struct Path {
  Parameters parameters;
  std::vector<Step> steps;  // a period apart
};
// The damped force, N, and the velocity that the damper has then, mm/s.
struct Answer {
  Eigen::Vector3f force, velocity;
};
using Damper = std::function<Answer(const Step& step)>;
using OpenDamper = std::function<Damper(const Parameters& parameters)>;

// Bends and jumps of a hand, in full resolution or in counts, and springs of any direction, on faces that limit damping or not.
Path drawn_path(std::uint64_t seed) {
  std::uint64_t count = 0;
  const auto random = [&] { return properties::split_mix(seed, count++); };
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  const auto vector = [&](double size) {
    const auto one = [&] { return static_cast<float>(between(-size, size)); };
    const float x = one(), y = one(), z = one();
    return Eigen::Vector3f(x, y, z);
  };
  Path path;
  Parameters& p = path.parameters;
  p.rate = random() % 2 == 0 ? 1000 : 200;
  p.share = random() % 2 == 0 ? 1 : static_cast<float>(std::exp2(between(-4, 0)));
  p.damping = random() % 4 == 0 ? 0 : static_cast<float>(std::exp2(between(-12, -4)));
  p.drag = random() % 2 == 0 ? 0 : static_cast<float>(std::exp2(between(-12, -4)));
  if (p.is_off()) p.damping = 0x1p-9F;
  p.most = random() % 3 == 0 ? HUGE_VALF : static_cast<float>(between(1, 4));
  Eigen::Vector3f at(0, 0, 0), direction(0, 0, 1);
  const bool has_counts = random() % 2 == 0, has_limits = random() % 2 == 0;
  const auto limit = [&] { return random() % 3 == 0 ? 0 : static_cast<float>(std::exp2(between(-14, -2))); };
  for (int tick = 0; tick < 40; ++tick) {
    if (random() % 8 != 0) at += vector(random() % 2 == 0 ? 0.2 : 0.01);
    if (random() % 6 == 0) direction = vector(1);
    const Eigen::Vector3f read = has_counts ? Eigen::Vector3f(0.03F * (at / 0.03F).array().round()) : at;
    const auto size = static_cast<float>(random() % 4 == 0 ? 0 : std::exp2(between(-12, 3)));
    path.steps.push_back({read, size * direction});
    if (has_limits && random() % 4 != 0) path.steps.back().limits = {limit(), limit()};
  }
  return path;
}

const properties::Generator<Path>& damped_paths() {
  static const properties::Generator<Path> paths{drawn_path, [](const Path& path) {
                                                   std::vector<Path> simpler;
                                                   for (const auto& steps : properties::shorter(path.steps, 2))
                                                     simpler.push_back({path.parameters, steps});
                                                   return simpler;
                                                 }};
  return paths;
}

Damper own_damper(const Parameters& parameters) {
  const auto its = std::make_shared<fast::Damping>(std::get<fast::Damping>(fast::Damping::build(parameters)));
  return [its](const Step& step) -> Answer {
    const Eigen::Vector3f force = its->tick(step.position, 1, {step.spring, Status::contact, {}, step.limits}).force;
    return {force, Eigen::Vector3f(its->state().velocity.data())};
  };
}

// d·v ≤ -‖d‖²/max(B, B_t) in each tick, for d = F - f, but for the rounding of F.
Violation dissipates_at_its_own_velocity(const Path& path, const OpenDamper& open = own_damper) {
  const Damper damper = open(path.parameters);
  const mpq_class most = rational(path.parameters.larger());
  for (const Step& step : path.steps) {
    const Answer answer = damper(step);
    const Rational3 F = rational(answer.force), v = rational(answer.velocity), d = difference(F, rational(step.spring));
    // d is that of the rounded force: it changes both sides, the second by at most 2 |d·rounding|.
    if (product(d, v) + product(d, d) / most > rounding(F, v) + 3 * rounding(F, d) / most)
      return "at " + show(answer.velocity) + " mm/s damping makes " + show(step.spring) + " N to " + show(answer.force) +
             " N, and gives energy";
  }
  return std::nullopt;
}

// Σ d·Δ, what damping gives to the hand while each force is held, beside its bound, mJ.
struct Sampled {
  mpq_class given = 0, bound = 0, rounding = 0;
};
Sampled sampled(const Path& path, const OpenDamper& open = own_damper) {
  const Parameters& p = path.parameters;
  const Damper damper = open(p);
  const double gamma = damping::sampling_factor(static_cast<double>(p.share));
  const mpq_class factor = mpq_class(gamma) * rational(p.larger()) * rational(p.rate);
  Sampled sum;
  for (std::size_t k = 0; k + 1 < path.steps.size(); ++k) {
    const Step& step = path.steps[k];
    const Rational3 F = rational(damper(step).force);
    const Rational3 way = difference(rational(path.steps[k + 1].position), rational(step.position));
    sum.given += product(difference(F, rational(step.spring)), way);
    sum.bound += factor * product(way, way);
    sum.rounding += rounding(F, way);
  }
  // The filter's rounding makes γ larger by a share that is computed, not proved (docs/damping.md), and γ has its own in
  // binary64.
  sum.rounding += sum.bound * mpq_class(0x1p-20) / rational(p.share);
  return sum;
}

Violation sampling_gives_at_most_the_bound(const Path& path, const OpenDamper& open = own_damper) {
  const Sampled sum = sampled(path, open);
  if (sum.given <= sum.bound + sum.rounding) return std::nullopt;
  return "damping gives " + std::to_string(sum.given.get_d()) + " mJ, more than " + std::to_string(sum.bound.get_d()) + " mJ";
}

// On a line, with a spring of 64 N that comes and goes: the way that makes the inequalities of the bound's proof equalities, so
// that it comes nearest to the bound. With w = 0 it is (1 + q)/q times νs, with w = 1 it is -(1 + q)/q times (-(1 + q)/α from α
// = 1/2 on).
Path nearest_to_the_bound(float share, int ticks) {
  Path path{{.rate = 1000, .share = share, .damping = 0x1p-9F, .most = HUGE_VALF}, {}};
  const double alpha = static_cast<double>(share), q = 1 - alpha;
  double place = 0, velocity = 0;
  const auto go = [&](bool has_spring, double way) {
    path.steps.push_back({{0, 0, static_cast<float>(place)}, {0, 0, has_spring ? 64.0F : 0.0F}});
    place += way;
    velocity = q * velocity + alpha * way;
  };
  go(false, 0.01);
  for (int tick = 0; tick < ticks; ++tick) {
    if (alpha >= 0.5)
      go(true, -(1 + q) / alpha * velocity);
    else if (velocity > 0.002)
      go(true, -(1 + q) / q * velocity);
    else
      go(false, (1 + q) / q * velocity);
  }
  go(false, 0);
  return path;
}

std::string words(const char* fault, const Step& step, const Eigen::Vector3f& force) {
  return std::string(fault) + " at " + show(step.position) + " mm: spring " + show(step.spring) + " N, damped " + show(force) +
         " N";
}

// judge(step, damping after it, damped force): a fault, or nothing.
template <class Judge>
Violation along(const Path& path, const Judge& judge) {
  auto damping = std::get<fast::Damping>(fast::Damping::build(path.parameters));
  for (const Step& step : path.steps) {
    const fast::Evaluation damped = damping.tick(step.position, 1, {step.spring, Status::contact, {}, step.limits});
    if (const char* fault = judge(step, damping.state(), damped.force)) return words(fault, step, damped.force);
  }
  return std::nullopt;
}

void expect_property(const char* name, const std::function<Violation(const Path&)>& holds) {
  const auto cases = static_cast<int>(tests::drawn(4000));
  const properties::PropertyResult result =
      tests::run_with_rapidcheck(name, cases, 11, [&](properties::Chooser& choose) { return holds(choose(damped_paths())); });
  EXPECT_TRUE(result.held) << result.counterexample;
}

TEST(damping_properties, it_never_pulls_and_never_turns_the_force) {
  int let_go = 0, longest = 0;
  expect_property("never pulls", [&](const Path& path) {
    const Parameters& p = path.parameters;
    return along(path, [&](const Step& step, const damping::State&, const Eigen::Vector3f& force) -> const char* {
      const Eigen::Vector3f &f = step.spring, &F = force;
      let_go += force.isZero(0) && !step.spring.isZero(0);
      if (product(rational(F), rational(f)) < -rounding(rational(F), rational(f))) return "it pulls";
      if (p.drag > 0) return nullptr;
      if ((F.array() * f.array() < 0).any()) return "it pulls along an axis";
      if (!std::isinf(p.most)) {
        const float most = p.most * step.spring.cwiseAbs().maxCoeff(), largest = force.cwiseAbs().maxCoeff();
        longest += largest == most && most > 0;
        if (largest > most) return "it is more than S times as long";
      }
      // Across the spring: only what rounding leaves.
      for (Eigen::Index i = 0; i < 3; ++i) {
        const Eigen::Index j = (i + 1) % 3;
        const mpq_class one = rational(F[i]) * rational(f[j]), other = rational(F[j]) * rational(f[i]), turned = one - other;
        if (abs(turned) > (abs(one) + abs(other)) * mpq_class(0x1.01p-24) + mpq_class(0x1p-140)) return "it turns";
      }
      return nullptr;
    });
  });
  EXPECT_GT(let_go, 0);
  EXPECT_GT(longest, 0);
}

TEST(damping_properties, it_rests_where_the_hand_rests) {
  int most_ticks = 0;
  expect_property("rests", [&](const Path& path) -> Violation {
    auto damping = std::get<fast::Damping>(fast::Damping::build(path.parameters));
    for (const Step& step : path.steps) damping.tick(step.position, 1, {step.spring, Status::contact});
    const Step last{path.steps.back().position, Eigen::Vector3f(0.3F, -0.1F, 0.7F)};
    // |v| is below 2^20 mm/s, and a tick takes the share α of it: ln(2^40)/α ticks, and a few for roundings.
    const int ticks = static_cast<int>(28 / path.parameters.share) + 3;
    for (int tick = 0; tick < ticks; ++tick) {
      const Eigen::Vector3f force = damping.tick(last.position, 1, {last.spring, Status::contact}).force;
      if (damping.state().velocity != std::array<float, 3>{}) continue;
      most_ticks = std::max(most_ticks, tick);
      if (force != last.spring) return words("it does not rest", last, force);
      return std::nullopt;
    }
    return "the velocity does not come to 0";
  });
  EXPECT_GT(most_ticks, 100);
}

TEST(damping_properties, it_dissipates_at_its_own_velocity) {
  expect_property("dissipates", [](const Path& path) { return dissipates_at_its_own_velocity(path); });
}

TEST(damping_properties, sampling_gives_no_more_than_the_bound) {
  expect_property("sampling", [](const Path& path) { return sampling_gives_at_most_the_bound(path); });
}

TEST(damping_properties, paths_come_near_the_bound_of_sampling) {
  for (const float share : {1.0F, 0.5F, 0.25F, 0.1F}) {
    const Sampled sum = sampled(nearest_to_the_bound(share, 2000));
    const double ratio = mpq_class(sum.given / sum.bound).get_d();
    std::printf("share %g: %.4f of the bound\n", static_cast<double>(share), ratio);
    EXPECT_TRUE(sum.given <= sum.bound + sum.rounding) << share;
    EXPECT_GT(ratio, 0.95) << share;
  }
}

// The same where faces that do not damp take the place of springs that are gone.
TEST(damping_properties, faces_come_as_near_the_bound_of_sampling) {
  for (const float share : {1.0F, 0.5F, 0.25F, 0.1F}) {
    Path path = nearest_to_the_bound(share, 2000);
    const Sampled of_springs = sampled(path);
    for (Step& step : path.steps)
      if (step.spring.isZero(0)) step = {step.position, {0, 0, 64}, {0, 0}};
    const Sampled sum = sampled(path);
    EXPECT_TRUE(sum.given == of_springs.given) << share;
    EXPECT_FALSE(sampling_gives_at_most_the_bound(path)) << share;
  }
}

TEST(damping_properties, the_factor_of_the_bound_is_that_of_the_page) {
  for (const auto& [share, factor] : {std::pair{1.0, 1.0}, {0.5, 1.0 / 3}, {0.25, 4.0 / 21}, {0.1, 25.0 / 171}})
    EXPECT_NEAR(damping::sampling_factor(share), factor, 1e-15) << share;
}

// The rows are those at which binary64 alone rounds to the other side.
TEST(damping_properties, the_share_of_a_time_constant_is_the_nearest_number) {
  std::vector<std::array<float, 3>> cases{{5998, 0x1.50bb42p-11F, 0x1.a6115ap-3F},
                                          {7374, 0x1.7a802p-11F, 0x1.43deaap-3F},
                                          {294, 0x1.cd57c6p-9F, 0x1.f73da2p-2F},
                                          {500, 0.002F, 0.5F}};
  std::mt19937 draw(54);
  for (int i = 0; i < 10'000; ++i) {
    const float rate = static_cast<float>(1 + draw() % 131072), time = std::ldexp(static_cast<float>(draw() | 1U), -40);
    cases.push_back({rate, time, damping::share_of(rate, time)});
  }
  for (const auto& [rate, time, share] : cases) {
    EXPECT_EQ(damping::share_of(rate, time), share);
    const mpq_class exact = 1 / (1 + rational(rate) * rational(time));
    const auto off = [&](float other) { return mpq_class(abs(exact - rational(other))); };
    EXPECT_TRUE(off(share) <= off(std::nextafter(share, 0.0F)) && off(share) <= off(std::nextafter(share, 2.0F)))
        << rate << " Hz, " << time << " s";
  }
}

// A damper with other parameters than it says.
OpenDamper with(const std::function<void(Parameters&)>& change) {
  return [change](Parameters p) {
    change(p);
    return own_damper(p);
  };
}

bool is_broken(const std::function<Violation(const Path&)>& holds) {
  return !tests::run_with_rapidcheck("mutant", 2000, 11, [&](properties::Chooser& choose) {
            return holds(choose(damped_paths()));
          }).held;
}

TEST(damping_properties, a_damper_that_is_a_little_stronger_breaks_them) {
  const auto stronger = with([](Parameters& p) {
    p.damping *= 1.01F;
    p.drag *= 1.01F;
  });
  EXPECT_TRUE(is_broken([&](const Path& path) { return dissipates_at_its_own_velocity(path, stronger); }));
  EXPECT_TRUE(sampling_gives_at_most_the_bound(nearest_to_the_bound(1, 2000), stronger));
}

// B and B_t of the face, where they are more than those of the path.
TEST(damping_properties, a_damper_of_the_larger_one_of_face_and_path_breaks_them) {
  const OpenDamper larger = [](const Parameters& p) -> Damper {
    return [p, before = damping::State()](const Step& step) mutable {
      Parameters its = p;
      if (std::isfinite(step.limits.damping)) its.damping = std::max(p.damping, step.limits.damping);
      if (std::isfinite(step.limits.drag)) its.drag = std::max(p.drag, step.limits.drag);
      auto one = std::get<fast::Damping>(fast::Damping::build(its));
      one.resume(before);
      const Eigen::Vector3f force = one.tick(step.position, 1, {step.spring, Status::contact}).force;
      before = one.state();
      return Answer{force, Eigen::Vector3f(before.velocity.data())};
    };
  };
  EXPECT_TRUE(is_broken([&](const Path& path) { return dissipates_at_its_own_velocity(path, larger); }));
  Path path = nearest_to_the_bound(1, 2000);
  for (Step& step : path.steps) step.limits = {1.01F * path.parameters.damping, HUGE_VALF};
  EXPECT_FALSE(sampling_gives_at_most_the_bound(path));
  EXPECT_TRUE(sampling_gives_at_most_the_bound(path, larger));
}

TEST(damping_properties, a_damper_with_other_shares_breaks_the_bound) {
  for (const float share : {0.5F, 0.25F, 0.1F})
    EXPECT_TRUE(
        sampling_gives_at_most_the_bound(nearest_to_the_bound(share, 2000), with([](Parameters& p) { p.share *= 1.05F; })))
        << share;
}

// Along a velocity that is not its own.
TEST(damping_properties, a_damper_of_the_velocity_before_breaks_them) {
  const OpenDamper late = [](const Parameters& p) -> Damper {
    return [damper = own_damper(p), last = Step()](const Step& step) mutable {
      const Answer answer = damper({last.position, step.spring, step.limits}),
                   now{answer.force, (step.position - last.position) * 1000};
      last = step;
      return now;
    };
  };
  EXPECT_TRUE(is_broken([&](const Path& path) { return dissipates_at_its_own_velocity(path, late); }));
}

}  // namespace
}  // namespace forceshade
