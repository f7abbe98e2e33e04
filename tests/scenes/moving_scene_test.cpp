// SPDX-License-Identifier: BSD-3-Clause
// A scene whose objects move as a subject: both sides along its motions, its properties, and renderers that they find wrong.

#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "device/null.h"
#include "forceshade/run.h"
#include "properties/scene_subject.h"
#include "properties/world_step.h"
#include "tests/scenes/random_scene.h"
#include "tests/support/words.h"

namespace forceshade {
namespace {

using tests::law, tests::random_scene;

TEST(moving_scene, has_the_properties_by_which_it_is_certified) {
  tests::MeshSource source(5);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto subject = properties::scene_subject("random.toml", random_scene(source, seed));
    for (const properties::PropertyResult& result : run_properties(*subject, 30, seed))
      EXPECT_TRUE(result.held) << seed << ", " << result.name << ": " << result.counterexample;
  }
}

TEST(moving_scene, is_the_reference_in_every_bit_along_its_motions) {
  tests::MeshSource source(6);
  int touching = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const auto given = properties::scene_subject("random.toml", random_scene(source, seed));
    const auto drawn = given->with_drawn_parameters(seed);
    for (const properties::Subject* subject : {given.get(), drawn.subject.get()}) {
      const auto session = subject->renderer().open();
      const auto reference = subject->open_reference();
      const auto positions = subject->positions(seed);
      for (int tick = 0; tick < 200; ++tick) {
        const Eigen::Vector3f position = positions->next().position;
        const fast::Evaluation found = session->step(position);
        const reference::Rounded expected = reference->step(position);
        touching += found.status == Status::contact ? 1 : 0;
        ASSERT_EQ(found.status, expected.status);
        ASSERT_EQ(found.force, expected.force) << "scene " << seed << ", tick " << tick << drawn.parameters;
      }
    }
  }
  EXPECT_GT(touching, 200);
}

TEST(moving_scene, draws_the_tick_in_which_a_path_begins) {
  scene::Motion rising{{}, false};
  for (int tick = 0; tick < 40; ++tick) rising.poses.push_back({{0, 0, static_cast<float>(tick)}, {1, 0, 0, 0}});
  for (const bool repeats : {false, true}) {
    rising.repeats = repeats;
    DescribedScene scene{{}, 1000, 0.5F};
    scene.objects.push_back({"wall", law(LawId::wall), rising});
    const auto subject = properties::scene_subject("wall.toml", scene);
    std::set<float> first;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const auto drawn = subject->with_drawn_parameters(seed);
      const auto session = drawn.subject->renderer().open();
      // They are K (tick + 1) and K (tick + 2), whatever K is.
      const float one = session->step({0, 0, -1}).force.z(), other = session->step({0, 0, -1}).force.z();
      first.insert(other / one);
      EXPECT_TRUE(drawn.parameters.starts_with("from tick ")) << drawn.parameters;
    }
    EXPECT_GT(first.size(), 15U) << "of 40 ticks";
  }
}

// Finds the renderer that turns the force into the object's axes once more instead of back into the world's.
TEST(moving_scene, does_the_work_of_its_objects_and_motions) {
  const scene::Pose now{{0, 0, 1}, {1, 0, 0.5F, 0}}, next{{0, 0.25F, 1}, {1, 0, 0.5F, 0}};
  const Eigen::Vector3f from(0, 0, 0), to(0.125F, 0.5F, -0.25F);
  const Eigen::Vector3f seen = reference::seen_from(now, from).value(), seen_next = reference::seen_from(next, to).value();
  const std::array motions{scene::Motion{{now, next}, false}};
  DescribedScene scene{{}, 1000, 0.5F};
  scene.objects.push_back({"wall", law(LawId::wall), motions[0]});
  const auto subject = properties::scene_subject("wall.toml", scene);
  const Eigen::Vector3f force = subject->renderer().open()->step(from).force;
  const Eigen::Vector3f alone(0, 0, -0.5F * seen.z());
  ASSERT_GT(alone.z(), 0.1F);
  const auto account = [&](const scene::Pose& said_next) {
    properties::WorkOfTick work(from, to);
    work.add({now, said_next, seen, seen_next, alone});
    return work;
  };
  EXPECT_EQ(account(next).difference_from(force), std::nullopt);
  const auto wrong_axes = account(next).difference_from({-force.x(), force.y(), force.z()});
  ASSERT_TRUE(wrong_axes);
  EXPECT_NE(wrong_axes->find("mJ on the hand; the objects and their motions do"), std::string::npos) << *wrong_axes;
  EXPECT_TRUE(account(next).difference_from(1.00001F * force));
  EXPECT_TRUE(account(next).difference_from({0, 0, 0}));
}

TEST(moving_scene, is_driven_at_its_rate_alone) {
  DescribedScene scene{{}, 500, 0.5F};
  scene.objects.push_back({"wall", law(LawId::wall), {}});
  const auto rendering = tests::built(rendering_of("wall.toml", scene));
  device::Null device;
  run::Plan plan;
  plan.device = "null";
  plan.servo.paced = false;
  plan.servo.max_seconds = 0.02;
  const std::atomic<bool> stop = false;
  EXPECT_EQ(tests::thrown_by<std::runtime_error>([&] { run::run(device, rendering, plan, stop); }),
            "the rate of the loop: expected 500 Hz, for which the motions of wall.toml are made, got 1000");
  plan.servo.rate_hz = 500;
  EXPECT_EQ(run::run(device, rendering, plan, stop).result.ticks, 10U);
}

}  // namespace
}  // namespace forceshade
