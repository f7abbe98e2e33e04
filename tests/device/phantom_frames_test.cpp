// SPDX-License-Identifier: BSD-3-Clause
// The frames of a PHANToM's driver until they are ready, what they give, and what is trouble.

#include "device/phantom/phantom_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/device/phantom_frames_fixture.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;
using namespace hdapi;
using Phase = PhantomFrames::Phase;

TEST_F(phantom_frames, switch_the_output_on_after_a_window_of_good_ones_and_send_no_force_before) {
  for (int k = 0; k <= kWindow; ++k) {
    order(kForce);
    const auto& sample = frame();
    EXPECT_EQ(driver.sent, kNone) << k;
    EXPECT_EQ(driver.output, k == kWindow) << k;
    EXPECT_EQ(sample.forces_on, k == kWindow) << k;
    EXPECT_EQ(sample.phase == Phase::ready, k == kWindow) << k;
  }
  order(kForce);
  frame();
  expect_first_of_a_ramp();
}

TEST_F(phantom_frames, without_force_are_ready_and_never_switch_the_output_on) {
  begin({.force = false});
  settle();
  order(kForce);
  EXPECT_FALSE(frame(100).forces_on);
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_EQ(driver.switched_on, 0);
}

// Rate and gaps of one window, which is then followed by good ones.
TEST_F(phantom_frames, switch_the_output_on_only_at_the_rate_and_without_long_gaps) {
  struct Case {
    double milliseconds, gap;
    bool good;
  };
  for (const auto& [milliseconds, gap, good] :
       {Case{1, 1, true}, Case{1.04, 1, true}, Case{0.96, 1, true}, Case{1.06, 1, false}, Case{0.94, 1, false},
        Case{0.8, 12, true}, Case{0.75, 13, false}}) {
    SCOPED_TRACE(testing::Message() << milliseconds << " ms, gap " << gap);
    driver = {};
    begin({});
    frame();
    frame(1, gap);
    frame(kWindow - 1, milliseconds);
    EXPECT_EQ(driver.output, good);
    frame(kWindow);
    EXPECT_TRUE(driver.output);
  }
}

TEST_F(phantom_frames, measure_their_times) {
  frame(kWindow);
  EXPECT_FALSE(frame(0).times);
  frame(1, 3.5);
  const auto& times = frame(0).times;
  ASSERT_TRUE(times);
  EXPECT_NEAR(times->rate, kWindow / 0.0525, 1e-6);
  EXPECT_NEAR(times->longest_gap, 0.0035, 1e-12);
  EXPECT_NEAR(times->late, 1.0 / kWindow, 1e-12);
}

TEST_F(phantom_frames, settle_anew_after_the_calibration_was_updated) {
  begin({.style = kCalibratesInInkwell});
  frame(29);
  driver.calibration = kCalibrationNeedsUpdate;
  frame(kWindow + 1);
  EXPECT_FALSE(driver.output);
  frame(1);
  EXPECT_TRUE(driver.output);
  EXPECT_EQ(driver.updates, std::vector<HDenum>{kCalibratesInInkwell});
}

// As a stylus out of its inkwell: nothing is wrong, and the device is ready as soon as it is calibrated.
TEST_F(phantom_frames, wait_for_a_calibration_that_takes_a_hand) {
  for (const HDenum style : {kCalibratesInInkwell, kCalibratesItself}) {
    driver = {};
    begin({.style = style});
    driver.calibration = kCalibrationNeedsHand;
    EXPECT_FALSE(frame(1000).calibrated);
    EXPECT_FALSE(is_troubled());
    EXPECT_TRUE(driver.updates.empty());
    driver.calibration = kCalibrationNeedsUpdate;
    frame();
    EXPECT_EQ(driver.updates, std::vector<HDenum>{style});
    settle();
  }
}

TEST_F(phantom_frames, update_the_calibration_again_when_once_did_not_help_but_not_in_every_frame) {
  begin({.style = kCalibratesItself});
  driver.calibration = kCalibrationNeedsUpdate;
  driver.update_helps = false;
  frame(301);
  EXPECT_EQ(driver.updates.size(), 4U);
  EXPECT_FALSE(driver.output);
}

// A position jumps when it is calibrated.
TEST_F(phantom_frames, calibrate_a_device_that_runs_only_where_it_does_so_itself_and_gives_no_force) {
  for (const HDenum style : {kCalibratesItself, kCalibratesInInkwell}) {
    driver = {};
    begin({.style = style});
    push();
    driver.calibration = kCalibrationNeedsUpdate;
    EXPECT_FALSE(frame().calibrated) << "which the supervisor trips for";
    EXPECT_TRUE(driver.updates.empty());
    order(kNone);
    frame(2);
    EXPECT_EQ(driver.updates.size(), style == kCalibratesItself ? 1U : 0U);
    EXPECT_EQ(frame().calibrated, style == kCalibratesItself);
    EXPECT_FALSE(is_troubled());
  }
}

TEST_F(phantom_frames, give_what_the_driver_gives) {
  const auto& sample = frame();
  EXPECT_EQ(sample.position, driver.position);
  EXPECT_EQ(sample.gimbal, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(sample.buttons, 2);
  EXPECT_EQ(sample.temperature, 0.25) << "the hottest motor's";
  EXPECT_EQ(sample.encoder, (std::array<std::int64_t, 3>{7, -8, 9}));
  EXPECT_EQ(sample.joints, (std::array<double, 3>{0.5, 0.25, -0.125}));
  EXPECT_EQ(sample.time, clock.now());
  EXPECT_TRUE(sample.calibrated);
  EXPECT_FALSE(sample.troubled);
}

// Driver and device of another kind: what there is not is not read again and is no trouble; any other error is.
TEST_F(phantom_frames, do_without_what_the_driver_does_not_have) {
  for (const HDerror code : {kInvalidEnum, kInvalidValue, kInvalidOperation, kInvalidInputType}) {
    driver = {};
    begin({});
    frame();
    driver.temperature = driver.encoders = driver.joints = driver.rate_error = code;
    const auto& sample = frame(5);
    EXPECT_FALSE(sample.troubled) << code;
    for (const int readings :
         {driver.temperature_readings, driver.encoder_readings, driver.joint_readings, driver.rate_readings})
      EXPECT_EQ(readings, 2) << code;
    EXPECT_EQ(sample.encoder, std::nullopt) << code;
    EXPECT_EQ(sample.joints, std::nullopt) << code;
  }
  for (const HDerror code : {HDerror{0xFF}, kBadHandle, kCommunication})
    for (const auto& [error, step] :
         {std::pair{&Driver::temperature, "reading the motors' temperatures"},
          std::pair{&Driver::encoders, "reading the encoders"}, std::pair{&Driver::joints, "reading the joint angles"},
          std::pair{&Driver::rate_error, "reading the device's update rate"}}) {
      driver = {};
      begin({});
      driver.*error = code;
      frame();
      expect_trouble(step);
    }
}

TEST_F(phantom_frames, have_room_for_the_motors_of_a_device_of_six_degrees) {
  driver.temperatures = {0.125, 0.25, 0.0625, 0.5, 0.75, 0.25};
  EXPECT_EQ(frame().temperature, 0.75);
  EXPECT_FALSE(is_troubled());
}

TEST_F(phantom_frames, with_temperatures_that_are_none_are_trouble) {
  for (const std::vector<double>& wrong :
       {std::vector{0.1, std::nan(""), 0.1}, {std::nan(""), 0.1, 0.1}, {0.1, HUGE_VAL, 0.1}, {0.1, 0.1, -0.1}, {}}) {
    driver = {};
    begin({});
    push();
    driver.temperatures = wrong;
    frame();
    expect_trouble(kNoTemperature);
    EXPECT_EQ(driver.sent, kNone);
  }
}

// The driver has reported the lost connection once, to somebody else, and the position stands still.
TEST_F(phantom_frames, of_a_device_that_answers_no_more_are_trouble) {
  push();
  driver.rate = 499;
  for (int k = 0; k < 99; ++k) {
    order(kForce);
    frame();
  }
  EXPECT_FALSE(is_troubled());
  driver.rate = 500;
  order(kForce);
  frame();
  driver.rate = 0;
  for (int k = 0; k < 100; ++k) {
    order(kForce);
    frame();
  }
  expect_trouble(kNoAnswer);
  EXPECT_EQ(driver.sent, kNone);
}

TEST_F(phantom_frames, are_not_ready_while_the_device_does_not_answer) {
  driver.rate = 0;
  frame(1000);
  EXPECT_FALSE(driver.output);
  EXPECT_FALSE(is_troubled());
  driver.rate = 1000;
  frame(kWindow);
  EXPECT_TRUE(driver.output);
}

TEST_F(phantom_frames, that_do_not_begin_are_not_read) {
  driver.begin = kCommunication;
  frame();
  EXPECT_EQ(driver.readings, 0);
  expect_trouble("beginning a frame");
}

TEST_F(phantom_frames, without_a_finite_position_are_trouble) {
  push();
  driver.withholds_position = true;
  frame();
  expect_trouble(kNotFinite);
  EXPECT_EQ(driver.sent, kNone);
}

TEST_F(phantom_frames, keep_the_first_trouble) {
  push();
  order(kForce, 1000);
  driver.buttons = kDeviceFault;
  driver.set = kForceError;
  driver.withholds_position = true;
  frame(3);
  expect_trouble("reading the buttons: the device reports a fault (error 0x0300, internal 42");
}

TEST_F(phantom_frames, keep_the_first_trouble_that_is_no_error_of_the_drivers) {
  push();
  order(kForce, 1000);
  driver.withholds_position = true;
  frame();
  driver.set = kForceError;
  frame(3);
  expect_trouble(kNotFinite);
}

TEST_F(phantom_frames, at_the_pose_of_an_uncalibrated_device_are_trouble_only_if_they_stay_there) {
  settle();
  for (int again = 0; again < 3; ++again) {
    driver.position = kUncalibrated;
    EXPECT_FALSE(frame(49).troubled);
    driver.position = kUncalibrated + Eigen::Vector3d(0, 0, 0.055);  // a step of the encoders
    EXPECT_FALSE(frame(1).troubled);
  }
  EXPECT_FALSE(frame(100).troubled) << "beside it along one axis";
  driver.position = kUncalibrated + Eigen::Vector3d(0, 5e-4, 0);
  frame(50);
  expect_trouble(kUncalibratedPose);
}

TEST_F(phantom_frames, are_not_ready_when_the_output_cannot_be_switched_on) {
  driver.enable = kDeviceFault;
  const auto& sample = frame(kWindow + 1);
  EXPECT_NE(sample.phase, Phase::ready);
  EXPECT_FALSE(sample.forces_on);
  expect_trouble("switching the force output on");
}

TEST_F(phantom_frames, are_not_ready_when_the_output_stays_off) {
  driver.stays_off = true;
  EXPECT_NE(frame(kWindow + 1).phase, Phase::ready);
  expect_trouble(kOutputStaysOff);
}

}  // namespace
}  // namespace forceshade::device
