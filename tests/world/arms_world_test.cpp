// SPDX-License-Identifier: BSD-3-Clause
// The servo loop over each arm whose frames a thread of ours makes, in a simulated world: no hold and no fault breaks a rule.

#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>
#include <string>

#include "tests/support/drawn.h"
#include "tests/world/arms.h"

namespace forceshade::world {

void PrintTo(const ArmKind& kind, std::ostream* out) {
  *out << kind.name;
}

namespace {

class arms_world : public testing::TestWithParam<ArmKind> {
 protected:
  // Placed in each part of a session.
  void expect_kept(const std::vector<Fault>& faults, long steps, long stride = 1) {
    for (const Part& part : parts()) {
      SCOPED_TRACE(part.name);
      expect_kept(part.name.c_str(), placed(faults, {part.from, steps * static_cast<long>(tests::drawn(4)), stride},
                                            plan_for(part, GetParam()), GetParam().open));
    }
  }

  void expect_kept(const char* what, const Found& found) {
    std::printf("%s: %ld sessions, %ld broke a rule, %ld go on; force for %.3f ms\n", what, found.tried, found.broken,
                found.go_on, found.longest);
    EXPECT_GT(found.tried, 0);
    EXPECT_EQ(found.broken, 0) << found.first;
  }
};

TEST_P(arms_world, a_session_in_order_touches_the_wall_and_ends_when_its_time_is_up) {
  const Outcome outcome = session({}, GetParam().open);
  EXPECT_TRUE(outcome.violations.empty()) << outcome.violations.front().words;
  EXPECT_EQ(outcome.words(), "time up");
  EXPECT_EQ(outcome.result.ticks, 600U);
  EXPECT_GT(outcome.peak, 0.2);
  std::printf("%zu frames, %.3f N, %ld steps, digest %016lx\n", outcome.frames, outcome.peak, outcome.steps, outcome.digest);
}

TEST_P(arms_world, gives_no_force_while_the_dead_man_button_is_let_go) {
  Plan plan;
  plan.has_dead_man_button = true;
  EXPECT_GT(session(plan, GetParam().open).peak, 0.2);
  plan.events = {{.frame = 0, .kind = Event::Kind::lets_go_of_button, .milliseconds = 2000}};
  const Outcome outcome = session(plan, GetParam().open);
  EXPECT_EQ(outcome.peak, 0);
  EXPECT_TRUE(outcome.violations.empty()) << outcome.violations.front().words;
}

// It does not wait for its own watchdog, which may have seconds.
TEST(framed_world, the_loop_learns_at_once_of_a_fault_of_its_frames) {
  Plan plan;
  plan.events = {{.frame = 700, .kind = Event::Kind::garbage}};
  const Outcome outcome = session(plan, framed_arm().open);
  EXPECT_EQ(outcome.words(), "device fault: the arm sent garbage");
  EXPECT_LT(outcome.lasted, system::in_ns(std::chrono::milliseconds(702)));
}

// Its clock is not this machine's: each position is used once.
TEST(command_world, frames_are_followed_one_tick_each_where_the_program_has_the_clock) {
  for (const Ns period : {980'000, 1'020'000}) {
    const Outcome outcome = session({}, command_arm(period).open);
    EXPECT_TRUE(outcome.violations.empty()) << outcome.violations.front().words;
    EXPECT_TRUE(outcome.result.followed_device);
    EXPECT_EQ(outcome.repeated, 0U);
    EXPECT_EQ(outcome.skipped, 0U);
    EXPECT_NEAR(static_cast<double>(outcome.lasted) / static_cast<double>(outcome.frames), static_cast<double>(period), 2'000);
  }
}

TEST_P(arms_world, random_holds_break_no_rule) {
  Plan plan;
  plan.schedule.holds = 0.02;
  plan.schedule.changes = 0.05;
  const Found found = random_sessions(static_cast<int>(tests::drawn(400)), plan, GetParam().open);
  std::printf("%.0f s in the world, digest %016lx\n", found.seconds, found.digest);
  expect_kept("random holds", found);
}

TEST_P(arms_world, no_hold_breaks_a_rule) {
  expect_kept(holds(6), 40);
}

// Its words are right where it comes under force; at the end a session may be over before it is seen.
TEST_P(arms_world, no_fault_of_the_partner_breaks_a_rule_and_each_has_its_words) {
  std::vector<Fault> faults = GetParam().faults;
  const Part& contact = parts()[1];
  expect_kept("contact", placed(faults, {contact.from, 20, 2}, plan_for(contact, GetParam()), GetParam().open));
  for (Fault& fault : faults) fault.words.clear();
  expect_kept(faults, 3, 17);
}

TEST_P(arms_world, no_fault_of_the_machine_breaks_a_rule) {
  expect_kept(faults_of_the_machine(), 8, 7);
}

TEST_P(arms_world, no_pair_of_faults_of_the_machine_breaks_a_rule) {
  const Part& contact = parts()[1];
  const std::vector<Fault> faults = faults_of_the_machine();
  expect_kept("pairs",
              placed_pairs(faults, {contact.from, 1}, faults, {1000, 2, 23}, plan_for(contact, GetParam()), GetParam().open));
}

INSTANTIATE_TEST_SUITE_P(of_each_kind, arms_world, testing::ValuesIn(arms()), [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace forceshade::world
