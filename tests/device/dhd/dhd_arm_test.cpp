// SPDX-License-Identifier: BSD-3-Clause
// A device of DHD against functions that a test has in its hand: axes, order of calls, and what every answer leads to.

#include "device/dhd/dhd_arm.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "device/dhd/dhd.h"
#include "device/dhd/dhd_words.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "system/system.h"
#include "tests/device/dhd/fake.h"
#include "tests/support/set_control_words.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::device::dhd {
namespace {

using Calls = std::vector<std::string>;
using tests::expect_words;

// Open, and its forces are on.
class dhd_arm : public testing::Test {
 protected:
  dhd_arm() : arm(fake_functions(), true) {}
  void begin() {
    arm.open("");
    arm.exchange({0, 0, 0});
    arm.exchange({0, 0, 0});
    fake.calls.clear();
  }
  std::string fails() {
    return tests::thrown_by<std::runtime_error>([&] { arm.exchange({0, 0, 1}); });
  }
  Arm arm;
};

// One that was linked with -ffast-math changes it as it is loaded, another one in any call.
TEST(dhd_library, leaves_the_arithmetic_of_its_callers_as_it_was) {
  const ControlWords before = control_words();
  const Functions loaded = load({CHANGES_ARITHMETIC});
  EXPECT_EQ(control_words(), before);
  EXPECT_EQ(fast::arithmetic_fault(), nullptr);
  const ControlWords after_the_look = control_words();  // which raises exceptions
  Functions its = loaded;
  its.dhdGetDeviceCount = [] {
    set_control_words({.mxcsr = 0x9FC0, .x87 = tests::kX87Of53Bits});
    return 7;
  };
  EXPECT_EQ(its.dhdGetDeviceCount(), 7);
  EXPECT_EQ(control_words(), after_the_look);
}

TEST_F(dhd_arm, has_the_axes_of_the_laws) {
  begin();
  const FrameState state = arm.exchange({1, 2, 3});
  // 1 mm towards the operator, 2 to the right, 3 up: 2 mm right, 1 mm towards the user, 3 mm up.
  EXPECT_EQ(state.position, Eigen::Vector3d(2, -1, 3));
  EXPECT_EQ(fake.calls, (Calls{"force -2 1 3"}));
  EXPECT_EQ(state.buttons, 5);
  EXPECT_TRUE(state.calibrated && state.forces_on);
}

// A frame that took too long before its force was to be sent.
TEST_F(dhd_arm, sends_no_force_once_its_time_is_up) {
  begin();
  arm.exchange({1, 2, 3}, system::now());
  EXPECT_EQ(fake.calls, (Calls{"force 0 0 0"}));
}

TEST_F(dhd_arm, begins_and_ends_in_this_order) {
  const Identity its = arm.open("");
  EXPECT_EQ(fake.calls, (Calls{"open 0", "enable 0", "expert", "watchdog 255"}));
  EXPECT_EQ(its.serial, "1234");
  EXPECT_EQ(its.gripper, 12.5);
  EXPECT_TRUE(its.has_watchdog);
  fake.calls.clear();
  // No force is sent before the status has reported that forces are on.
  EXPECT_FALSE(arm.exchange({0, 0, 1}).forces_on);
  EXPECT_EQ(fake.calls, (Calls{"max 12", "gravity 1", "brakes 0", "enable 1", "force 0 0 0"}));
  fake.calls.clear();
  arm.exchange({0, 0, 1});
  arm.close();
  arm.close();
  EXPECT_EQ(fake.calls, (Calls{"force 0 0 1", "force 0 0 0", "stop", "close"}));
}

TEST_F(dhd_arm, without_force_calls_nothing_that_could_give_one) {
  Arm quiet(fake_functions(), false);
  EXPECT_FALSE(quiet.open("").has_watchdog);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(quiet.exchange({0, 0, 1}).forces_on);
  quiet.close();
  EXPECT_EQ(fake.calls, (Calls{"open 0", "enable 0", "close"}));
}

TEST_F(dhd_arm, waits_for_its_calibration) {
  arm.open("");
  fake.calls.clear();
  fake.status[kReset] = 1;
  EXPECT_FALSE(arm.exchange({0, 0, 1}).calibrated);
  EXPECT_EQ(fake.calls, Calls{});
  fake.status[kReset] = 0;
  EXPECT_TRUE(arm.exchange({0, 0, 1}).calibrated);
  EXPECT_EQ(fake.calls.size(), 5U);
  arm.exchange({0, 0, 1});
  fake.calls.clear();
  // One that is lost again is no fault here: the supervisor ends the run. It is sent zero.
  fake.status[kReset] = 1;
  fake.status[kForce] = 0;
  fake.force_result = -1;
  const FrameState lost = arm.exchange({0, 0, 1});
  EXPECT_FALSE(lost.calibrated || lost.forces_on);
  EXPECT_EQ(fake.calls, (Calls{"force 0 0 0"}));
}

TEST_F(dhd_arm, says_why_the_device_has_switched_its_forces_off) {
  begin();
  fake.status[kForce] = 0;
  for (const auto& [cause, words] :
       {std::pair{1, "its force button was pressed"}, std::pair{2, "its arm was too fast"},
        std::pair{3, "its watchdog got no force in time"}, std::pair{4, "a program switched them off"},
        std::pair{5, "its USB connection is bad"}, std::pair{6, "its dead-man switch was released"},
        std::pair{0, "it says no cause"}, std::pair{99, "it says no cause"}}) {
    fake.status[kForceOffCause] = cause;
    expect_words(fails(), {"the device has switched its forces off: ", words});
  }
}

TEST_F(dhd_arm, says_that_forces_never_came_on) {
  fake.switches_on = false;
  arm.open("");
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(arm.exchange({0, 0, 1}).forces_on);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  expect_words(fails(), {"has switched its forces off"});
}

TEST_F(dhd_arm, takes_saturated_motors_and_the_time_guard_for_no_error) {
  begin();
  fake.force_result = kSaturated;
  fake.position_result = kTimeGuard;
  arm.exchange({0, 0, 1});
  arm.exchange({0, 0, 1});
  fake.force_result = fake.position_result = 0;
  arm.exchange({0, 0, 1});
  EXPECT_EQ(arm.saturated(), 2U);
  EXPECT_EQ(arm.guarded(), 2U);
}

TEST_F(dhd_arm, says_what_failed) {
  begin();
  fake.force_result = -1;
  expect_words(fails(),
               {"sending a force: communication with the device failed (DHD error 2, the vendor says \"their words\")"});
  fake.force_result = 0;
  fake.position_result = -1;
  expect_words(fails(), {"reading the position: communication"});
  fake.position_result = 0;
  fake.status_result = -1;
  expect_words(fails(), {"reading the status: communication"});
  fake.status_result = 0;
  EXPECT_EQ(fails(), "");
  // Its states and other positions are tried in a simulated world (tests/world/arms_world_test.cpp).
  fake.position[1] = 1.001;
  expect_words(fails(), {"the device's position: expected numbers of at most 1 m, got (0.001, "});
  fake.position[1] = 0.999;
  EXPECT_EQ(fails(), "");
}

TEST_F(dhd_arm, is_chosen_by_serial_number_or_index) {
  arm.open("1234");
  EXPECT_EQ(fake.calls.front(), "open serial 1234");
  const auto opening = [](const std::string& which, int count) {
    Arm one(fake_functions(), true);
    fake.count = count;
    return tests::thrown_by<std::runtime_error>([&] { one.open(which); });
  };
  EXPECT_EQ(opening("#1", 2), "");
  EXPECT_EQ(fake.calls.front(), "open 1");
  expect_words(opening("#1", 1), {"opening the device \"#1\": expected a serial number, or # and an index below 1"});
  for (const char* wrong : {"#", "x", "12x", "-1", "#-1", "99999999999"})
    expect_words(opening(wrong, 1), {wrong, "expected a serial number"});
  expect_words(opening("65535", 1), {"every Falcon has this serial number"});
  expect_words(opening("77", 1), {"opening the device \"77\": communication"});
  expect_words(opening("", 2), {"2 devices", "dhd:SERIAL"});
  expect_words(opening("", 0), {"no device of Force Dimension is connected"});
}

TEST_F(dhd_arm, of_a_falcon_has_no_serial_number_and_an_unknown_type_is_refused) {
  fake.serial = static_cast<unsigned short>(kFalconsSerial);
  fake.type = kFalcon;
  const Identity its = arm.open("");
  EXPECT_EQ(its.serial, "");
  EXPECT_EQ(its.model.peak, 8);
  EXPECT_EQ(its.model.reach, 40);
  Arm other(fake_functions(), true);
  fake.type = 1;
  expect_words(tests::thrown_by<std::runtime_error>([&] { other.open(""); }), {"\"its name\" (type 1)"});
  Arm locked(fake_functions(), true);
  fake.available = 0;
  expect_words(tests::thrown_by<std::runtime_error>([&] { locked.open(""); }), {"another program uses"});
}

TEST_F(dhd_arm, without_a_watchdog_is_told) {
  fake.watchdog_result = -1;
  EXPECT_FALSE(arm.open("").has_watchdog);
}

TEST(dhd_words, of_every_error_and_cause_differ_and_say_what_to_do) {
  std::set<std::string> names;
  for (int error = 1; error <= 22; ++error) {
    const Meaning& meaning = meaning_of_error(error);
    EXPECT_EQ(meaning.code, error);
    EXPECT_TRUE(names.insert(meaning.name).second) << meaning.name;
    EXPECT_STRNE(meaning.advice, "");
  }
  EXPECT_STREQ(meaning_of_error(23).name, meaning_of_error(-1).name);
  for (int cause = 1; cause <= 6; ++cause) EXPECT_EQ(meaning_of_cause(cause).code, cause);
  EXPECT_NE(sentence("x", 2, "a\x1b[2J").find("a\\x1b[2J"), std::string::npos);
  EXPECT_NE(sentence("x", 2, nullptr).find("says \"\""), std::string::npos);
}

TEST(dhd_models, have_the_published_types) {
  for (const int type : {63, 33, 34, 35, 36, 37, 206, 104, 105, 203, 108, 109, 60}) {
    const Model* model = model_of(type);
    ASSERT_TRUE(model) << type;
    EXPECT_GT(model->peak, model->continuous);
    EXPECT_GE(model->reach, 40);
  }
  EXPECT_STREQ(model_of(35)->name, "omega.7");
  EXPECT_STREQ(model_of(36)->name, "omega.6");
  EXPECT_EQ(model_of(63)->peak, 20);
  EXPECT_EQ(model_of(109)->reach, 112.5F);
  EXPECT_FALSE(model_of(0));
}

TEST(dhd_library, missing_says_every_name_that_was_tried_and_what_another_lacks) {
  const std::string words = tests::thrown_by<std::runtime_error>([] { load({"libNoSuchDhd.so.9", "libm.so.6"}); });
  expect_words(words, {"Force Dimension's library (DHD) could not be loaded; tried:\n  libNoSuchDhd.so.9: ",
                       "libm.so.6: is not DHD, it lacks dhdGetDeviceCount, dhdGetAvailableCount, ", "dhdErrorGetLastStr\n",
                       "LD_LIBRARY_PATH", "FORCESHADE_DHD_LIBRARY"});
}

TEST(dhd_library, is_the_first_that_fits_and_says_its_file) {
  const Functions functions = load({"libNoSuchDhd.so.9", STAND_IN_DHD});
  EXPECT_EQ(functions.dhdGetDeviceCount(), 1);
  EXPECT_EQ(file_of(functions), "libdhd.so.3");
  EXPECT_EQ(names_to_try().size(), std::getenv("FORCESHADE_DHD_LIBRARY") ? 1U : 4U);
}

TEST(dhd_usb, finds_the_devices_and_whether_they_may_be_used) {
  const tests::TemporaryDirectory here;
  const auto plug = [&](const std::string& port, const char* vendor, const char* product, const char* number) {
    std::filesystem::create_directories(here.file("sys/bus/usb/devices/" + port));
    for (const auto& [name, value] : {std::pair{"idVendor", vendor}, std::pair{"idProduct", product}, std::pair{"busnum", "1"},
                                      std::pair{"devnum", number}})
      here.write("sys/bus/usb/devices/" + port + '/' + name, value);
  };
  EXPECT_TRUE(usb_devices(here.path()).empty());
  plug("1-1", "1451", "0402", "5");
  plug("1-2", "0403", "cb48", "12");
  plug("1-3", "0403", "6001", "13");
  std::filesystem::create_directories(here.file("dev/bus/usb/001"));
  here.write("dev/bus/usb/001/005", "");
  const std::vector<UsbDevice> found = usb_devices(here.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, "1451:0402");
  EXPECT_EQ(found[0].node, "/dev/bus/usb/001/005");
  EXPECT_TRUE(found[0].accessible);
  EXPECT_EQ(found[1].id, "0403:cb48");
  EXPECT_EQ(found[1].node, "/dev/bus/usb/001/012");
  EXPECT_FALSE(found[1].accessible);
}

}  // namespace
}  // namespace forceshade::device::dhd
