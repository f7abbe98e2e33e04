// SPDX-License-Identifier: BSD-3-Clause
// The deviation that each invariant of a simulator's steps allows: an exact motion is changed in one thing, by a hundredth
// less than what is allowed and by a hundredth more.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "properties/conformance/simulators/invariants_of_steps.h"
#include "properties/conformance/simulators/simulator_process.h"
#include "tests/conformance/own_simulator.h"
#include "tests/support/has.h"

namespace forceshade::conformance::simulators {
namespace {

using Motions = Run;  // gtest has a Run of its own
using Constraint = SimulatorCapabilities::Constraint;

constexpr std::size_t kStep = 100, kInTheAir = 20;
constexpr double kWeight = 9.81, kLoad = 19.81;  // N: of 1 kg, and pressed with 10 N

Felt felt(const std::string& name, const Motions& run, std::size_t k) {
  static const std::vector<StepInvariant> all = step_invariants();
  const auto its = std::ranges::find_if(all, [&](const StepInvariant& each) { return each.name == name; });
  EXPECT_NE(its, all.end()) << name;
  return its->felt(run, k);
}

struct Change {
  const char* invariant;
  const Course& course;
  double allowed;  // in the unit of what is changed
  std::function<void(Run&, double by)> by;
  const char* words;  // of a hundredth more
  std::size_t step = kStep;
};

TEST(felt_steps, are_within_what_is_allowed_or_beyond_it) {
  const OpenSimulator open = own_simulator();
  const Course slide = slides().front(), rest = rests().front(), drop = drops().front();  // on a box
  const std::size_t last = slide.steps;
  const auto sinks = [](Constraint constraint, std::size_t step) {
    return [=](Motions& run, double by) {
      run.simulator.constraint = constraint;
      run.states[step].position.z() -= by;
    };
  };
  const auto pushed_at = [](double before, double now) {
    return [=](Motions& run, double by) {
      run.states[kInTheAir - 1].position.z() = run.course.scene.radius + before;
      run.states[kInTheAir].position.z() = run.course.scene.radius + now;
      run.states[kInTheAir].contacts = {{Vector3d::UnitZ(), by}};
    };
  };
  const char *kSunk = "nothing sinks into the ground or passes through it", *kEnergy = "there is no energy out of nothing",
             *kSpeed = "a flat floor keeps the speed, however it is triangulated", *kAir = "there is no force out of contact";
  // At 1 m/s a step of 1/240 s is 1/240 m long, and the kinetic energy is 1/2 J.
  const double sunk = 0.001 + 1.0 / 240, raised = (0.0201 / 2 + 0.001 * kLoad) / kLoad;
  const std::vector<Change> changes{
      {kSunk, slide, sunk, sinks(Constraint::hard, kStep), "5.218 mm in the ground, allowed 5.167 mm"},
      {kSunk, slide, sunk, sinks(Constraint::hard, last), "in the ground", last},
      {kSunk, slide, sunk, sinks(Constraint::soft, last), "in the ground", last},
      {kSunk, slide, sunk, sinks(Constraint::penalty, last), "in the ground", last},
      {kEnergy, slide, raised, [](Motions& run, double by) { run.states[kStep].position.z() += by; },
       "30.16 mJ out of nothing, allowed 29.86 mJ"},
      {kEnergy, slide, raised,
       [](Motions& run, double by) {
         for (State& state : std::span(run.states).subspan(1)) state.position.z() += by;
       },
       "30.16 mJ out of nothing"},
      {kSpeed, slide, 0.01, [](Motions& run, double by) { run.states[kStep].velocity.x() += by; },
       "1.01 m/s instead of 1 m/s, a gain of 10.15 mJ"},
      {kSpeed, slide, 0.01, [](Motions& run, double by) { run.states[kStep].velocity.x() -= by; }, "a loss of 10.05 mJ"},
      {"the normals that are reported on a flat floor are its own", slide, 0.01,
       [](Motions& run, double by) { run.states[kStep].contacts.front().normal = Vector3d(std::sin(by), 0, std::cos(by)); },
       "0.5787 degrees off"},
      {"a sphere at rest stays at rest", rest, 0.001,
       [](Motions& run, double by) {
         for (State& state : std::span(run.states).subspan(1)) state.position.y() += by;
       },
       "1.01 mm moved at rest, allowed 1 mm"},
      {kAir, drop, 0.01 * kWeight, pushed_at(0.00101, 0.00101), "N in the air, as it reports", kInTheAir}};
  for (const Change& change : changes)
    for (const double share : {0.99, 1.01}) {
      Bench bench(open);
      Motions run = bench.run_anew(change.course);
      change.by(run, share * change.allowed);
      const Felt its = felt(change.invariant, run, change.step);
      EXPECT_EQ(its.value > its.allowed, share > 1) << change.invariant << ": " << its.words;
      EXPECT_TRUE(share < 1 || tests::has(its.words, change.words)) << its.words;
    }
  // A step that begins or ends in contact, or no more than 1 mm above it, may have a force.
  for (const auto& [before, now] : {std::pair(0.00099, 0.002), {0.002, 0.00099}, {0.00099, 0.00099}}) {
    Motions run = Bench(open).run_anew(drop);
    pushed_at(before, now)(run, kLoad);
    EXPECT_EQ(felt(kAir, run, kInTheAir).value, 0);
  }
  // A body that gives way is looked at where it ends.
  for (const Constraint constraint : {Constraint::soft, Constraint::penalty}) {
    Motions run = Bench(open).run_anew(slide);
    sinks(constraint, kStep)(run, 0.05);
    EXPECT_EQ(felt(kSunk, run, kStep).value, 0);
  }
}

// A simulator's own units and its impulse become m and N.
TEST(felt_steps, are_read_in_the_units_of_the_scene) {
  using Reports = SimulatorCapabilities::Reports;
  const auto said = nlohmann::ordered_json::parse(
      R"({"motion": [{"position": [1000, 0, 500], "velocity": [0, 250, 0], "contacts": [[0, 0, 1, 5]]}]})");
  Simulation scene;
  scene.units_per_metre = 1000;
  for (const auto& [reports, newtons] : {std::pair(Reports::force, 0.005), {Reports::impulse, 1.2}}) {
    const Motion motion = motion_in(said, reports, scene, 1);
    ASSERT_EQ(motion.states.size(), 1U);
    EXPECT_EQ(motion.states[0].position, Vector3d(1, 0, 0.5));
    EXPECT_EQ(motion.states[0].velocity, Vector3d(0, 0.25, 0));
    EXPECT_DOUBLE_EQ(motion.states[0].contacts.at(0).force, newtons);
    EXPECT_EQ(motion.states[0].contacts.at(0).normal, Vector3d(0, 0, 1));
  }
}

TEST(felt_steps, are_none_of_a_course_beyond_what_a_simulator_declares) {
  for (const auto& [radius, cap, refusal] : {std::tuple(0.1, 1.0, ""),
                                             {0.101, 1.0, "its smallest radius is 0.101 m"},
                                             {0.1, 0.99, "its largest speed is 0.99 m/s"}}) {
    const OpenSimulator open = own_simulator({.smallest_radius = radius, .speed_cap = cap});
    EXPECT_EQ(Bench(open).run_anew(slides().front()).refusal.value_or(""), refusal);
  }
}

}  // namespace
}  // namespace forceshade::conformance::simulators
