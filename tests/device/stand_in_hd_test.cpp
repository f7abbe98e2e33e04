// SPDX-License-Identifier: BSD-3-Clause
// The stand-in for the vendor's library does as that one does and as it is told, sees what its caller should not do, and what
// it noted can be read however its process ends or stands still. Its crashes are those of phantom_process_test, which fails
// where one does not come.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "device/phantom/hdapi_library.h"
#include "tests/device/stand_in_hd/memory.h"
#include "tests/support/wait_until.h"

namespace forceshade::stand_in_hd {
namespace {

using namespace std::chrono_literals;
using namespace hdapi;
using tests::wait_until;

// A disciplined caller, in a process that has loaded the library: switches the output on after 20 frames, and presses against a
// wall of 1 N/mm at the height 0.
class Caller {
 public:
  explicit Caller(const Functions& functions) : hd(functions), device(hd.hdInitDevice(nullptr)) {
    handle = hd.hdScheduleAsynchronous(&frame, this, kDefaultPriority);
    hd.hdStartScheduler();
  }
  void stop() {
    stopping = true;
    wait_until([&] { return stopped.load(); });
    hd.hdStopScheduler();
    hd.hdUnschedule(handle);
    hd.hdDisableDevice(device);
    EXPECT_EQ(drained(hd).code, kSuccess);
  }
  void runs(int count) {
    wait_until([&, until = frames + count] { return frames >= until; });
  }

  const Functions& hd;
  HHD device;
  HDSchedulerHandle handle;
  std::atomic<int> frames = 0;
  std::atomic<bool> stopping = false, stopped = false;
  std::function<void()> inside;  // in every frame, before its force is set

 private:
  static unsigned frame(void* self) {
    auto& it = *static_cast<Caller*>(self);
    const Functions& hd = it.hd;
    std::array<double, 3> position{}, force{};
    hd.hdBeginFrame(it.device);
    hd.hdGetDoublev(kPosition, position.data());
    if (it.inside) it.inside();
    const bool output = hd.hdIsEnabled(kForceOutput) != 0;
    if (output && !it.stopping) force[1] = std::max(0.0, -position[1]);
    hd.hdSetDoublev(kForce, force.data());
    hd.hdEndFrame(it.device);
    if (it.stopping && output) hd.hdDisable(kForceOutput);
    if (it.stopping) it.stopped = true;
    if (++it.frames == 20) hd.hdEnable(kForceOutput);
    return kCallbackContinue;
  }
};

using Deed = std::function<void(const Functions&)>;

pid_t forked(const Deed& deed) {
  const pid_t child = fork();
  if (child != 0) return child;
  deed(load({STAND_IN_HD}));
  std::_Exit(testing::Test::HasFailure() ? 1 : 0);
}

int status_of(pid_t child) {
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return status;
}

int in_child(const Deed& deed) {
  return status_of(forked(deed));
}

bool ended_by(int status, int signal) {
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

const Orders kInTheWall{.position = Eigen::Vector3d(0, -0.5, 0)};

class stand_in : public testing::Test {
 protected:
  void SetUp() override { reset(); }
  void TearDown() override {
    for (const std::string& breach : seen().breaches) ADD_FAILURE() << breach;
  }
};

TEST_F(stand_in, presses_as_told_and_shows_it_to_another_process) {
  tell({.press = true});
  const pid_t child = forked([](const Functions& hd) {
    Caller caller(hd);
    caller.runs(700);
    EXPECT_TRUE(arm().force.isZero(0)) << "20 frames without output, and 0.7 s before it presses";
    wait_until([] { return arm().force == Eigen::Vector3d(0, 2, 0); });
    caller.stop();
  });
  wait_until([] { return arm().force == Eigen::Vector3d(0, 2, 0); });
  EXPECT_EQ(arm().pid, child);
  const auto before = Clock::now();
  EXPECT_EQ(status_of(child), 0);
  EXPECT_FALSE(seen().initialised || seen().scheduler || seen().output);
  EXPECT_GT(seen().frames, 900U);
  EXPECT_TRUE(arm().force.isZero(0));
  EXPECT_GT(arm().pushed_until, before - 1s);
}

TEST_F(stand_in, ends_the_force_at_the_tick_after_the_output_was_switched_off) {
  tell(kInTheWall);
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
    for (;;) pause();
  });
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(stand_in, keeps_the_last_force_when_the_scheduler_has_stopped_until_the_device_is_disabled) {
  tell(kInTheWall);
  const int status = in_child([](const Functions& hd) {
    Caller caller(hd);
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
  EXPECT_EQ(seen().breaches,
            (std::vector<std::string>{"hdStopScheduler with the force output on", "hdStopScheduler with a force sent last"}));
  reset();
}

TEST_F(stand_in, sees_a_caller_without_discipline) {
  static Functions of_the_undisciplined;
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
    wait_until([] { return seen().frames >= 2; });
    hd.hdDisableDevice(device);
    hd.hdEnable(kForceOutput);
    hd.hdStopScheduler();
    hd.hdUnschedule(handle);
  });
  const std::vector<std::string> breaches = seen().breaches;
  for (const char* breach :
       {"hdGetDoublev outside a frame", "hdBeginFrame twice in a tick", "hdSetDoublev with an error unread",
        "hdEnable beside the running scheduler", "hdEnable without a device", "hdEndFrame with a force that is not finite",
        "hdDisableDevice while the scheduler runs", "hdDisableDevice with a callback scheduled",
        "hdStopScheduler with the force output on"})
    EXPECT_NE(std::find(breaches.begin(), breaches.end(), breach), breaches.end()) << breach;
  reset();
}

TEST_F(stand_in, is_readable_after_its_process_was_killed_anywhere) {
  for (int microseconds = 0; microseconds < 30; ++microseconds) {
    reset();
    tell(kInTheWall);
    const pid_t child = forked([](const Functions& hd) {
      const Caller caller(hd);
      for (;;) pause();
    });
    wait_until([&] { return arm().pid == child && !arm().force.isZero(0); });
    std::this_thread::sleep_for(std::chrono::microseconds(37 * microseconds));
    kill(child, SIGKILL);
    EXPECT_TRUE(ended_by(status_of(child), SIGKILL));
    EXPECT_FALSE(seen().initialised);
    EXPECT_FALSE(arm().force.isZero(0)) << "nothing took it away";
    EXPECT_EQ(arm().pid, child);
  }
}

TEST_F(stand_in, is_readable_after_its_process_was_killed_with_the_lock) {
  EXPECT_TRUE(ended_by(in_child([](const Functions&) {
                         const Lock lock(opened(std::getenv(kMemory)));
                         std::raise(SIGKILL);
                       }),
                       SIGKILL));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(seen().frames, 0U);
}

TEST_F(stand_in, is_readable_while_its_process_stands_still_with_the_lock) {
  const pid_t child = forked([](const Functions&) {
    const Lock lock(opened(std::getenv(kMemory)));
    std::raise(SIGSTOP);
  });
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status));
  EXPECT_EQ(seen().frames, 0U);
  kill(child, SIGCONT);
  EXPECT_EQ(status_of(child), 0);
}

TEST_F(stand_in, puts_its_own_handler_over_the_programs_and_ends_with_the_force_on) {
  tell(kInTheWall);
  const int status = in_child([](const Functions& hd) {
    std::signal(SIGTERM, [](int) { std::_Exit(3); });
    const Caller caller(hd);
    wait_until([] { return !arm().force.isZero(0); });
    std::raise(SIGTERM);
  });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(arm().force, Eigen::Vector3d(0, 0.5, 0));
}

// Neither call returns while a callback hangs, and the device stays as it was.
TEST_F(stand_in, stops_and_releases_the_device_for_no_other_thread_while_a_callback_hangs) {
  for (const bool releases : {true, false}) {
    reset();
    tell({.crash = {.how = Crash::How::hang, .when = Moment::frame, .frame = 5}});
    const pid_t child = forked([=](const Functions& hd) {
      const Caller caller(hd);
      wait_until([] { return struck().has_value(); });
      releases ? hd.hdDisableDevice(caller.device) : hd.hdStopScheduler();
    });
    wait_until([] { return struck().has_value(); });
    std::this_thread::sleep_for(100ms);
    EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0);
    EXPECT_EQ(seen().frames, 5U);
    EXPECT_TRUE(seen().scheduler && seen().initialised);
    kill(child, SIGKILL);
    status_of(child);
  }
}

TEST_F(stand_in, releases_the_device_inside_a_frame_of_its_own_thread_which_ends_the_force) {
  tell(kInTheWall);
  const int status = in_child([](const Functions& hd) {
    Caller caller(hd);
    caller.inside = [&] {
      if (arm().force.norm() < kContact) return;
      hd.hdDisableDevice(caller.device);
      std::_Exit(arm().force.isZero(0) ? 0 : 1);
    };
    for (;;) pause();
  });
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(seen().initialised || seen().output);
}

TEST_F(stand_in, sends_its_parent_a_signal_once_the_hand_has_been_in_contact_for_20_frames) {
  static volatile std::sig_atomic_t got = 0;
  const auto before = std::signal(SIGUSR1, [](int) { got = got + 1; });
  tell({.position = kInTheWall.position,
        .crash = {.how = Crash::How::signal_to_parent, .when = Moment::contact, .signal = SIGUSR1}});
  const pid_t child = forked([](const Functions& hd) {
    Caller caller(hd);
    wait_until([] { return struck().has_value(); });
    EXPECT_GE(caller.frames, 39);
    caller.stop();
  });
  wait_until([] { return got == 1; });
  EXPECT_EQ(status_of(child), 0);
  std::signal(SIGUSR1, before);
}

}  // namespace
}  // namespace forceshade::stand_in_hd
