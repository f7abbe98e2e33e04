// SPDX-License-Identifier: BSD-3-Clause
// The Inverse3 over the stand-in for its service: no allocation in a tick, and a run of as many frames as the environment says.

#include "device/haply/haply.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "device/monotonic.h"
#include "forceshade/servo_loop.h"
#include "tests/device/haply/stand_in.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/support/allocations.h"

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
  const std::size_t before = tests::allocations();
  for (int tick = 0; tick < 200; ++tick) {
    device->wait_for_frame(monotonic_now() + 20 * kSecond);
    ASSERT_TRUE(std::holds_alternative<Reading>(device->read()));
    device->allow({.work = 1, .longest_step = 1});
    device->command({0, 0, 0.1F});
  }
  device->command({0, 0, 0});
  EXPECT_EQ(tests::allocations(), before);
  ReadResult last = device->read();
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (!std::holds_alternative<Fault>(last) && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(1ms);
    last = device->read();
  }
  EXPECT_EQ(tests::allocations(), before);
  ASSERT_TRUE(std::holds_alternative<Fault>(last));
  EXPECT_NE(std::string(std::get<Fault>(last).words).find("expected JSON"), std::string::npos) << std::get<Fault>(last).words;
}

// As many as FORCESHADE_HAPLY_FRAMES says, as fast as they are answered; the stand-in finds no fault.
TEST_F(haply_device, is_not_blamed_over_many_frames) {
  const char* said = std::getenv("FORCESHADE_HAPLY_FRAMES");
  const int frames = said ? std::atoi(said) : 6000;
  constexpr double kRate = 10'000;
  HaplyStandIn stand_in(
      "--clock messages --rate 10000 --longest-gap 20000 --assume ping=1 --event unasked@5300 --event press@5600");
  ServoResult run;
  {
    const auto device = open_haply("", kPatient, nobody);
    run = run_servo_loop(*device, wall(), {.rate_hz = kRate, .max_seconds = frames / kRate, .watchdog_timeout = 1}, kNeverStop);
  }
  const nlohmann::json verdict = stand_in.verdict();
  std::printf("%zu ticks, %s; peak %.3f N; %s\n", run.ticks, name_of(run.end_reason).data(), run.peak_force_N,
              verdict["sessions"].dump().c_str());
  EXPECT_EQ(run.end_reason, EndReason::time_up) << (run.fault ? run.fault : "");
  EXPECT_EQ(verdict["faults"], nlohmann::json::object());
  EXPECT_EQ(verdict["exit"], 0);
  EXPECT_GE(verdict["sessions"][0]["messages"], frames);
  if (frames > 12'000) {
    EXPECT_GT(run.peak_force_N, 0.1);  // by then the hand is in contact
  }
}

// What the frames were given to hold is what the service was sent, and no force acts after the last command.
TEST_F(haply_device, shortens_what_is_beyond_its_highest_force_and_refuses_what_is_not_finite) {
  HaplyStandIn stand_in("--longest-gap 20000");
  {
    const auto device = open_haply("", kPatient, nobody);
    EXPECT_EQ(device->capabilities().model, "inverse3");
    EXPECT_EQ(device->capabilities().driver, "Inverse Service 3.5.1");
    EXPECT_NE(device->capabilities().forces.find("force gate gain 0.3"), std::string_view::npos);
    ASSERT_FALSE(device->start(1000));
    device->allow({.work = 1e6, .longest_step = 1});
    for (int tick = 0; tick < 50; ++tick) {
      device->wait_for_frame(monotonic_now() + 20 * kSecond);
      device->read();
      EXPECT_FALSE(device->command({0, 0, 100}));
    }
    EXPECT_TRUE(device->command({0, 0, std::numeric_limits<float>::quiet_NaN()}));
  }
  const nlohmann::json verdict = stand_in.verdict();
  EXPECT_EQ(verdict["faults"], nlohmann::json::object());
  const double largest = verdict["sessions"][0]["largest_force_N"];
  EXPECT_LE(largest, 5);
  EXPECT_GT(largest, 4.9);
  EXPECT_EQ(verdict["sessions"][0]["force_at_end_N"], 0);
}

}  // namespace
}  // namespace forceshade::device
