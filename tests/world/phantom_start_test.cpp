// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM that is opened and started, or says why not.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/phantom/hdapi_words.h"
#include "device/phantom/phantom.h"
#include "forceshade/device.h"
#include "tests/world/phantom_fixture.h"

namespace forceshade::world {
namespace {

std::string why_not_started(const Orders& orders, const Phantom::Options& options = kPatient, Attends listener = {}) {
  tell(orders);
  Phantom phantom = opened(options, listener);
  const auto fault = phantom.start(1000);
  EXPECT_EQ(seen().output, !fault);
  for (const auto& frame : seen().frames) EXPECT_TRUE(frame.force.isZero(0));
  return fault ? fault->words : "";
}

std::string why_not_opened(const Orders& orders, const std::string& name = "") {
  tell(orders);
  const std::string words = tests::thrown_by<DeviceError>([&] { Phantom device = opened(kPatient, nobody(), name); });
  EXPECT_FALSE(seen().initialised);
  return words;
}

IN_WORLD(opened_moves_nothing_and_switches_nothing_on) {
  Phantom device = opened();
  EXPECT_TRUE(seen().initialised);
  EXPECT_FALSE(seen().name);
  EXPECT_FALSE(seen().output);
  EXPECT_FALSE(seen().scheduler);
  EXPECT_TRUE(seen().frames.empty());
  EXPECT_FALSE(device.state().forces_on);
  EXPECT_STREQ(std::get<Fault>(device.read()).words, "the PHANToM was not started");
  EXPECT_FALSE(device.command({0, 0, 1}));
}

IN_WORLD(is_opened_by_name) {
  const Phantom device = opened({}, nobody(), "Default PHANToM");
  EXPECT_EQ(seen().name, "Default PHANToM");
}

IN_WORLD(says_what_the_driver_says_it_can_do) {
  Attends listener;
  Phantom device = opened({}, listener);
  const Capabilities can = device.capabilities();
  EXPECT_EQ(can.model, "Stand-in 1.5");
  EXPECT_EQ(can.serial, "S-0042");
  EXPECT_EQ(can.driver, "4.3.3");
  EXPECT_EQ(can.firmware, "192");
  EXPECT_EQ(can.workspace_low, Eigen::Vector3f(-190, -137, -95));
  EXPECT_EQ(can.workspace_high, Eigen::Vector3f(191, 130, 96));
  EXPECT_EQ(can.continuous_force, 1.4F);
  // A twentieth below what the driver ends a run for.
  EXPECT_FLOAT_EQ(can.peak_force, 0.95F * 8.5F);
  EXPECT_NEAR(can.highest_speed, 0.95 * 1500, 1e-9);
  EXPECT_NEAR(can.highest_slew, 0.95 * 4000, 1e-9);
  EXPECT_EQ(can.highest_rate, 1000);
  EXPECT_TRUE(can.gimbal);
  EXPECT_TRUE(can.paces);
  // Capabilities that no driver states: the coarsest encoders, a frame of latency, every button that it has a bit for.
  EXPECT_EQ(can.resolution, 0.055F);
  EXPECT_TRUE(can.latency);
  EXPECT_EQ(can.buttons, 4);
  EXPECT_EQ(listener.heard, "") << "no limit is missing";
}

IN_WORLD(init_that_fails_without_an_error_says_so) {
  expect_words(why_not_opened({.init_fails_silently = true}), {"the driver says no more", "permission"});
}

IN_WORLD(init_failure_says_what_to_check) {
  expect_words(why_not_opened({.init = hdapi::kDeviceFault}, "Left arm"),
               {"0x0300", "internal 42", "Some error.", "\"Left arm\" must be written", "permission", "licence", "cable"});
  expect_words(why_not_opened({.init = hdapi::kCommunication}), {"the default device was asked for", "Default PHANToM"});
  expect_words(why_not_opened({.init = hdapi::kInvalidValue}), {"0x0101", "a name that it does not find there"});
}

IN_WORLD(missing_licence_and_busy_device_are_said_without_guessing) {
  for (const auto& [code, words] : {std::pair{hdapi::kNoLicence, "the vendor's licence is missing"},
                                    std::pair{hdapi::kAlreadyInitiated, "close the program that has it open"}}) {
    const std::string why = why_not_opened({.init = code});
    expect_words(why, {words});
    EXPECT_EQ(why.find("permission"), std::string::npos);
  }
}

IN_WORLD(without_a_highest_force_is_refused) {
  expect_words(why_not_opened({.peak_force = Answer::fails(hdapi::kInvalidEnum)}), {"highest force", "does not say"});
  for (const Answer& peak : {Answer(0.0), Answer(-1.0), Answer(std::nan("")), Answer(HUGE_VAL), Answer::nothing()})
    expect_words(why_not_opened({.peak_force = peak}), {"highest force: expected a number of newtons above 0"});
}

IN_WORLD(can_be_opened_again_after_it_was_closed) {
  EXPECT_EQ(why_not_started({}), "");
  EXPECT_NE(why_not_opened({.init = hdapi::kCommunication}), "");
  EXPECT_EQ(why_not_started({}), "");
}

IN_WORLD(start_names_the_step_that_failed) {
  expect_words(why_not_started({.schedule = hdapi::kSchedulerFull}), {"scheduling the frames", "0x0501"});
  expect_words(why_not_started({.start = hdapi::kTimer}), {"starting the driver's scheduler", "0x0304"});
  expect_words(why_not_started({.begin = hdapi::kCommunication}), {"beginning a frame", "communication", "0x0302"});
  expect_words(why_not_started({.get_position = hdapi::kDeviceFault}), {"reading the position", "0x0300"});
  expect_words(why_not_started({.output_stays_off = true}), {"is still off"});
  expect_words(why_not_started({.temperature = Answer::fails(hdapi::kCommunication)}), {"temperatures", "0x0302"});
}

// Reported by hdStartScheduler, which has started it all the same: frames run while it is decided to give up, and nothing of
// theirs may be gone before they are.
IN_WORLD(error_that_the_scheduler_starts_with_is_a_fault_and_the_frames_end_in_order) {
  expect_words(why_not_started({.start_with_error = hdapi::kTimer}), {"starting the driver's scheduler", "0x0304"});
  EXPECT_FALSE(seen().scheduler);
  EXPECT_FALSE(seen().initialised);
}

IN_WORLD(is_not_started_again_after_a_start_that_failed) {
  tell({.schedule = hdapi::kSchedulerFull});
  Phantom device = opened(kPatient);
  EXPECT_TRUE(device.start(1000));
  tell({});
  const auto fault = device.start(1000);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->words, "the PHANToM was started before");
  EXPECT_FALSE(seen().scheduler);
}

IN_WORLD(start_sets_the_loops_rate_and_says_when_it_is_refused) {
  {
    Phantom device = opened(kPatient);
    EXPECT_FALSE(device.start(500));
    EXPECT_EQ(seen().rate, 500);
    EXPECT_STREQ(device.start(500)->words, "the PHANToM was started before");
  }
  tell({.rate = hdapi::kInvalidValue});
  Phantom device = opened(kPatient);
  const auto fault = device.start(3000);
  ASSERT_TRUE(fault);
  expect_words(fault->words, {"setting the driver's rate", "0x0101"});
}

IN_WORLD(frozen_in_the_uncalibrated_pose_is_told_from_one_that_rests) {
  expect_words(why_not_started({.position = Eigen::Vector3d(0, -110, -35)}), {"(0, -110, -35)", "inkwell"});
  EXPECT_EQ(why_not_started({.position = Eigen::Vector3d(0, -110.055, -35)}), "");
}

IN_WORLD(position_that_is_not_finite_is_a_fault) {
  for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_EQ(why_not_started({.position = Eigen::Vector3d(0, wrong, 0)}), hdapi::kNotFinite);
}

IN_WORLD(waits_for_a_driver_that_hangs_no_longer_than_promised) {
  Phantom::Options hasty = kPatient;
  hasty.start = 100ms;
  EXPECT_EQ(why_not_started({.hung = true}, hasty), hdapi::kNoFrames);
}

IN_WORLD(says_how_good_its_frames_were_and_what_priority_they_have) {
  Attends listener;
  Phantom device = opened(kPatient, listener);
  ASSERT_FALSE(device.start(1000));
  expect_words(listener.heard, {"the driver's thread has ", " priority", " frames a second, ", "longest gap"});
}

IN_WORLD(without_what_not_every_model_has_is_started_and_says_which_watch_is_off) {
  const Answer none = Answer::fails(hdapi::kInvalidEnum);
  tell({.temperature = none, .encoders = none, .joint_angles = none, .instantaneous_rate = none, .input_degrees = 3});
  Attends listener;
  Phantom device = opened(kPatient, listener);
  EXPECT_FALSE(device.capabilities().gimbal);
  ASSERT_FALSE(device.start(1000));
  const auto reading = std::get<Reading>(device.read());
  EXPECT_EQ(reading.gimbal, std::nullopt);
  EXPECT_EQ(reading.encoder, std::nullopt);
  EXPECT_EQ(reading.joints, std::nullopt);
  expect_words(listener.heard, {"temperatures", "update rate"});
}

IN_WORLD(of_six_motors_gives_the_temperature_of_the_hottest) {
  tell({.temperature = 0.5, .output_degrees = 6});
  Phantom device = opened(kPatient);
  ASSERT_FALSE(device.start(1000));
  ASSERT_TRUE(std::holds_alternative<Reading>(device.read()));
  EXPECT_EQ(device.state().temperature, 0.5F);
}

// A Premium: each process has to calibrate it anew, in a pose that only the user can see.
IN_WORLD(that_calibrates_in_its_reset_pose_starts_once_the_user_holds_it_there) {
  tell({.calibration = std::nullopt, .styles = hdapi::kCalibratesAtResetPose});
  for (int program = 0; program < 2; ++program) {
    Attends listener;
    listener.does = true;
    Phantom device = opened(kPatient, listener);
    ASSERT_FALSE(device.start(1000));
    EXPECT_EQ(listener.asked, std::vector<std::string>{hdapi::kHoldInResetPose});
    EXPECT_EQ(seen().updates, program + 1);
    EXPECT_TRUE(std::holds_alternative<Reading>(device.read()));
    EXPECT_TRUE(device.state().calibrated);
  }
}

IN_WORLD(that_nobody_holds_in_its_reset_pose_is_not_started_and_runs_no_frame) {
  tell({.calibration = std::nullopt, .styles = hdapi::kCalibratesAtResetPose});
  Attends listener;
  Phantom device = opened(kPatient, listener);
  const auto fault = device.start(1000);
  ASSERT_TRUE(fault);
  expect_words(fault->words, {"not calibrated", "reset pose"});
  EXPECT_EQ(listener.asked.size(), 1U);
  EXPECT_EQ(seen().updates, 0);
  EXPECT_TRUE(seen().frames.empty());
}

IN_WORLD(whose_arm_is_elsewhere_than_the_user_says_is_not_started) {
  tell({.calibration = std::nullopt, .styles = hdapi::kCalibratesAtResetPose, .in_reset_pose = false});
  Attends listener;
  listener.does = true;
  Phantom device = opened(kPatient, listener);
  const auto fault = device.start(1000);
  ASSERT_TRUE(fault);
  expect_words(fault->words, {"not calibrated"});
  EXPECT_EQ(listener.asked.size(), 3U);
  EXPECT_EQ(seen().updates, 3);
  EXPECT_TRUE(seen().frames.empty());
}

IN_WORLD(with_slow_frames_or_frames_far_from_the_rate_is_not_started_and_says_what_was_measured) {
  expect_words(why_not_started({.frame_time = 10ms}, {.start = 100ms}), {"runs its frames too slowly"});
  expect_words(why_not_started({.instantaneous_rate = 1000, .frame_hz = 800}, {.watchdog_timeout = 2s, .start = 1500ms}),
               {"too irregular", "expected 1000 frames a second", "late, longest gap"});
}

IN_WORLD(that_does_not_answer_its_driver_is_not_started_though_no_error_is_reported) {
  expect_words(why_not_started({.instantaneous_rate = 0}, {.watchdog_timeout = 2s, .start = 1200ms, .rate_tolerance = 1}),
               {"no longer answers", "check cable and power"});
}

// Waits while frames run, without force, until the user has done what is asked.
IN_WORLD(waits_with_words_for_a_calibration_in_the_inkwell_and_for_one_by_itself) {
  struct Case {
    int styles;
    const char* words;
    Orders then;
  };
  for (const auto& [styles, words, then] :
       {Case{hdapi::kCalibratesInInkwell,
             hdapi::kRestInInkwell,
             {.calibration = std::nullopt, .styles = hdapi::kCalibratesInInkwell, .in_inkwell = true}},
        Case{hdapi::kCalibratesItself,
             hdapi::kMoveItAbout,
             {.calibration = std::nullopt, .styles = hdapi::kCalibratesItself}}}) {
    tell({.calibration = std::nullopt, .styles = styles, .update_helps = false});
    Attends listener;
    listener.on_words = [&, orders = then](const std::string& heard) {
      if (heard.find("waiting for") == std::string::npos) return;
      EXPECT_FALSE(seen().output);
      tell(orders);
    };
    Phantom device = opened(kPatient, listener);
    ASSERT_FALSE(device.start(1000));
    expect_words(listener.heard, {std::string("waiting for the PHANToM's calibration: ") + words});
    EXPECT_TRUE(listener.asked.empty());
    EXPECT_GE(seen().updates, 1);
  }
}

IN_WORLD(is_waited_for_no_longer_than_promised_while_it_is_not_calibrated) {
  Phantom::Options hasty = kPatient;
  hasty.calibration = 200ms;
  expect_words(why_not_started({.calibration = hdapi::kCalibrationNeedsHand}, hasty), {"not calibrated", "inkwell"});
  EXPECT_EQ(seen().updates, 0);
}

IN_WORLD(is_not_waited_for_by_a_user_who_has_left) {
  tell({.calibration = hdapi::kCalibrationNeedsHand});
  Attends listener;
  listener.on_words = [&](const std::string&) { listener.leaves = true; };
  Phantom device = opened(kPatient, listener);
  const auto fault = device.start(1000);
  ASSERT_TRUE(fault);
  expect_words(fault->words, {"stopped before the PHANToM was ready"});
}

}  // namespace
}  // namespace forceshade::world
