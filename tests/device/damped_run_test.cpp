// SPDX-License-Identifier: BSD-3-Clause
// A certified run with damping: what its recording and its summary keep.

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>

#include "forceshade/recording.h"
#include "forceshade/run.h"
#include "run/recorder/settings.h"
#include "run/summary.h"
#include "run/words.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::run {
namespace {

using nlohmann::ordered_json;

// At the loop's rate, wherever run() is called: the window of the mouse does, too.
TEST(run, is_damped_as_its_rendering_says_and_its_record_and_summary_say_so) {
  const tests::TemporaryDirectory directory;
  const std::atomic<bool> go_on = false;
  const auto wall = std::get<Rendering>(rendering_of(LawId::wall, {.stiffness = 0.5F}));
  Rendering damped = wall;
  damped.damping = {{.damping = 0.002F, .drag = 0.5F, .full_at = 0.5F}, 0.002F};
  Plan plan;
  plan.record = directory.file("damped.fsr");
  plan.servo = {.rate_hz = 500, .paced = false};
  device::Replay device({{{0, 0, -0.1F}, 0}, {{0, 0, -1}, 0.1}});
  const Outcome outcome = run(device, damped, plan, go_on);
  const damping::Parameters expected{.rate = 500, .share = 0.5F, .damping = 0.002F, .drag = 0.5F, .full_at = 0.5F};
  EXPECT_EQ(outcome.result.damping, expected);
  const recorder::Metadata metadata = recorder::Recording(plan.record).metadata();
  EXPECT_EQ(recorder::damping_in(metadata, "its"), expected);
  recorder::Metadata other = metadata;
  for (const std::string rate : {"250", "1000"}) {
    other["damping_rate_hz"] = rate;
    tests::expect_words(tests::thrown_by<Error>([&] { recorder::damping_in(other, "its"); }),
                        {"its: damping_rate_hz is " + rate + "; expected the rate of the run, 500"});
  }
  other = metadata;
  other["damping_most"] = "0.5";
  tests::expect_words(tests::thrown_by<Error>([&] { recorder::damping_in(other, "its"); }), {"its: damping: most is 0.5"});
  EXPECT_EQ(words_of(expected),
            "0.002 N s/mm along the force, up to 2 times it; drag of 0.5 N s/mm, full at 0.5 N; share 0.5 at 500 Hz");
  const ordered_json json = summary(outcome, damped, plan, device.capabilities());
  EXPECT_EQ(json["damping"]["share"], 0.5);
  EXPECT_EQ(json["damping"]["drag_N_s_per_mm"], 0.5);
  // That of the loop's options, where the rendering has none; and nothing without either.
  plan.servo.damping.drag = 0.25F;
  EXPECT_EQ(damping_of(wall, plan.servo), (damping::Parameters{.rate = 500, .drag = 0.25F}));
  EXPECT_FALSE(summary({}, wall, {}, {}).contains("damping"));
  EXPECT_EQ(recorder::damping_in({}, "its"), std::nullopt);
  EXPECT_TRUE(recorder::metadata_of(damping::Parameters{.rate = 500}).empty());
}

}  // namespace
}  // namespace forceshade::run
