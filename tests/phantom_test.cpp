// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM that is opened and started, or says why not.

#include "forceshade/device/phantom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/device/open_device.h"
#include "forceshade/tests/stand_in_hd/phantom_fixture.h"

namespace forceshade::device {
namespace {

std::string why_not_started(const Orders& orders, const Phantom::Options& options = kPatient) {
  tell(orders);
  Phantom phantom("", options);
  const auto fault = phantom.start(1000);
  EXPECT_EQ(seen().output, !fault);
  for (const auto& frame : seen().frames) EXPECT_TRUE(frame.force.isZero(0));
  return fault ? fault->words : "";
}

std::string why_not_opened(const Orders& orders, const std::string& name = "") {
  tell(orders);
  try {
    Phantom phantom(name);
  } catch (const DeviceError& error) {
    EXPECT_FALSE(seen().initialised);
    return error.what();
  }
  return "";
}

TEST_F(phantom, opened_moves_nothing_and_switches_nothing_on) {
  const auto device = open_device("phantom");
  EXPECT_TRUE(seen().initialised);
  EXPECT_FALSE(seen().name);
  EXPECT_FALSE(seen().output);
  EXPECT_FALSE(seen().scheduler);
  EXPECT_TRUE(seen().frames.empty());
  EXPECT_FALSE(device->state().forces_on);
  EXPECT_STREQ(std::get<Fault>(device->read()).words, "the PHANToM was not started");
  EXPECT_FALSE(device->command({0, 0, 1}));
}

TEST_F(phantom, is_opened_by_name) {
  open_device("phantom:Default PHANToM");
  EXPECT_EQ(seen().name, "Default PHANToM");
}

TEST_F(phantom, says_what_the_driver_says_it_can_do) {
  const Phantom device("");
  const Capabilities can = device.capabilities();
  EXPECT_EQ(can.model, "Stand-in 1.5");
  EXPECT_EQ(can.workspace_low, Eigen::Vector3f(-190, -137, -95));
  EXPECT_EQ(can.workspace_high, Eigen::Vector3f(191, 130, 96));
  EXPECT_EQ(can.peak_force, 8.5F);
  EXPECT_EQ(can.continuous_force, 1.4F);
  EXPECT_EQ(can.highest_rate, 1000);
  EXPECT_TRUE(can.gimbal);
}

TEST_F(phantom, assumes_the_coarsest_encoders_a_frame_of_latency_and_every_button_of_the_driver) {
  const Phantom device("");
  const Capabilities can = device.capabilities();
  EXPECT_EQ(can.resolution, 0.055F);
  EXPECT_TRUE(can.latency);
  EXPECT_EQ(can.buttons, 4);
}

TEST_F(phantom, without_a_measured_gimbal_has_none) {
  tell({.input_degrees = 3});
  Phantom device("", kPatient);
  EXPECT_FALSE(device.capabilities().gimbal);
  ASSERT_FALSE(device.start(1000));
  EXPECT_EQ(std::get<Reading>(device.read()).gimbal, std::nullopt);
}

TEST_F(phantom, is_not_blamed_for_an_error_that_another_user_of_the_driver_left) {
  const hdapi::Functions& hd = hdapi::vendor();
  hd.hdEnable(1);
  EXPECT_NO_THROW(Phantom(""));
}

TEST_F(phantom, init_that_fails_without_an_error_says_so) {
  expect_words(why_not_opened({.init_fails_silently = true}), {"the driver says no more", "permission"});
}

TEST_F(phantom, is_driven_once_at_a_time) {
  const Phantom first("");
  try {
    Phantom second("");
    FAIL();
  } catch (const DeviceError& error) {
    expect_words(error.what(), {"drives a PHANToM already"});
  }
}

TEST_F(phantom, can_be_opened_again_after_it_was_closed) {
  for (int i = 0; i < 2; ++i) EXPECT_EQ(why_not_started({}), "");
  EXPECT_NE(why_not_opened({.init = hdapi::kCommunication}), "");
  EXPECT_EQ(why_not_started({}), "");
}

TEST_F(phantom, init_failure_says_what_to_check) {
  expect_words(why_not_opened({.init = hdapi::kDeviceFault}, "Left arm"),
               {"0x0300", "internal 42", "Some error.", "\"Left arm\" must be written", "permission", "licence", "cable"});
  expect_words(why_not_opened({.init = hdapi::kCommunication}), {"the default device was asked for", "Default PHANToM"});
}

TEST_F(phantom, missing_licence_and_busy_device_are_said_without_guessing) {
  for (const auto& [code, words] : {std::pair{hdapi::kNoLicence, "the vendor's licence is missing"},
                                    std::pair{hdapi::kAlreadyInitiated, "close the program that has it open"}}) {
    const std::string why = why_not_opened({.init = code});
    expect_words(why, {words});
    EXPECT_EQ(why.find("permission"), std::string::npos);
  }
}

TEST_F(phantom, without_a_highest_force_is_refused) {
  expect_words(why_not_opened({.peak_force = Answer::fails(hdapi::kInvalidEnum)}), {"highest force", "0x0100"});
  for (const double peak : {0.0, -1.0, std::nan(""), HUGE_VAL})
    expect_words(why_not_opened({.peak_force = peak}), {"expected a positive number"});
}

TEST_F(phantom, start_names_the_step_that_failed) {
  expect_words(why_not_started({.schedule = hdapi::kSchedulerFull}), {"scheduling the frames", "0x0501"});
  expect_words(why_not_started({.start = hdapi::kTimer}), {"starting the driver's scheduler", "0x0304"});
  expect_words(why_not_started({.begin = hdapi::kCommunication}), {"beginning a frame", "communication", "0x0302"});
  expect_words(why_not_started({.get_position = hdapi::kDeviceFault}), {"reading the position", "0x0300"});
  expect_words(why_not_started({.output_stays_off = true}), {"is still off"});
}

TEST_F(phantom, is_not_started_again_after_a_start_that_failed) {
  tell({.schedule = hdapi::kSchedulerFull});
  Phantom device("", kPatient);
  EXPECT_TRUE(device.start(1000));
  tell({});
  const auto fault = device.start(1000);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->words, "the PHANToM was started before");
  EXPECT_FALSE(seen().scheduler);
}

TEST_F(phantom, start_asks_for_the_loops_rate_and_says_when_it_is_refused) {
  {
    Phantom device("", kPatient);
    EXPECT_FALSE(device.start(500));
    EXPECT_EQ(seen().rate, 500);
    EXPECT_STREQ(device.start(500)->words, "the PHANToM was started before");
  }
  tell({.rate = hdapi::kInvalidValue});
  Phantom device("", kPatient);
  const auto fault = device.start(3000);
  ASSERT_TRUE(fault);
  expect_words(fault->words, {"setting the driver's rate", "0x0101"});
}

TEST_F(phantom, uncalibrated_is_not_started) {
  expect_words(why_not_started({.calibration = hdapi::kCalibrationNeedsHand}), {"not calibrated", "inkwell"});
  EXPECT_EQ(seen().updates, 0);
  // At the reset pose only the user can know.
  expect_words(why_not_started({.calibration = hdapi::kCalibrationNeedsUpdate, .styles = 1}), {"not calibrated", "reset pose"});
  EXPECT_EQ(seen().updates, 0);
}

TEST_F(phantom, calibration_is_updated_where_the_driver_can_and_once_only) {
  EXPECT_EQ(why_not_started({.calibration = hdapi::kCalibrationNeedsUpdate}), "");
  EXPECT_EQ(seen().updates, 1);
  EXPECT_EQ(why_not_started({.calibration = hdapi::kCalibrationNeedsUpdate, .styles = 2}), "");
  EXPECT_EQ(seen().updates, 2);
  expect_words(why_not_started({.calibration = hdapi::kCalibrationNeedsUpdate, .update_helps = false}), {"not calibrated"});
  EXPECT_EQ(seen().updates, 3);
}

TEST_F(phantom, frozen_in_the_uncalibrated_pose_is_told_from_one_that_rests) {
  expect_words(why_not_started({.position = Eigen::Vector3d(0, -110, -35)}), {"(0, -110, -35)", "inkwell"});
  EXPECT_EQ(why_not_started({.position = Eigen::Vector3d(0, -110.055, -35)}), "");
}

TEST_F(phantom, position_that_is_not_finite_is_a_fault) {
  for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_EQ(why_not_started({.position = Eigen::Vector3d(0, wrong, 0)}), hdapi::kNotFinite);
}

TEST_F(phantom, waits_for_a_driver_that_hangs_no_longer_than_promised) {
  const auto before = Clock::now();
  EXPECT_EQ(why_not_started({.hung = true}, {.start = 100ms}), hdapi::kNoFrames);
  EXPECT_EQ(why_not_started({.frame_time = 10ms}, {.start = 100ms}), hdapi::kNotReady);
  EXPECT_LE(Clock::now() - before, 5s);
}

TEST_F(phantom, motors_that_predict_no_temperature_are_no_fault) {
  EXPECT_EQ(why_not_started({.temperature = Answer::fails(hdapi::kInvalidEnum)}), "");
  expect_words(why_not_started({.temperature = Answer::fails(hdapi::kCommunication)}), {"temperatures", "0x0302"});
}

}  // namespace
}  // namespace forceshade::device
