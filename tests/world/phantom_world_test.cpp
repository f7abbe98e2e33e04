// SPDX-License-Identifier: BSD-3-Clause
// The servo loop, a PHANToM and the process of its driver, in a simulated world: every fault of either at every step.

#include <gtest/gtest.h>

#include <cstdio>
#include <utility>

#include "device/phantom/hdapi_words.h"
#include "device/phantom/phantom_end.h"
#include "system/process.h"
#include "tests/support/drawn.h"
#include "tests/world/hd.h"
#include "tests/world/phantom_arm.h"

namespace forceshade::world {
namespace {

using std::chrono::milliseconds;

constexpr Ns kMillisecond = 1'000'000;

// The parts of a session, since its begin.
struct PartOfPhantom {
  const char* name;
  Ns from;
};
const std::vector<PartOfPhantom> kParts{
    {"opening", 0}, {"ready", 498 * kMillisecond}, {"contact", 900 * kMillisecond}, {"end", 1100 * kMillisecond}};

using Words = std::vector<std::string>;

void expect_kept(const char* part, const Found& found) {
  std::printf("%s: %ld sessions, %ld broke a rule; only a device's own time-out could have ended a force within %.3f ms\n",
              part, found.tried, found.broken, found.without_watchdog);
  EXPECT_GT(found.tried, 0);
  EXPECT_EQ(found.broken, 0) << found.first;
}

std::vector<Fault> with_words(std::vector<Fault> faults, const Words& words) {
  for (Fault& fault : faults) fault.words = words;
  return faults;
}

// The end has one of these words, if there are any. Four times as many steps where all cases are drawn.
void expect_kept_everywhere(const std::vector<Fault>& faults, std::size_t steps, const Words& words = {}, const Plan& plan = {},
                            const OpenPhantom& open = {}) {
  const long tried = static_cast<long>(tests::drawn(4 * steps));
  for (const auto& [name, from] : kParts) expect_kept(name, placed(with_words(faults, words), {from, tried}, plan, open));
}

const Fault kLoopIsKilled{"the loop's process is killed", [](World& world, Arm&) { world.kill_process(0); }};
const Fault kLoopHangs{"the loop hangs", [](World& world, Arm&) { world.kill(kLoop); }};

constexpr Ns kFrameIsLeft = 260 * kMillisecond;  // the watchdog's time, and that for a frame to end

// Starts within its time, and no words about the end of its driver follow.
TEST(phantom_world, a_session_in_order_touches_the_wall_and_ends_when_its_time_is_up) {
  const Outcome outcome = session({}, OpenPhantom{.options = {.start = milliseconds(600)}});
  for (const Violation& violation : outcome.violations) ADD_FAILURE() << "rule " << violation.rule << ": " << violation.words;
  EXPECT_EQ(outcome.words(), "time up");
  EXPECT_EQ(outcome.result.ticks, 600U);
  EXPECT_GT(outcome.peak, 0.2);
  EXPECT_EQ(outcome.driver_exit, device::kLetGo);
  const std::string& heard = OpenPhantom::attends().heard;
  EXPECT_EQ(heard.find(hdapi::kNoEnd), std::string::npos) << heard;
  std::printf("%zu frames, %.3f N, %ld steps, digest %016lx\n", outcome.frames, outcome.peak, outcome.steps, outcome.digest);
}

// The device's clock is not this machine's: each position is used once, and its force sent with the next frame.
TEST(phantom_world, frames_are_followed_one_tick_each_at_whatever_rate_they_come) {
  for (const double frame_hz : {977.0, 1000.0, 1013.0}) {
    SCOPED_TRACE(frame_hz);
    const Outcome outcome = session({}, OpenPhantom{.orders = {.peak_force = 3.0, .frame_hz = frame_hz}});
    EXPECT_TRUE(outcome.violations.empty());
    EXPECT_TRUE(outcome.result.supervised);
    EXPECT_TRUE(outcome.result.followed_device);
    EXPECT_EQ(outcome.repeated, 0U);
    EXPECT_EQ(outcome.skipped, 0U);
    EXPECT_GT(outcome.pushed, 100U);
    EXPECT_EQ(outcome.one_later, outcome.pushed);
  }
}

// The two clocks beat: some 23 ticks a second see a position that another has seen.
TEST(phantom_world, frames_that_are_slower_than_this_machines_clock_are_used_twice_where_the_loop_follows_that) {
  Plan plan;
  plan.follows_device = false;
  const Outcome outcome = session(plan, OpenPhantom{.orders = {.peak_force = 3.0, .frame_hz = 977}});
  EXPECT_TRUE(outcome.violations.empty());
  EXPECT_FALSE(outcome.result.followed_device);
  EXPECT_NEAR(static_cast<double>(outcome.repeated), 0.6 * 23, 2);
  EXPECT_GT(outcome.pushed, 100U);
}

// Events of an arm in contact, with the supervisor's answer or the words that end the run.
TEST(phantom_world, an_event_in_contact_ends_the_run_for_its_own_reason) {
  using Kind = Event::Kind;
  struct Case {
    Event event;
    std::string ends;
  };
  for (const auto& [event, ends] :
       {Case{{950, Kind::late, 20}, "tripped: watchdog"}, Case{{950, Kind::late, 60}, hdapi::kSilent},
        Case{{950, Kind::garbage}, hdapi::kNotFinite}, Case{{950, Kind::jump}, "tripped"},
        Case{{950, Kind::uncalibrated, 10}, "tripped: uncalibrated"}, Case{{950, Kind::forces_off, 60}, "time up"},
        Case{{950, Kind::lets_go_of_button, 60}, "time up"}}) {
    Plan plan;
    plan.events = {event};
    plan.has_dead_man_button = true;
    plan.longest_force += static_cast<Ns>(event.milliseconds * 1e6);
    const Outcome outcome = session(plan, OpenPhantom{});
    EXPECT_NE(outcome.words().find(ends), std::string::npos) << outcome.words();
    for (const Violation& violation : outcome.violations) ADD_FAILURE() << "rule " << violation.rule << ": " << violation.words;
    EXPECT_GT(outcome.peak, 0.2);
  }
}

TEST(phantom_world, random_holds_break_no_rule) {
  Plan plan;
  plan.schedule = {.holds = 0.02, .changes = 0.05};
  const Found found = random_sessions(static_cast<int>(tests::drawn(400)), plan, OpenPhantom{});
  std::printf("%.0f s in the world, digest %016lx\n", found.seconds, found.digest);
  expect_kept("random holds", found);
}

TEST(phantom_world, no_hold_breaks_a_rule) {
  expect_kept_everywhere(holds(12), 30);
}

TEST(phantom_world, no_standstill_and_no_death_of_the_loop_breaks_a_rule) {
  const auto all_of_the_driver = [](World& world, Arm&) {
    for (const int thread : {kHost, kWatch, kScheduler}) world.hold(thread, 60 * kMillisecond);
  };
  expect_kept_everywhere(
      {{"the machine stands still for 60 ms", [](World& world, Arm&) { world.stand_still(60 * kMillisecond); }},
       {"the machine and its clock stand still for 60 ms",
        [](World& world, Arm&) { world.stand_still(60 * kMillisecond, false); }},
       {"the loop stands still for 60 ms", [](World& world, Arm&) { world.hold(kLoop, 60 * kMillisecond); }},
       {"the frames stand still for 60 ms", [](World& world, Arm&) { world.hold(kScheduler, 60 * kMillisecond); }},
       {"the driver's process stands still for 60 ms", all_of_the_driver},
       kLoopHangs,
       kLoopIsKilled},
      50);
}

// The driver's process ends the force first, whichever of its threads crashes.
TEST(phantom_world, no_crash_of_the_drivers_process_leaves_a_force) {
  expect_kept_everywhere({crash_of_the_driver()}, 150, {"time up", hdapi::kDriverEnded, "the vendor's library failed in it"});
}

// The loop resumes it, and it sends zero.
TEST(phantom_world, a_drivers_process_that_is_stopped_leaves_no_force) {
  expect_kept_everywhere({stop_of_the_driver()}, 50,
                         {"time up", hdapi::kSilent, hdapi::kStalled, hdapi::kNoFrames, "has not answered for"}, {},
                         kImpatient);
}

// Nothing on the machine can end its force; the loop sees it and says so, and no process is left.
TEST(phantom_world, a_drivers_process_that_is_killed_or_that_no_signal_reaches_is_said_to_have_ended) {
  Plan plan;
  plan.may_be_lost = true;
  // Two tries of 0.2 s to end it, and 3 s until the process is killed that does not end.
  plan.longest_force = 3 * system::kSecond + 410 * kMillisecond;
  const Words words{"time up",
                    hdapi::kDriverEnded,
                    hdapi::kSilent,
                    hdapi::kNoFrames,
                    "was ended by a signal (Killed)",
                    "runs its frames too slowly",
                    "has not answered for"};
  for (const auto& [name, from] : kParts) {
    const Window window{from, static_cast<long>(tests::drawn(200))};
    const Found found = placed(with_words(losses_of_the_driver(), words), window, plan, kImpatient);
    expect_kept(name, found);
    EXPECT_EQ(found.without_watchdog, 0) << name;
  }
}

TEST(phantom_world, a_signal_from_elsewhere_changes_nothing) {
  const auto signal = [](World& world, Arm&) {
    if (world.threads() > kScheduler) system::interrupt(kScheduler);
  };
  expect_kept_everywhere({{"a signal", signal}}, 40, {"time up"});
}

// A frame that does not end has the driver's locks, and its force.
TEST(phantom_world, a_call_of_the_drivers_that_never_returns_ends_in_words_and_without_force) {
  Plan plan;
  plan.longest_force = kFrameIsLeft;
  const Words words{"time up",       hdapi::kSilent,         hdapi::kNoFrames,
                    hdapi::kNoStart, "has not answered for", "runs its frames too slowly"};
  expect_kept_everywhere(blocking_calls(), 30, words, plan, kImpatient);
}

// The watch says it, since whoever calls the driver cannot.
TEST(phantom_world, a_start_that_does_not_return_has_words_of_its_own) {
  OpenPhantom open = kImpatient;
  open.orders.blocks = Blocks::start_scheduler;
  const Outcome outcome = session({}, open);
  EXPECT_NE(outcome.words().find(hdapi::kNoStart), std::string::npos) << outcome.words();
  EXPECT_EQ(outcome.driver_exit, device::kStuck);
  EXPECT_NE(OpenPhantom::attends().heard.find(hdapi::kNoEnd), std::string::npos);
  EXPECT_TRUE(outcome.violations.empty());
}

// Two faults: once its end of the packets is alone, the watch ends the force, whatever the driver is stuck in.
TEST(phantom_world, the_death_of_the_loop_while_a_call_does_not_return_leaves_no_force) {
  Plan plan;
  plan.longest_force = kFrameIsLeft;
  for (const auto& [name, from] : kParts)
    expect_kept(name, placed_pairs(blocking_calls(), {from, 4, 11}, {kLoopIsKilled}, {0, 5, 40}, plan, kImpatient));
}

// The same with a loop that hangs, and keeps its end open: no software ends that force.
TEST(phantom_world, a_loop_that_hangs_while_a_frame_does_not_end_leaves_its_force_to_the_device) {
  const Found found = placed_pairs({endless_frame()}, {kParts[2].from, 4, 11}, {kLoopHangs}, {0, 5, 9}, {}, OpenPhantom{});
  std::printf("%ld sessions, %ld of them with a force that stays\n", found.tried, found.broken);
  EXPECT_GT(found.broken, 0);
  EXPECT_NE(found.first.find("rule 3: a force is felt"), std::string::npos) << found.first;
}

TEST(phantom_world, an_error_of_the_drivers_and_a_late_call_end_the_run_or_not_but_never_leave_a_force) {
  Plan plan;
  plan.longest_force = 60 * kMillisecond + 27 * kMillisecond;  // a frame that is as late
  expect_kept_everywhere(errors_of_the_driver(), 30, {}, plan);
}

TEST(phantom_world, an_attendant_may_answer_or_leave_at_any_step) {
  OpenPhantom open;
  open.orders.calibration = std::nullopt;
  open.orders.styles = hdapi::kCalibratesAtResetPose;
  open.attended = [](Attends& it) { it.patience = 200 * kMillisecond; };
  const Words done{"time up", hdapi::kNotCalibrated}, left{"stopped before the PHANToM was ready", hdapi::kNotCalibrated};
  expect_kept("answers",
              placed({{"it is done", [](World&, Arm&) { OpenPhantom::attends().does = true; }, done}}, {0, 100}, {}, open));
  expect_kept("leaves",
              placed({{"leaves", [](World&, Arm&) { OpenPhantom::attends().leaves = true; }, left}}, {0, 100}, {}, open));
}

}  // namespace
}  // namespace forceshade::world
