// SPDX-License-Identifier: BSD-3-Clause
// The servo loop with damping behind its session: forces, periods, work, and what is refused.

#include <gtest/gtest.h>

#include <bit>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "device/damped_work.h"
#include "forceshade/damped.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

using Exact = boost::multiprecision::mpq_rational;
using tests::vector;

constexpr damping::Parameters kOil{.rate = 1000, .share = 0.25F, .damping = 0.002F, .most = 3, .drag = 0.001F};

// A hand that trembles in and out of the wall, drawn once.
std::vector<Eigen::Vector3f> trembling() {
  std::mt19937 draw(54);
  std::vector<Eigen::Vector3f> path;
  for (int i = 0; i < 400; ++i) {
    const auto part = [&] { return static_cast<float>(draw() % 1000) / 4000; };
    path.emplace_back(part(), part(), part() - 0.2F);
  }
  return path;
}

TEST(damped_loop, answers_as_a_damped_session_and_splits_the_work) {
  auto path = trembling();
  path[200] = Eigen::Vector3f::Constant(std::nanf(""));
  Replay hand(path_of(path));
  ServoOptions options = unpaced();
  options.damping = kOil;
  options.damping.rate = 7;  // the loop's counts
  const Kept run(hand, wall(), options);
  ASSERT_EQ(run.ticks, path.size());
  EXPECT_EQ(run.damping, kOil);
  fast::DampedSession session(fast::session_of(wall()), std::get<fast::Damping>(fast::Damping::build(kOil)));
  DampedWork<Exact> work;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const fast::Evaluation expected = session.step(path[i]), spring = wall().evaluate(path[i]);
    EXPECT_EQ(vector(run.samples[i].law_force), expected.force) << i;
    EXPECT_EQ(run.samples[i].law_status(), expected.status) << i;
    EXPECT_EQ(run.samples[i].periods(), 1U) << i;
    changed += expected.force != spring.force;
    std::optional<DampedTick> tick;
    if (expected.status != Status::invalid) tick = {path[i], spring.force, expected.force, session.damping().state().velocity};
    work.add(tick, 1, kOil.rate);
  }
  EXPECT_GT(changed, 200U);
  const DampedEnergy& energy = run.damped_energy;
  EXPECT_NEAR(energy.spring, static_cast<double>(work.spring), 1e-12);
  EXPECT_NEAR(energy.damper, static_cast<double>(work.damper), 1e-12);
  EXPECT_NEAR(energy.sampling, static_cast<double>(work.sampling), 1e-12);
  EXPECT_LT(energy.damper, 0);
  EXPECT_GT(energy.sampling, 0);
  EXPECT_TRUE(std::isnan(energy.most)) << "a position is invalid";
  // The three are all of the force's work.
  Exact all = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    for (std::size_t c = 0; i != 200 && i != 201 && c < 3; ++c)
      all += Exact(double{run.samples[i - 1].law_force[c]}) *
             (Exact(double{run.samples[i].position[c]}) - Exact(double{run.samples[i - 1].position[c]}));
  EXPECT_EQ(all, work.spring + work.damper + work.sampling);
}

// The first tick has no way behind it, so it may come late.
TEST(damped_loop, bounds_the_work_of_even_ticks) {
  const auto at = [](float z) { return DampedTick{{0, 0, z}, {0, 0, 1}, {0, 0, 1}, {}}; };
  DampedWork<double> work;
  EXPECT_EQ(work.most(kOil), 0);
  work.add(at(0), 5, kOil.rate);
  work.add(at(0.5F), 1, kOil.rate);
  const double factor = 4.0 / 21 * static_cast<double>(kOil.damping) * static_cast<double>(kOil.rate);
  EXPECT_DOUBLE_EQ(work.most(kOil), factor / 4);
  damping::Parameters thick = kOil;
  thick.drag = 2 * kOil.damping;
  EXPECT_DOUBLE_EQ(work.most(thick), 2 * factor / 4);
  for (const std::uint32_t periods : {0U, 2U}) {
    DampedWork<double> uneven = work;
    uneven.add(at(0), periods, kOil.rate);
    EXPECT_TRUE(std::isnan(uneven.most(kOil))) << periods;
  }
}

TEST(damped_loop, splits_the_work_over_all_periods_to_the_next_tick) {
  DampedWork<double> work;
  work.add(DampedTick{{0, 0, 0}, {0, 0, 1}, {0, 0, 3}, {0, 0, 125}}, 1, 1000);
  work.add(DampedTick{{0, 0, 0.5F}, {0, 0, 1}, {0, 0, 1}, {}}, 3, 1000);
  EXPECT_EQ(work.spring, 0.5);
  EXPECT_EQ(work.damper, 2 * 0.375);
  EXPECT_EQ(work.sampling, 2 * 0.125);
}

TEST(damped_loop, damps_a_session_of_a_program_as_a_law) {
  const auto path = trembling();
  ServoOptions options = unpaced();
  options.damping = kOil;
  Replay hand(path_of(path)), again(path_of(path));
  const Kept alone(hand, wall(), options);
  EXPECT_LE(alone.damped_energy.damper + alone.damped_energy.sampling, alone.damped_energy.most);
  EXPECT_LE(alone.damped_energy.most, 10) << "mJ";
  const std::unique_ptr<fast::Session> session = fast::session_of(wall());
  tests::KeptSamples kept;
  options.sinks = {&kept};
  run_servo_loop(again, *session, options, kNeverStop);
  ASSERT_EQ(kept.samples.size(), alone.samples.size());
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_EQ(kept.samples[i].law_force, alone.samples[i].law_force) << i;
}

TEST(damped_loop, without_damping_has_no_trace_of_it) {
  Replay hand(path_of(trembling()));
  const Kept run(hand, wall(), unpaced());
  EXPECT_TRUE(run.damping.is_off());
  for (const Sample& sample : run.samples) EXPECT_EQ(sample.periods(), 0U);
  EXPECT_EQ(run.damped_energy.spring, 0);
}

TEST(damped_loop, refuses_parameters_out_of_their_ranges) {
  Endless device;
  for (const damping::Parameters& wrong :
       {damping::Parameters{.share = 0.0001F, .damping = 1}, {.damping = 17}, {.damping = 1, .most = 0.5F}, {.drag = -1}}) {
    ServoOptions options = unpaced();
    options.damping = wrong;
    EXPECT_THROW(run_servo_loop(device, wall(), options, kNeverStop), std::invalid_argument);
  }
}

}  // namespace
}  // namespace forceshade::device
