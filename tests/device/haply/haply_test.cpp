// SPDX-License-Identifier: BSD-3-Clause
// The Inverse3 over the stand-in for its service: no allocation in a tick, and a run of as many frames as the environment says.

#include "device/haply/haply.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "tests/device/framed_device.h"
#include "tests/device/haply/stand_in.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

// A busy machine may keep either thread waiting; where that does not matter, the timeout is long.
constexpr FramedOptions kPatient{.watchdog_timeout = 20s, .answer = 20s, .start = 60s, .rate_tolerance = 1};

class haply_device : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_websockets()) GTEST_SKIP() << "the Python package websockets is not there (Debian package python3-websockets)";
  }
  Attendant nobody;
};

// Neither while it runs nor when it fails. Only the thread that calls the device is counted.
TEST_F(haply_device, allocates_nothing_once_started) {
  HaplyStandIn stand_in("--event garbage@1400 --longest-gap 20000");
  const auto device = open_haply("", kPatient, nobody);
  ASSERT_FALSE(device->start(1000));
  expect_ticks_without_allocation(*device);
  const std::size_t before = tests::allocations();
  const Fault fault = fault_of(*device);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_NE(std::string(fault.words).find("expected JSON"), std::string::npos) << fault.words;
}

// As many as FORCESHADE_HAPLY_FRAMES says, as fast as they are answered, late, lost and wrong ones among them.
TEST_F(haply_device, is_not_blamed_over_many_frames_whatever_goes_wrong) {
  const auto session = [&](const Events& events, int frames) {
    std::string options = "--clock messages --rate 10000 --longest-gap 20000 --assume ping=1";
    for (const std::string& event : events) options += " --event " + event;
    HaplyStandIn stand_in(options);
    FramedOptions patient = kPatient;
    patient.answer = 500ms;  // before the supervisor ends the run
    const ServoResult run = [&] {
      const auto device = open_haply("", patient, nobody);
      return run_servo_loop(*device, wall(), fast_loop(frames), kNeverStop);
    }();
    return Session{run, stand_in.verdict()};
  };
  expect_no_blame(frames_named_by("FORCESHADE_HAPLY_FRAMES"), {"late", "unasked", "press"},
                  {"lose", "garbage", "nan", "wrong-unit", "no-position", "unplug", "close", "reset", "uncalibrated", "jump"},
                  session);
}

// What the frames were given to hold is what the service was sent, and no force acts after the last command.
TEST_F(haply_device, shortens_what_is_beyond_its_highest_force_and_refuses_what_is_not_finite) {
  HaplyStandIn stand_in("--longest-gap 20000");
  {
    const auto device = open_haply("", kPatient, nobody);
    EXPECT_EQ(device->capabilities().model, "inverse3");
    EXPECT_EQ(device->capabilities().driver, "Inverse Service 3.5.1");
    EXPECT_NE(device->capabilities().forces.find("force gate gain 0.3"), std::string_view::npos);
    command_too_much(*device);
  }
  expect_highest_force(stand_in.verdict(), 5);
}

}  // namespace
}  // namespace forceshade::device
