// SPDX-License-Identifier: BSD-3-Clause
// The stand-in for the vendor's library behaves as that one does, and does as it is told: processes, frames, errors and the
// order of calls.

#include "tests/device/stand_in_hd/stand_in_hd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tests/device/stand_in_hd/caller.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::stand_in_hd {
namespace {

TEST_F(stand_in, runs_in_another_process_and_shows_what_it_saw) {
  tell({.press = true});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              EXPECT_EQ(caller.handle, kInvalidSchedulerHandle);
              EXPECT_TRUE(caller.start());
              EXPECT_EQ(caller.handle, 0U);
              caller.runs(1100);
              caller.stop();
            }),
            0);
  const Seen all = seen();
  EXPECT_FALSE(all.initialised || all.scheduler || all.output || all.died);
  ASSERT_GE(all.frames.size(), 1100U);
  EXPECT_LE((all.frames[0].position - Eigen::Vector3d(0, 3, 0)).norm(), 0.1);
  // 20 frames, then 0.7 s and 0.2 s with the output on.
  for (std::size_t k = 0; k < 720; ++k) EXPECT_TRUE(all.frames[k].force.isZero(0)) << k;
  EXPECT_EQ(all.frames[919].position.y(), -2);
  EXPECT_EQ(all.frames[919].force, Eigen::Vector3d(0, 2, 0));
  EXPECT_FALSE(all.frames[19].output);
  EXPECT_TRUE(all.frames[20].output);
  EXPECT_TRUE(arm().force.isZero(0));
  EXPECT_EQ(arm().pushed_until, all.pushed_until);
  EXPECT_GT(all.pushed_until, all.frames[919].time);
}

TEST_F(stand_in, keeps_the_last_frames_of_a_long_run) {
  tell({.frame_hz = 1e6});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              caller.start();
              wait_until([&] { return caller.frames > 66'000; });
              tell({});
              caller.stop();
            }),
            0);
  const auto frames = seen().frames;
  EXPECT_EQ(frames.size(), 65'536U);
  EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end(), [](const Frame& a, const Frame& b) { return a.time < b.time; }));
}

TEST_F(stand_in, reports_an_error_that_lasts_once) {
  for (const auto& [orders, expected] : {std::pair{Orders{.begin = kCommunication}, 1}, std::pair{Orders{.comm_lost = true}, 1},
                                         std::pair{Orders{.get_position = kDeviceFault, .end = {kForceError, kFrame}}, 2},
                                         std::pair{Orders{.set = kInvalidValue}, 10}}) {
    reset();
    tell(orders);
    EXPECT_EQ(in_child([&](const Functions& hd) {
                Caller caller(hd);
                caller.start();
                caller.runs(10);
                EXPECT_EQ(std::min(caller.errors.load(), 10), expected);
                caller.stop();
              }),
              0);
  }
}

TEST_F(stand_in, reports_an_error_in_every_frame_if_told_so) {
  tell({.begin = kCommunication, .errors_repeat = true});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              caller.start();
              caller.runs(10);
              EXPECT_GE(caller.errors, 10);
              caller.stop();
            }),
            0);
}

TEST_F(stand_in, freezes_when_communication_is_lost) {
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              caller.start();
              caller.runs(100);
              EXPECT_GT(caller.rate, 0);
              tell({.comm_lost = true});
              wait_until([&] { return caller.rate == 0; });
              caller.runs(100);
              caller.stop();
            }),
            0);
  const auto frames = seen().frames;
  EXPECT_NE(frames[0].position, frames[99].position);
  EXPECT_EQ(frames.back().position, frames[frames.size() - 100].position);
}

TEST_F(stand_in, numbers_what_is_scheduled_from_zero) {
  EXPECT_EQ(in_child([](const Functions& hd) {
              const auto nothing = [](void*) -> unsigned { return kCallbackContinue; };
              EXPECT_EQ(hd.hdScheduleAsynchronous(nothing, nullptr, 0), 0U);
              EXPECT_EQ(hd.hdScheduleAsynchronous(nothing, nullptr, 0), 1U);
              hd.hdUnschedule(0);
              EXPECT_EQ(hd.hdGetError().code, kSuccess);
              hd.hdUnschedule(0);
              EXPECT_EQ(hd.hdGetError().code, kInvalidOperation);
              EXPECT_EQ(hd.hdScheduleAsynchronous(nothing, nullptr, 0), 0U);
            }),
            0);
}

TEST_F(stand_in, starts_with_an_error_that_its_starter_reads) {
  tell({.start_with_error = kTimer});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              EXPECT_FALSE(caller.start());
              caller.runs(5);
              caller.stop();
            }),
            0);
}

TEST_F(stand_in, prints_to_standard_output) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.file("printed");
  for (const bool prints : {true, false}) {
    reset();
    tell({.prints = prints});
    EXPECT_EQ(in_child([&](const Functions& hd) {
                ASSERT_TRUE(std::freopen(file.c_str(), "w", stdout));
                const Caller caller(hd);
                hd.hdDisableDevice(caller.device);
              }),
              0);
    EXPECT_EQ(directory.read("printed"), prints ? "InitLogFile : (null)\n" : "");
  }
}

TEST_F(stand_in, has_its_frames_at_the_rate_it_is_told) {
  tell({.frame_hz = 250});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              caller.start();
              const auto before = Clock::now();
              caller.runs(101);
              EXPECT_GE(Clock::now() - before, 390ms);
              EXPECT_EQ(caller.rate, 250);
              caller.stop();
            }),
            0);
}

Functions of_the_undisciplined;

TEST_F(stand_in, ends_the_force_at_the_tick_after_the_output_was_switched_off) {
  tell({.position = Eigen::Vector3d(0, -0.5, 0)});
  const int status = in_child([](const Functions& hd) {
    Caller caller(hd);
    int frames = 0;
    caller.inside = [&] {
      const bool pushes = arm().force.norm() > kContact;
      if (frames == 0 && !pushes) return;
      if (frames++ == 0) hd.hdDisable(kForceOutput);
      if (frames == 1 && !pushes) std::_Exit(1);
      if (frames == 2) std::_Exit(pushes ? 2 : 0);
    };
    caller.start();
    for (;;) pause();
  });
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(stand_in, keeps_the_last_force_when_the_scheduler_has_stopped_until_the_device_is_disabled) {
  tell({.position = Eigen::Vector3d(0, -0.5, 0)});
  const int status = in_child([](const Functions& hd) {
    Caller caller(hd);
    caller.start();
    wait_until([] { return arm().force.norm() > kContact; });
    hd.hdStopScheduler();
    EXPECT_GT(arm().force.norm(), kContact);
    hd.hdDisable(kForceOutput);
    EXPECT_GT(arm().force.norm(), kContact);
    hd.hdUnschedule(caller.handle);
    hd.hdDisableDevice(caller.device);
    EXPECT_TRUE(arm().force.isZero(0));
  });
  EXPECT_EQ(status, 0);
  const std::vector<std::string> breaches = seen().breaches;
  EXPECT_EQ(breaches,
            (std::vector<std::string>{"hdStopScheduler with the force output on", "hdStopScheduler with a force sent last"}));
  reset();
}

TEST_F(stand_in, sees_a_caller_without_discipline) {
  tell({.end = {kFrame}});
  in_child([](const Functions& functions) {
    of_the_undisciplined = functions;
    const Functions& hd = of_the_undisciplined;
    HHD device = hd.hdInitDevice(nullptr);
    const auto undisciplined = [](void* data) -> unsigned {
      // Later frames are left out: on a busy machine there would be more breaches than are noted.
      static int ticks = 0;
      if (++ticks > 3) return kCallbackContinue;
      const HHD it = *static_cast<HHD*>(data);
      const Functions& calls = of_the_undisciplined;
      double numbers[3];
      calls.hdGetDoublev(kPosition, numbers);
      numbers[0] = std::nan("");
      calls.hdBeginFrame(it);
      calls.hdBeginFrame(it);
      calls.hdSetDoublev(kForce, numbers);
      calls.hdEndFrame(it);
      return kCallbackContinue;
    };
    const auto handle = hd.hdScheduleAsynchronous(undisciplined, &device, 0);
    hd.hdStartScheduler();
    hd.hdEnable(kForceOutput);
    wait_until([] { return seen().frames.size() >= 2; });
    hd.hdDisableDevice(device);
    hd.hdEnable(kForceOutput);
    hd.hdStopScheduler();
    hd.hdUnschedule(handle);
  });
  const std::vector<std::string> breaches = seen().breaches;
  for (const char* breach : {"hdGetDoublev outside a frame", "hdBeginFrame twice in a tick",
                             "hdSetDoublev with an error unread", "hdEnable beside the running scheduler",
                             "hdEndFrame with a force that is not finite", "hdDisableDevice while the scheduler runs",
                             "hdDisableDevice with a callback scheduled", "hdStopScheduler with the force output on"})
    EXPECT_NE(std::find(breaches.begin(), breaches.end(), breach), breaches.end()) << breach;
  reset();
}

}  // namespace
}  // namespace forceshade::stand_in_hd
