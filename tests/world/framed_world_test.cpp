// SPDX-License-Identifier: BSD-3-Clause
// The servo loop and a device whose frames a thread of ours makes, in a simulated world.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/world/framed_arm.h"
#include "tests/world/searches.h"

namespace forceshade::world {
namespace {

constexpr Ns kMillisecond = 1'000'000;
constexpr Ns kStart = 495 * kMillisecond, kContact = 900 * kMillisecond, kEnd = 1099 * kMillisecond;  // since the begin

void expect_kept(const char* what, const Found& found) {
  std::printf("%s: %ld sessions, %ld broke a rule; only an arm's watchdog could have ended a force within %.3f ms\n", what,
              found.tried, found.broken, found.without_watchdog);
  EXPECT_GT(found.tried, 0);
  EXPECT_EQ(found.broken, 0) << found.first;
}

TEST(framed_world, a_session_in_order_touches_the_wall_and_ends_when_its_time_is_up) {
  const Outcome outcome = session({}, open_framed);
  EXPECT_TRUE(outcome.violations.empty());
  EXPECT_EQ(outcome.words(), "time up");
  EXPECT_EQ(outcome.result.ticks, 600U);
  EXPECT_GT(outcome.peak, 0.2);
  std::printf("%zu frames, %.3f N, %ld steps, digest %016lx\n", outcome.frames, outcome.peak, outcome.steps, outcome.digest);
}

TEST(framed_world, random_holds_break_no_rule) {
  Plan plan;
  plan.schedule = {.holds = 0.02, .changes = 0.05};
  const Found found = random_sessions(300, plan, open_framed);
  std::printf("%.0f s in the world, digest %016lx\n", found.seconds, found.digest);
  expect_kept("random holds", found);
}

TEST(framed_world, no_hold_at_the_start_breaks_a_rule) {
  expect_kept("start", placed(holds(10), {kStart, 60}, {}, open_framed));
}
TEST(framed_world, no_hold_in_contact_breaks_a_rule) {
  expect_kept("contact", placed(holds(20), {kContact, 60}, {}, open_framed));
}
TEST(framed_world, no_hold_at_the_end_breaks_a_rule) {
  expect_kept("end", placed(holds(20), {kEnd, 60}, {}, open_framed));
}

std::vector<Fault> faults() {
  return {
      {"the machine stands still for 10 ms", [](World& world) { world.stand_still(10 * kMillisecond); }},
      {"the machine stands still for 60 ms", [](World& world) { world.stand_still(60 * kMillisecond); }},
      {"the machine and its clock stand still for 60 ms", [](World& world) { world.stand_still(60 * kMillisecond, false); }},
      {"the loop stands still for 60 ms", [](World& world) { world.hold(kLoop, 60 * kMillisecond); }},
      {"the frames stand still for 60 ms", [](World& world) { world.hold(kFrames, 60 * kMillisecond); }},
      {"the loop dies", [](World& world) { world.kill(kLoop); }}};
}

TEST(framed_world, no_fault_in_contact_breaks_a_rule) {
  expect_kept("faults", placed(faults(), {kContact, 100}, {}, open_framed));
}

}  // namespace
}  // namespace forceshade::world
