// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A caller of the stand-in in a process of its own, for the stand-in's own tests.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <thread>

#include "device/phantom/hdapi_library.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/wait_until.h"

namespace forceshade::stand_in_hd {

using namespace std::chrono_literals;
using namespace hdapi;

using tests::wait_until;

// A disciplined caller, in a process that has loaded the library: switches the output on after 20 frames, and presses against a
// wall of 1 N/mm at the height 0.
class Caller {
 public:
  explicit Caller(const Functions& functions) : hd(functions), device(hd.hdInitDevice(nullptr)) {}

  bool start() {
    handle = hd.hdScheduleAsynchronous(&frame, this, kDefaultPriority);
    hd.hdStartScheduler();
    return drained(hd).code == kSuccess;
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
  HDSchedulerHandle handle = kInvalidSchedulerHandle;
  std::atomic<int> frames = 0, errors = 0, rate = 0;
  std::atomic<HDenum> calibration = 0;
  std::atomic<bool> stopping = false, stopped = false, update = false;
  std::function<void()> inside;  // in every frame, before its force is set

 private:
  static unsigned frame(void* self) {
    auto& it = *static_cast<Caller*>(self);
    const Functions& hd = it.hd;
    std::array<double, 3> position{}, force{};
    hd.hdBeginFrame(it.device);
    it.count();
    hd.hdGetDoublev(kPosition, position.data());
    it.count();
    int rate = 0;
    hd.hdGetIntegerv(kInstantaneousRate, &rate);
    it.rate = rate;
    it.calibration = hd.hdCheckCalibration();
    if (it.inside) it.inside();
    const bool output = hd.hdIsEnabled(kForceOutput) != 0;
    if (output && !it.stopping) force[1] = std::max(0.0, -position[1]);
    hd.hdSetDoublev(kForce, force.data());
    it.count();
    hd.hdEndFrame(it.device);
    it.count();
    if (it.stopping && output) hd.hdDisable(kForceOutput);
    if (it.stopping) it.stopped = true;
    if (++it.frames == 20) hd.hdEnable(kForceOutput);
    return kCallbackContinue;
  }
  void count() {
    if (drained(hd).code != kSuccess) ++errors;
  }
};

using Deed = std::function<void(const Functions&)>;

inline pid_t forked(const Deed& deed) {
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    deed(load({STAND_IN_HD}));
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
  }
  std::_Exit(testing::Test::HasFailure() ? 1 : 0);
}

// Also where the child's signals to this process interrupt the waiting.
inline int status_of(pid_t child) {
  int status = 0;
  pid_t ended;
  do {
    ended = waitpid(child, &status, 0);
  } while (ended == -1 && errno == EINTR);
  EXPECT_EQ(ended, child);
  return status;
}

inline int in_child(const Deed& deed) {
  return status_of(forked(deed));
}

inline bool ended_by(int status, int signal) {
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

// Runs until something ends the process.
inline void run_for_ever(const Functions& hd) {
  Caller caller(hd);
  caller.start();
  for (;;) pause();
}

class stand_in : public testing::Test {
 protected:
  void SetUp() override { reset(); }
  void TearDown() override {
    for (const std::string& breach : seen().breaches) ADD_FAILURE() << breach;
  }
};

}  // namespace forceshade::stand_in_hd
