// SPDX-License-Identifier: BSD-3-Clause
// The stand-in for the vendor's library keeps a force as that one does, however the process ends that sent it, and what it
// noted can be read then. Its crashes are those of phantom_process_test, which fails where one does not come.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>

#include "device/phantom/hdapi_library.h"
#include "tests/device/stand_in_hd/memory.h"
#include "tests/support/wait_until.h"

namespace forceshade::stand_in_hd {
namespace {

using namespace hdapi;
using tests::wait_until;

const Eigen::Vector3d kPush{0, 0.5, 0};  // N

bool pushes() {
  return arm().force == kPush;
}

// A process whose frames push, which then does this.
pid_t pushing(const std::function<void(const Functions&)>& deed) {
  reset();
  const pid_t child = ::fork();
  if (child != 0) return child;
  static const Functions hd = load({STAND_IN_HD});
  hd.hdInitDevice(nullptr);
  hd.hdScheduleAsynchronous(
      [](void*) -> unsigned {
        hd.hdBeginFrame(7);
        hd.hdSetDoublev(hdapi::kForce, kPush.data());
        hd.hdEndFrame(7);
        return kCallbackContinue;
      },
      nullptr, 0);
  hd.hdStartScheduler();
  hd.hdEnable(kForceOutput);
  wait_until(pushes);
  deed(hd);
  std::_Exit(0);
}

TEST(stand_in_hd, keeps_the_last_force_however_its_process_ends_and_can_be_read) {
  const auto hold_the_lock = [](int signal) {
    return [signal](const Functions&) {
      const Lock lock(opened(std::getenv(kMemory)));
      std::raise(signal);
    };
  };
  const auto raise = [](int signal) { return [signal](const Functions&) { std::raise(signal); }; };
  struct Case {
    const char* what;
    std::function<void(const Functions&)> deed;
    int status;
  };
  for (const auto& [what, deed, status] :
       {Case{"killed", raise(SIGKILL), SIGKILL}, Case{"killed with the lock", hold_the_lock(SIGKILL), SIGKILL},
        Case{"by the library's own handler", raise(SIGTERM), 0},
        Case{"stopped", [](const Functions& hd) { hd.hdStopScheduler(); }, 0}}) {
    SCOPED_TRACE(what);
    const pid_t child = pushing(deed);
    int ended = 0;
    ASSERT_EQ(::waitpid(child, &ended, 0), child);
    EXPECT_EQ(ended, status);
    EXPECT_FALSE(seen().initialised);
    EXPECT_TRUE(pushes()) << "nothing took it away";
    EXPECT_EQ(arm().pid, child);
  }
}

// At the tick after the output was switched off, and as the device is released; with the scheduler stopped by the latter alone.
TEST(stand_in_hd, ends_the_force_with_the_output_or_the_device) {
  for (const bool stops : {false, true}) {
    const pid_t child = pushing([stops](const Functions& hd) {
      if (stops) hd.hdStopScheduler();
      hd.hdDisable(kForceOutput);
      if (!stops) wait_until([] { return arm().force.isZero(0); });
      const bool still_pushes = pushes();
      hd.hdDisableDevice(7);
      std::_Exit(still_pushes == stops && arm().force.isZero(0) ? 0 : 1);
    });
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0) << stops;
  }
}

}  // namespace
}  // namespace forceshade::stand_in_hd
