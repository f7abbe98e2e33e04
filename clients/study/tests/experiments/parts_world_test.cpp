// SPDX-License-Identifier: BSD-3-Clause
// The parts of a recording in a simulated world: somebody begins parts while a loop pushes.

#include "study/apparatus/parts.h"
#include "tests/recorder/world_run.h"

namespace forceshade::apparatus {
namespace {

using namespace recorder;

constexpr int kParts = 4;

WorldRun run_of(int parts, std::uint64_t ticks = 200) {
  return {parts, ticks, [parts](WorldRun& run) {
            Parts written({.ring = 64});
            written.begin(run.path(1), {});
            FaultyDisk::sync_ms = 3;
            system::Thread person("person", [&] {
              for (int part = 2; part <= parts; ++part) {
                system::sleep_for(std::chrono::milliseconds(40));
                written.begin(run.path(part), {});
              }
            });
            run.push_into(written);
            person.join();
            written.end("time up");
          }};
}

TEST(parts_world, a_death_at_any_step_leaves_every_tick_but_those_of_the_last_100_ms) {
  WorldRun run = run_of(kParts);
  expect_kept_at_each_death(run);
}

TEST(parts_world, random_holds_cost_no_tick) {
  Plan plan;
  plan.schedule = {.holds = 0.02, .changes = 0.05};
  expect_kept("parts", random_sessions(50, plan, [](const Plan& its) { return run_of(kParts).run(its); }));
}

// The first part gives way to the second, and is closed, which takes some hundred steps.
TEST(parts_world, no_hold_where_a_part_begins_costs_a_tick) {
  std::vector<world::Fault> holds;
  for (long steps = 2; steps <= 512; steps *= 4)
    holds.push_back({"a hold of " + std::to_string(steps) + " steps of the others",
                     [steps](World& world, world::Arm&) { world.hold_for_steps(world.running(), steps); }});
  const auto session = [](const Plan& plan) { return run_of(2, 80).run(plan); };
  expect_kept("begin", placed_anew(holds, {64 * kMillisecond, 36}, {}, session));
}

}  // namespace
}  // namespace forceshade::apparatus
