// SPDX-License-Identifier: BSD-3-Clause
// A device of DHD over the stand-in's library: no allocation in a tick, and calls that do not return. Faults in a run are tried
// in a simulated world (tests/world/arms_world_test.cpp).

#include "device/dhd/dhd.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "device/dhd/timed_calls.h"
#include "tests/device/dhd/fake.h"
#include "tests/device/framed_device.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;
using dhd::StandIn;

// The hand moves with the readings, and the device keeps its force between any two.
const std::string kPatientDevice = "watchdog-works=no,longest-gap=3600000,clock=1000,";

class dhd_device : public testing::Test {
 protected:
  Attendant nobody;
};

TEST_F(dhd_device, allocates_nothing_once_started) {
  StandIn stand_in(kPatientDevice + "garbage@1400");
  const auto device = open_dhd("", kPatient, nobody);
  ASSERT_FALSE(device->start(1000));
  expect_ticks_without_allocation(*device);
  const std::size_t before = tests::allocations();
  const Fault fault = fault_of(*device);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_NE(std::string(fault.words).find("the device's position: expected numbers of at most 1 m"), std::string::npos)
      << fault.words;
}

// Each by itself makes no difference to the client, so several are tried at once.
TEST_F(dhd_device, is_driven_whatever_the_documents_leave_open_and_makes_no_fault) {
  for (const char* assumptions :
       {"set-force-off=ok,not-finite=accept,last-error=process,error-kept=no,status-length=16,brakes=off,forces=on",
        "enable-uncalibrated=ok,time-guard=200,expert=thread,max-force=ignore,call-time=100,serial=77", "model=delta.3",
        "model=omega.7-left", "model=sigma.7", "model=lambda.7"}) {
    SCOPED_TRACE(assumptions);
    StandIn stand_in(kPatientDevice + assumptions);
    expect_ticks(*open_dhd("", kPatient, nobody));
    const nlohmann::json verdict = stand_in.verdict();
    EXPECT_EQ(verdict["faults"], nlohmann::json::object());
    EXPECT_EQ(verdict["sessions"][0]["end"], "closed");
  }
}

TEST_F(dhd_device, shortens_what_is_beyond_its_highest_force_and_refuses_what_is_not_finite) {
  StandIn stand_in(kPatientDevice + "model=falcon");
  {
    const auto device = open_dhd("#0", kPatient, nobody);
    const Capabilities its = device->capabilities();
    EXPECT_EQ(its.model, "Falcon");
    EXPECT_EQ(its.serial, "");
    EXPECT_EQ(its.driver, "libdhd.so.3");
    EXPECT_EQ(its.workspace_high.z(), 40);
    EXPECT_EQ(its.buttons, 4);
    EXPECT_NE(its.forces.find("which no certificate covers"), std::string_view::npos);
    command_too_much(*device);
  }
  const nlohmann::json verdict = stand_in.verdict();
  expect_highest_force(verdict, 8);
  EXPECT_EQ(verdict["sessions"][0]["end"], "closed");
}

TEST(timed_calls, run_in_turn_in_one_thread_and_throw_what_they_throw) {
  TimedCalls calls;
  std::thread::id first, second;
  EXPECT_TRUE(calls.run([&] { first = std::this_thread::get_id(); }, kLongest));
  EXPECT_TRUE(calls.run([&] { second = std::this_thread::get_id(); }, kLongest));
  EXPECT_EQ(first, second);
  EXPECT_NE(first, std::this_thread::get_id());
  EXPECT_THROW(calls.run([] { throw std::runtime_error("x"); }, kLongest), std::runtime_error);
  EXPECT_TRUE(calls.run([] {}, kLongest));
}

TEST(timed_calls, do_not_wait_for_one_that_does_not_return) {
  const auto may_return = std::make_shared<std::atomic<bool>>(false);
  const auto others = std::make_shared<std::atomic<int>>(0);
  {
    TimedCalls calls;
    const auto stuck = [may_return] {
      while (!*may_return) std::this_thread::sleep_for(1ms);
    };
    EXPECT_FALSE(calls.run(stuck, 10ms));
    EXPECT_FALSE(calls.run([others] { ++*others; }, 10ms));
    EXPECT_EQ(*others, 0);
    *may_return = true;
    EXPECT_TRUE(calls.run([others] { ++*others; }, kLongest));
    EXPECT_EQ(*others, 1);
    *may_return = false;
    EXPECT_FALSE(calls.run(stuck, 10ms));
  }
  *may_return = true;
}

TEST(dhd_device_check, says_what_the_vendors_library_sees) {
  struct Case {
    const char* settings;
    Grade grade;
    const char* words;
  };
  for (const Case& its : {Case{"available=yes", Grade::ok, "the vendor's library sees 1, of which 1 can be opened"},
                          {"available=no", Grade::wrong,
                           "the vendor's library sees 1, of which 0 can be opened: end the program that uses it"}}) {
    const StandIn stand_in(its.settings);
    const Check devices = dhd_checks("").back();
    EXPECT_EQ(devices.grade, its.grade) << its.settings;
    EXPECT_EQ(devices.words, its.words);
  }
  ::setenv("FORCESHADE_DHD_LIBRARY", "/no/libdhd.so.3", 1);
  const std::vector<Check> checks = dhd_checks("");
  EXPECT_EQ(checks.back().grade, Grade::unknown);
  EXPECT_EQ(checks.back().words, "the vendor's library could not be loaded: see the opening");
}

TEST(dhd_usb, check_says_what_is_missing) {
  EXPECT_EQ(check_usb({}).grade, Grade::unknown);
  EXPECT_EQ(check_usb({{"1451:0402", "/dev/a", true}}).grade, Grade::ok);
  const Check wrong = check_usb({{"1451:0402", "/dev/a", true}, {"0403:cb48", "/dev/b", false}});
  EXPECT_EQ(wrong.grade, Grade::wrong);
  EXPECT_NE(wrong.words.find("/dev/b cannot be read and written by this user: write SUBSYSTEM==\"usb\""), std::string::npos)
      << wrong.words;
}

}  // namespace
}  // namespace forceshade::device
