// SPDX-License-Identifier: BSD-3-Clause
// The properties of docs/damping.md on random paths, which RapidCheck draws and makes simpler; the paths that come nearest to
// the bound of sampling; and dampers that just break each.

#include "properties/damping_properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "forceshade/fast.h"
#include "tests/support/drawn.h"
#include "tests/support/with_rapidcheck.h"

namespace forceshade {
namespace {

using damping::Parameters;
using Step = properties::DampedStep;
using Path = properties::DampedPath;

mpq_class exactly(float a) {
  return static_cast<double>(a);
}
mpq_class dot(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return exactly(a.x()) * exactly(b.x()) + exactly(a.y()) * exactly(b.y()) + exactly(a.z()) * exactly(b.z());
}

std::string words(const char* fault, const Step& step, const Eigen::Vector3f& force) {
  const auto text = [](const Eigen::Vector3f& a) {
    return "(" + std::to_string(a.x()) + ", " + std::to_string(a.y()) + ", " + std::to_string(a.z()) + ")";
  };
  return std::string(fault) + " at " + text(step.position) + " mm: spring " + text(step.spring) + " N, damped " + text(force) +
         " N";
}

// judge(step, damping after it, damped force): a fault, or nothing.
template <class Judge>
properties::Violation along(const Path& path, const Judge& judge) {
  auto damping = std::get<fast::Damping>(fast::Damping::build(path.parameters));
  for (const Step& step : path.steps) {
    const fast::Evaluation damped = damping.tick(step.position, 1, {step.spring, Status::contact, {}, step.limits});
    if (const char* fault = judge(step, damping.state(), damped.force)) return words(fault, step, damped.force);
  }
  return std::nullopt;
}

void expect_property(const char* name, const std::function<properties::Violation(const Path&)>& holds) {
  const auto cases = static_cast<int>(tests::drawn(4000));
  const properties::PropertyResult result = tests::run_with_rapidcheck(
      name, cases, 11, [&](properties::Chooser& choose) { return holds(choose(properties::damped_paths())); });
  EXPECT_TRUE(result.held) << result.counterexample;
}

TEST(damping_properties, it_never_pulls_and_never_turns_the_force) {
  int let_go = 0, longest = 0;
  expect_property("never pulls", [&](const Path& path) {
    const Parameters& p = path.parameters;
    return along(path, [&](const Step& step, const damping::State&, const Eigen::Vector3f& force) -> const char* {
      const Eigen::Vector3f &f = step.spring, &F = force;
      let_go += force.isZero(0) && !step.spring.isZero(0);
      if (dot(F, f) < -properties::rounding_along(F, f)) return "it pulls";
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
        const mpq_class one = exactly(F[i]) * exactly(f[j]), other = exactly(F[j]) * exactly(f[i]), turned = one - other;
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
  expect_property("rests", [&](const Path& path) -> properties::Violation {
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
  expect_property("dissipates", [](const Path& path) { return properties::dissipates_at_its_own_velocity(path); });
}

TEST(damping_properties, sampling_gives_no_more_than_the_bound) {
  expect_property("sampling", [](const Path& path) { return properties::sampling_gives_at_most_the_bound(path); });
}

TEST(damping_properties, paths_come_near_the_bound_of_sampling) {
  for (const float share : {1.0F, 0.5F, 0.25F, 0.1F}) {
    const properties::Sampled sum = properties::sampled(properties::nearest_to_the_bound(share, 2000));
    const double ratio = mpq_class(sum.given / sum.bound).get_d();
    std::printf("share %g: %.4f of the bound\n", static_cast<double>(share), ratio);
    EXPECT_TRUE(sum.given <= sum.bound + sum.rounding) << share;
    EXPECT_GT(ratio, 0.95) << share;
  }
}

// The same where faces that do not damp take the place of springs that are gone.
TEST(damping_properties, faces_come_as_near_the_bound_of_sampling) {
  for (const float share : {1.0F, 0.5F, 0.25F, 0.1F}) {
    Path path = properties::nearest_to_the_bound(share, 2000);
    const properties::Sampled of_springs = properties::sampled(path);
    for (Step& step : path.steps)
      if (step.spring.isZero(0)) step = {step.position, {0, 0, 64}, {0, 0}};
    const properties::Sampled sum = properties::sampled(path);
    EXPECT_TRUE(sum.given == of_springs.given) << share;
    EXPECT_FALSE(properties::sampling_gives_at_most_the_bound(path)) << share;
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
    const mpq_class exact = 1 / (1 + exactly(rate) * exactly(time));
    const auto off = [&](float other) { return mpq_class(abs(exact - exactly(other))); };
    EXPECT_TRUE(off(share) <= off(std::nextafter(share, 0.0F)) && off(share) <= off(std::nextafter(share, 2.0F)))
        << rate << " Hz, " << time << " s";
  }
}

// A damper with other parameters than it says.
properties::OpenDamper with(const std::function<void(Parameters&)>& change) {
  return [change](Parameters p) {
    change(p);
    return properties::own_damper(p);
  };
}

bool is_broken(const std::function<properties::Violation(const Path&)>& holds) {
  return !tests::run_with_rapidcheck("mutant", 2000, 11, [&](properties::Chooser& choose) {
            return holds(choose(properties::damped_paths()));
          }).held;
}

TEST(damping_properties, a_damper_that_is_a_little_stronger_breaks_them) {
  const auto stronger = with([](Parameters& p) {
    p.damping *= 1.01F;
    p.drag *= 1.01F;
  });
  EXPECT_TRUE(is_broken([&](const Path& path) { return properties::dissipates_at_its_own_velocity(path, stronger); }));
  EXPECT_TRUE(properties::sampling_gives_at_most_the_bound(properties::nearest_to_the_bound(1, 2000), stronger));
}

// B and B_t of the face, where they are more than those of the path.
TEST(damping_properties, a_damper_of_the_larger_one_of_face_and_path_breaks_them) {
  const properties::OpenDamper larger = [](const Parameters& p) -> properties::Damper {
    return [p, before = damping::State()](const Step& step) mutable {
      Parameters its = p;
      if (std::isfinite(step.limits.damping)) its.damping = std::max(p.damping, step.limits.damping);
      if (std::isfinite(step.limits.drag)) its.drag = std::max(p.drag, step.limits.drag);
      auto one = std::get<fast::Damping>(fast::Damping::build(its));
      one.resume(before);
      const Eigen::Vector3f force = one.tick(step.position, 1, {step.spring, Status::contact}).force;
      before = one.state();
      return properties::DampedAnswer{force, Eigen::Vector3f(before.velocity.data())};
    };
  };
  EXPECT_TRUE(is_broken([&](const Path& path) { return properties::dissipates_at_its_own_velocity(path, larger); }));
  Path path = properties::nearest_to_the_bound(1, 2000);
  for (Step& step : path.steps) step.limits = {1.01F * path.parameters.damping, HUGE_VALF};
  EXPECT_FALSE(properties::sampling_gives_at_most_the_bound(path));
  EXPECT_TRUE(properties::sampling_gives_at_most_the_bound(path, larger));
}

TEST(damping_properties, a_damper_with_other_shares_breaks_the_bound) {
  for (const float share : {0.5F, 0.25F, 0.1F})
    EXPECT_TRUE(properties::sampling_gives_at_most_the_bound(properties::nearest_to_the_bound(share, 2000),
                                                             with([](Parameters& p) { p.share *= 1.05F; })))
        << share;
}

// Along a velocity that is not its own.
TEST(damping_properties, a_damper_of_the_velocity_before_breaks_them) {
  const properties::OpenDamper late = [](const Parameters& p) -> properties::Damper {
    return [damper = properties::own_damper(p), last = Step()](const Step& step) mutable {
      const properties::DampedAnswer answer = damper({last.position, step.spring, step.limits}),
                                     now{answer.force, (step.position - last.position) * 1000};
      last = step;
      return now;
    };
  };
  EXPECT_TRUE(is_broken([&](const Path& path) { return properties::dissipates_at_its_own_velocity(path, late); }));
}

}  // namespace
}  // namespace forceshade
