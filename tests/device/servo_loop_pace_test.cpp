// SPDX-License-Identifier: BSD-3-Clause
// The servo loop and its thread: processor, privileges, pace and deadlines.

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <cmath>
#include <string>
#include <utility>

#include "forceshade/device.h"
#include "forceshade/servo_loop.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

TEST(servo_loop, leaves_the_thread_as_it_was) {
  const auto scheduling = [] {
    sched_param parameters{};
    int policy = 0;
    EXPECT_EQ(pthread_getschedparam(pthread_self(), &policy, &parameters), 0);
    return std::pair{policy, parameters.sched_priority};
  };
  const auto before = scheduling();
  Endless device;
  const Kept run(device, wall(), {.max_seconds = 0.005});
  EXPECT_EQ(scheduling(), before);
  // The last processor it may run on, unless told.
  cpu_set_t cpus;
  ASSERT_EQ(sched_getaffinity(0, sizeof cpus, &cpus), 0);
  int last = CPU_SETSIZE - 1;
  while (!CPU_ISSET(last, &cpus)) --last;
  EXPECT_EQ(run.privileges.cpu, last);
}

TEST(servo_loop, asks_for_no_privileges_unless_it_is_paced) {
  Endless device;
  const Kept run(device, wall(), {.max_seconds = 0.005, .paced = false, .cpu = 0});
  EXPECT_FALSE(run.privileges.scheduling || run.privileges.memory_locked || run.privileges.cpu);
}

TEST(servo_loop, runs_on_the_processor_it_is_told) {
  struct Where final : Still {
    ReadResult at(std::size_t) noexcept override {
      cpu = sched_getcpu();
      return here();
    }
    int cpu = -1;
  } device;
  cpu_set_t before, after;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &before)) continue;
    const Kept run(device, wall(), {.max_seconds = 0.005, .cpu = cpu});
    EXPECT_EQ(run.privileges.cpu, cpu);
    EXPECT_EQ(device.cpu, cpu);
  }
  EXPECT_EQ(Kept(device, wall(), {.max_seconds = 0.005, .cpu = CPU_SETSIZE}).privileges.cpu, std::nullopt);
  ASSERT_EQ(sched_getaffinity(0, sizeof after, &after), 0);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

// r: a reading, s: a step, l: a look ahead, f: waiting for a frame.
TEST(servo_loop, looks_ahead_before_it_reads_or_waits_for_a_frame_and_only_when_paced) {
  struct Logged final : Still {
    Logged(std::string& its, bool has_frames) : log(its), paces(has_frames) {}
    Capabilities capabilities() const noexcept override {
      Capabilities result;
      result.paces = paces;
      return result;
    }
    std::int64_t wait_for_frame(std::int64_t deadline) noexcept override {
      log += 'f';
      return deadline;
    }
    ReadResult at(std::size_t) noexcept override {
      log += 'r';
      return here();
    }
    std::string& log;
    bool paces;
  };
  struct LoggedSession final : fast::Session {
    explicit LoggedSession(std::string& its) : log(its) {}
    fast::Evaluation step(const Eigen::Vector3f&) noexcept override {
      log += 's';
      return {};
    }
    void look_ahead() noexcept override { log += 'l'; }
    std::string& log;
  };
  const auto log_of = [](bool has_frames, bool paced) {
    std::string log;
    Logged device(log, has_frames);
    LoggedSession session(log);
    run_servo_loop(device, session, {.max_seconds = 0.003, .paced = paced}, kNeverStop);
    return log;
  };
  EXPECT_EQ(log_of(false, true), "lrslrslrs");
  EXPECT_EQ(log_of(true, true), "lfrslfrslfrslf");
  EXPECT_EQ(log_of(false, false), "rsrsrs");
}

// Sleeping until an absolute time never ends early, so this holds on a machine under any load.
TEST(servo_loop, never_reads_before_the_tick_is_due) {
  Endless device;
  const Kept result(device, wall(), {.rate_hz = 2000, .max_seconds = 0.02});
  ASSERT_EQ(result.ticks, 40U);
  for (const Sample& sample : result.samples) EXPECT_GE(sample.wall_ns, static_cast<std::int64_t>(sample.tick) * 500'000);
  EXPECT_LE(result.achieved_rate_hz, 2000);
}

TEST(servo_loop, refuses_a_rate_duration_or_watchdog_timeout_out_of_range) {
  Endless device;
  const double nan = std::nan("");
  for (const double rate : {0.0, -1000.0, 99.9, 10000.1, nan})
    EXPECT_THROW(run_servo_loop(device, wall(), {.rate_hz = rate}, kNeverStop), std::invalid_argument) << rate;
  for (const double seconds : {0.0, -1.0, nan, HUGE_VAL})
    EXPECT_THROW(run_servo_loop(device, wall(), {.max_seconds = seconds}, kNeverStop), std::invalid_argument) << seconds;
  for (const double timeout : {0.0, -1.0, nan, 10.1, HUGE_VAL})
    EXPECT_THROW(run_servo_loop(device, wall(), {.watchdog_timeout = timeout}, kNeverStop), std::invalid_argument) << timeout;
  EXPECT_TRUE(device.commands.empty());
}

}  // namespace
}  // namespace forceshade::device
