// SPDX-License-Identifier: BSD-3-Clause
#include "tests/recorder/world_run.h"

namespace forceshade::recorder {
namespace {

void write_one(WorldRun& run) {
  Recorder recorder(run.path(1), {{"law", "wall"}}, {.ring = 64});
  FaultyDisk::sync_ms = 500;
  run.push_into(recorder);
  const auto [written, lost, error] = recorder.close("time up");
  if (written != run.ticks() || lost != 0 || !error.empty()) run.violate(7, "lost " + std::to_string(lost) + ": " + error);
}

TEST(recorder_world, a_death_at_any_step_leaves_every_tick_but_those_of_the_last_100_ms) {
  WorldRun run(1, 200, write_one);
  expect_kept_at_each_death(run);
}

TEST(recorder_world, random_holds_cost_no_tick) {
  Plan plan;
  plan.schedule = {.holds = 0.02, .changes = 0.05};
  expect_kept("recorder", random_sessions(30, plan, [](const Plan& its) { return WorldRun(1, 200, write_one).run(its); }));
}

}  // namespace
}  // namespace forceshade::recorder
