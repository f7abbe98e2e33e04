// SPDX-License-Identifier: BSD-3-Clause
// The stand-in's notes can be read however its process ends or stands still.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <thread>
#include <utility>

#include "tests/device/stand_in_hd/caller.h"
#include "tests/device/stand_in_hd/memory.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"

namespace forceshade::stand_in_hd {
namespace {

TEST_F(stand_in, is_readable_after_its_process_was_killed_anywhere) {
  tell({.position = Eigen::Vector3d(0, -0.5, 0), .frame_hz = 20'000});
  for (int microseconds = 0; microseconds < 30; ++microseconds) {
    const pid_t child = forked(run_for_ever);
    wait_until([&] { return arm().pid == child && !arm().force.isZero(0); });
    std::this_thread::sleep_for(std::chrono::microseconds(37 * microseconds));
    kill(child, SIGKILL);
    EXPECT_TRUE(ended_by(status_of(child), SIGKILL));
    const Seen all = seen();
    EXPECT_TRUE(all.died);
    EXPECT_FALSE(all.initialised);
    EXPECT_FALSE(arm().force.isZero(0)) << "nothing took it away";
    EXPECT_EQ(arm().pid, child);
    EXPECT_LT(arm().changed, Clock::now());
    reset();
    tell({.position = Eigen::Vector3d(0, -0.5, 0), .frame_hz = 20'000});
  }
}

TEST_F(stand_in, is_readable_after_its_process_was_killed_with_the_lock) {
  EXPECT_TRUE(ended_by(in_child([](const Functions&) {
                         const Lock lock(opened(std::getenv(kMemory)));
                         std::raise(SIGKILL);
                       }),
                       SIGKILL));
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(seen().frames.empty());
}

TEST_F(stand_in, is_readable_while_its_process_stands_still_with_the_lock) {
  const pid_t child = forked([](const Functions&) {
    const Lock lock(opened(std::getenv(kMemory)));
    std::raise(SIGSTOP);
  });
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status));
  EXPECT_TRUE(seen().frames.empty());
  kill(child, SIGCONT);
  EXPECT_EQ(status_of(child), 0);
}

TEST_F(stand_in, puts_its_own_handler_over_the_programs_and_ends_with_the_force_on) {
  for (const bool steals : {true, false}) {
    reset();
    tell({.steals_signals = steals, .press = true});
    const int status = in_child([](const Functions& hd) {
      std::signal(SIGTERM, [](int) { std::_Exit(3); });
      Caller caller(hd);
      caller.start();
      wait_until([] { return arm().force.norm() == 2; });
      std::raise(SIGTERM);
    });
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), steals ? 0 : 3);
    EXPECT_EQ(arm().force, Eigen::Vector3d(0, 2, 0));
    EXPECT_TRUE(seen().died);
  }
}

TEST_F(stand_in, is_in_use_until_the_process_that_uses_it_ends) {
  const pid_t user = forked(run_for_ever);
  wait_until([] { return seen().scheduler; });
  const auto why_not = [](const Functions& hd) {
    const HHD device = hd.hdInitDevice(nullptr);
    const HDerror error = hd.hdGetError().code;
    if (device != kInvalidDevice) hd.hdDisableDevice(device);
    std::_Exit(error == kAlreadyInitiated ? 2 : 0);
  };
  EXPECT_EQ(WEXITSTATUS(in_child(why_not)), 2);
  kill(user, SIGKILL);
  // Not yet waited for.
  wait_until([] { return seen().died; });
  EXPECT_EQ(WEXITSTATUS(in_child(why_not)), 0);
  status_of(user);
}

TEST_F(stand_in, sends_a_signal_at_the_moment_told) {
  struct Expected {
    Kill kill;
    std::size_t frames;  // that were ended
    double force;        // felt then and from then on, N; a wall of 1 N/mm
  };
  for (const Expected& expected : {
           Expected{{.signal = SIGKILL, .when = Moment::before_start}, 0, 0},
           Expected{{.signal = SIGKILL, .when = Moment::settling}, 10, 0},
           Expected{{.signal = SIGKILL, .when = Moment::frame, .frame = 7}, 7, 0},
           Expected{{.signal = SIGKILL, .when = Moment::free, .frame = 30}, 50, 0},
           Expected{{.signal = SIGKILL, .when = Moment::contact}, 855, 1.01},
       }) {
    SCOPED_TRACE(static_cast<int>(expected.kill.when));
    reset();
    tell({.press = true, .kill = expected.kill});
    const auto before = Clock::now();
    EXPECT_TRUE(ended_by(in_child(run_for_ever), SIGKILL));
    const Seen all = seen();
    EXPECT_EQ(all.frames.size(), expected.frames);
    EXPECT_NEAR(all.killed_under.norm(), expected.force, 0.01);
    EXPECT_EQ(arm().force, all.killed_under);
    ASSERT_TRUE(all.killed);
    EXPECT_GT(*all.killed, before);
    EXPECT_TRUE(all.died);
  }
}

TEST_F(stand_in, sends_signals_to_others) {
  static volatile std::sig_atomic_t got = 0;
  const auto before = std::signal(SIGUSR1, [](int) { got = got + 1; });
  tell({.kill = {.pid = Kill::kParent, .signal = SIGUSR1, .when = Moment::frame, .frame = 3}});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              caller.start();
              caller.runs(10);
              caller.stop();
            }),
            0);
  EXPECT_EQ(got, 1);
  std::signal(SIGUSR1, before);
}

TEST_F(stand_in, crashes_as_told) {
  using How = Crash::How;
  for (const auto& [how, well] : {std::pair{How::segmentation_fault, false}, std::pair{How::abort, false},
                                  std::pair{How::exit, true}, std::pair{How::exception, false}}) {
    reset();
    tell({.crash = {.how = how, .when = Moment::settling}});
    const int status = in_child(run_for_ever);
    EXPECT_EQ(WIFEXITED(status) && WEXITSTATUS(status) == 0, well) << static_cast<int>(how);
    EXPECT_EQ(seen().frames.size(), 10U);
    EXPECT_TRUE(seen().crashed);
  }
}

TEST_F(stand_in, throws_when_it_is_initialised_if_told_so) {
  tell({.crash = {.how = Crash::How::exception, .when = Moment::before_start}});
  EXPECT_EQ(in_child([](const Functions& hd) { EXPECT_THROW(hd.hdInitDevice(nullptr), std::exception); }), 0);
  EXPECT_FALSE(seen().initialised);
}

TEST_F(stand_in, never_returns_from_the_call_told) {
  for (const auto& [blocks, frames] :
       {std::pair{Blocks::init_device, 0U}, std::pair{Blocks::start_scheduler, 0U}, std::pair{Blocks::begin_frame, 0U},
        std::pair{Blocks::end_frame, 1U}, std::pair{Blocks::stop_scheduler, 30U}, std::pair{Blocks::disable_device, 30U}}) {
    reset();
    tell({.blocks = blocks});
    const pid_t child = forked([](const Functions& hd) {
      Caller caller(hd);
      caller.start();
      caller.runs(30);
      caller.stop();
    });
    wait_until([&, least = frames] { return seen().frames.size() >= least; });
    std::this_thread::sleep_for(100ms);
    EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0) << static_cast<int>(blocks);
    EXPECT_TRUE(frames == 30 || seen().frames.size() == frames);
    kill(child, SIGKILL);
    status_of(child);
  }
}

TEST_F(stand_in, waits_for_a_callback_that_hangs_for_ever) {
  tell({.crash = {.how = Crash::How::hang, .when = Moment::frame, .frame = 5}});
  const pid_t child = forked([](const Functions& hd) {
    Caller caller(hd);
    caller.start();
    wait_until([] { return seen().crashed.has_value(); });
    hd.hdStopScheduler();
  });
  wait_until([] { return seen().crashed.has_value(); });
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0);
  EXPECT_TRUE(seen().scheduler);
  kill(child, SIGKILL);
  status_of(child);
}

TEST_F(stand_in, releases_the_device_for_no_other_thread_while_a_callback_hangs) {
  tell({.crash = {.how = Crash::How::hang, .when = Moment::frame, .frame = 5}});
  const pid_t child = forked([](const Functions& hd) {
    Caller caller(hd);
    caller.start();
    wait_until([] { return seen().crashed.has_value(); });
    hd.hdDisableDevice(caller.device);
  });
  wait_until([] { return seen().crashed.has_value(); });
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0);
  EXPECT_TRUE(seen().initialised);
  kill(child, SIGKILL);
  status_of(child);
}

TEST_F(stand_in, releases_the_device_inside_a_frame_of_its_own_thread_which_ends_the_force) {
  tell({.position = Eigen::Vector3d(0, -0.5, 0)});
  const int status = in_child([](const Functions& hd) {
    Caller caller(hd);
    caller.inside = [&] {
      if (arm().force.norm() < kContact) return;
      hd.hdDisableDevice(caller.device);
      std::_Exit(arm().force.isZero(0) ? 0 : 1);
    };
    caller.start();
    for (;;) pause();
  });
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(seen().initialised || seen().output);
}

}  // namespace
}  // namespace forceshade::stand_in_hd
