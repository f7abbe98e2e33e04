// SPDX-License-Identifier: BSD-3-Clause
// What is done in each frame of a PHANToM's driver, frame by frame: without its scheduler, so that every order of events can
// be had.

#include "forceshade/device/phantom_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;
using namespace hdapi;
using Clock = PhantomFrames::Clock;
using Phase = PhantomFrames::Phase;

// What the driver has, what its calls fail with, and what it was told.
struct Driver {
  Eigen::Vector3d position{1, 2, 3}, temperatures{0.125, 0.25, 0.0625};
  std::array<HDlong, 6> counts{7, -8, 9, 0, 0, 0};
  HDenum calibration = kCalibrated;
  int styles = kCalibratesInInkwell;
  bool stays_off = false, withholds_position = false;
  HDerror begin = 0, get_position = 0, buttons = 0, temperature = 0, encoders = 0, set = 0, end = 0, enable = 0;

  bool output = false;
  Eigen::Vector3d sent{0, 0, 0};
  std::vector<HDenum> updates;  // the styles of
  int readings = 0, temperature_readings = 0, encoder_readings = 0, checks = 0, switched_off = 0;
  std::vector<HDErrorInfo> errors;

  void fail(HDerror code) {
    if (code != kSuccess) errors.push_back({code, 42, 7});
  }
} driver;

const Functions& functions() {
  static const Functions hd = [] {
    Functions it{};
    it.hdBeginFrame = [](HHD) { driver.fail(driver.begin); };
    it.hdEndFrame = [](HHD) { driver.fail(driver.end); };
    it.hdGetErrorString = [](HDerror) { return "Some error."; };
    it.hdGetError = [] {
      if (driver.errors.empty()) return HDErrorInfo{};
      const HDErrorInfo last = driver.errors.back();
      driver.errors.pop_back();
      return last;
    };
    it.hdEnable = [](HDenum) {
      driver.fail(driver.enable);
      driver.output = !driver.stays_off;
    };
    it.hdDisable = [](HDenum) {
      driver.output = false;
      ++driver.switched_off;
    };
    it.hdIsEnabled = [](HDenum) -> HDboolean { return driver.output ? 1 : 0; };
    it.hdGetIntegerv = [](HDenum what, int* value) {
      *value = what == kButtons ? 2 : driver.styles;
      if (what == kButtons) driver.fail(driver.buttons);
    };
    it.hdGetLongv = [](HDenum, HDlong* values) {
      ++driver.encoder_readings;
      driver.fail(driver.encoders);
      if (driver.encoders == kSuccess) std::copy(driver.counts.begin(), driver.counts.end(), values);
    };
    it.hdGetDoublev = [](HDenum what, double* values) {
      const auto give = [&](const Eigen::Vector3d& v) { std::copy(v.begin(), v.end(), values); };
      if (what == kPosition) {
        ++driver.readings;
        driver.fail(driver.get_position);
        if (driver.get_position == kSuccess && !driver.withholds_position) give(driver.position);
      } else if (what == kMotorTemperature) {
        ++driver.temperature_readings;
        driver.fail(driver.temperature);
        if (driver.temperature == kSuccess) give(driver.temperatures);
      } else {
        give({0.1, 0.2, 0.3});
      }
    };
    it.hdSetDoublev = [](HDenum, const double* values) {
      driver.fail(driver.set);
      driver.sent = {values[0], values[1], values[2]};
    };
    it.hdCheckCalibration = [] {
      ++driver.checks;
      return driver.calibration;
    };
    it.hdUpdateCalibration = [](HDenum style) {
      driver.updates.push_back(style);
      driver.calibration = kCalibrated;
    };
    return it;
  }();
  return hd;
}

class phantom_frames : public testing::Test {
 protected:
  void SetUp() override { driver = {}; }

  const PhantomFrames::Sample& frame(int count = 1) {
    for (int i = 0; i < count; ++i) EXPECT_EQ(PhantomFrames::tick(&frames_), kCallbackContinue);
    return frames_.samples.latest();
  }
  void order(const Eigen::Vector3d& force, Clock::duration age = 0s) {
    frames_.orders.publish({.force = force, .time = Clock::now() - age});
  }
  // Settled, with a force commanded that is sent.
  void push() {
    frame(PhantomFrames::kSettling);
    order(kForce);
    frame();
    ASSERT_EQ(driver.sent, kForce);
  }
  void expect_trouble(const std::string& words) {
    const Trouble trouble = frames_.samples.latest().trouble;
    ASSERT_TRUE(trouble) << words;
    EXPECT_EQ(trouble.words, words);
  }
  void close() { frames_.orders.publish({.time = Clock::now(), .close = true}); }

  static inline const Eigen::Vector3d kForce{0.25, 1, -0.5}, kNone{0, 0, 0};
  static inline const Eigen::Vector3d kUncalibrated{0, -110, -35};

 private:
  PhantomFrames frames_{functions(), 7, true, 10min};
};

TEST_F(phantom_frames, switch_the_output_on_after_fifty_good_ones_and_send_no_force_before) {
  order(kForce);
  for (int k = 1; k <= 50; ++k) {
    const auto& sample = frame();
    EXPECT_EQ(driver.sent, kNone) << k;
    EXPECT_EQ(driver.output, k == 50) << k;
    EXPECT_EQ(sample.forces_on, k == 50) << k;
    EXPECT_EQ(sample.phase == Phase::ready, k == 50) << k;
  }
  frame();
  EXPECT_EQ(driver.sent, kForce);
  EXPECT_EQ(driver.checks, 50) << "of the calibration, while it settles";
}

TEST_F(phantom_frames, settle_anew_after_the_calibration_was_updated) {
  frame(29);
  driver.calibration = kCalibrationNeedsUpdate;
  frame(49);
  EXPECT_FALSE(driver.output);
  frame(1);
  EXPECT_TRUE(driver.output);
  EXPECT_EQ(driver.updates, std::vector<HDenum>{kCalibratesInInkwell});
}

TEST_F(phantom_frames, update_the_calibration_as_the_device_can_the_inkwell_first) {
  for (const auto& [styles, expected] : {std::pair{2, 2U}, std::pair{4, 4U}, std::pair{7, 4U}, std::pair{3, 2U}}) {
    driver = {};
    PhantomFrames fresh(functions(), 7, true, 10min);
    driver.calibration = kCalibrationNeedsUpdate;
    driver.styles = styles;
    PhantomFrames::tick(&fresh);
    EXPECT_EQ(driver.updates, std::vector<HDenum>{expected}) << styles;
    EXPECT_FALSE(fresh.samples.latest().trouble) << styles;
  }
}

TEST_F(phantom_frames, update_the_calibration_once) {
  driver.calibration = kCalibrationNeedsUpdate;
  frame();
  driver.calibration = kCalibrationNeedsUpdate;
  EXPECT_FALSE(frame().calibrated);
  expect_trouble(kNotCalibrated);
  EXPECT_EQ(driver.updates.size(), 1U);
}

TEST_F(phantom_frames, of_a_device_that_only_a_hand_can_calibrate_are_trouble) {
  driver.calibration = kCalibrationNeedsHand;
  EXPECT_FALSE(frame().calibrated);
  expect_trouble(kNotCalibrated);
  EXPECT_TRUE(driver.updates.empty());
}

TEST_F(phantom_frames, give_what_the_driver_gives) {
  const auto& sample = frame();
  EXPECT_EQ(sample.position, driver.position);
  EXPECT_EQ(sample.gimbal, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(sample.buttons, 2);
  EXPECT_EQ(sample.temperature, 0.25) << "the hottest motor's";
  EXPECT_EQ(sample.encoder, (std::array<std::int64_t, 3>{7, -8, 9}));
  EXPECT_TRUE(sample.calibrated);
  EXPECT_FALSE(sample.trouble);
}

// Driver and device of another kind: what is not known is not asked again and is no trouble; any other error is.
TEST_F(phantom_frames, do_without_what_the_driver_does_not_know) {
  for (const HDerror code : {kInvalidEnum, kInvalidValue, kInvalidOperation, kInvalidInputType}) {
    driver = {};
    PhantomFrames fresh(functions(), 7, true, 10min);
    PhantomFrames::tick(&fresh);
    driver.temperature = driver.encoders = code;
    for (int k = 0; k < 5; ++k) PhantomFrames::tick(&fresh);
    EXPECT_FALSE(fresh.samples.latest().trouble) << code;
    EXPECT_EQ(driver.temperature_readings, 2) << code;
    EXPECT_EQ(driver.encoder_readings, 2) << code;
    EXPECT_EQ(fresh.samples.latest().encoder, std::nullopt) << code;
  }
  for (const HDerror code : {HDerror{0xFF}, kBadHandle, kCommunication})
    for (const bool of_encoders : {false, true}) {
      driver = {};
      PhantomFrames fresh(functions(), 7, true, 10min);
      (of_encoders ? driver.encoders : driver.temperature) = code;
      PhantomFrames::tick(&fresh);
      ASSERT_TRUE(fresh.samples.latest().trouble) << code;
      EXPECT_STREQ(fresh.samples.latest().trouble.words,
                   of_encoders ? "reading the encoders" : "reading the motors' temperatures");
    }
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
  order(kForce, 20min);
  driver.buttons = kDeviceFault;
  driver.set = kForceError;
  driver.withholds_position = true;
  frame(3);
  expect_trouble("reading the buttons");
}

TEST_F(phantom_frames, keep_the_first_trouble_that_is_no_error_of_the_drivers) {
  push();
  order(kForce, 20min);
  driver.withholds_position = true;
  frame();
  driver.set = kForceError;
  frame(3);
  expect_trouble(kNotFinite);
}

TEST_F(phantom_frames, hold_no_force_for_longer_than_its_giver_may_stall) {
  push();
  order(kForce, 9min);
  frame();
  EXPECT_EQ(driver.sent, kForce);
  order(kForce, 11min);
  frame();
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_FALSE(driver.output);
  expect_trouble(kStalled);
  order(kForce);
  frame();
  EXPECT_EQ(driver.sent, kNone) << "not again after trouble";
}

TEST_F(phantom_frames, hold_no_force_for_as_long_as_need_be) {
  push();
  order(kNone, 24h);
  EXPECT_FALSE(frame().trouble);
  EXPECT_TRUE(driver.output);
}

// By an emergency switch, say: when it comes on again, the next force is sent.
TEST_F(phantom_frames, send_no_force_while_the_output_is_off) {
  push();
  driver.output = false;
  EXPECT_FALSE(frame().forces_on);
  EXPECT_EQ(driver.sent, kNone);
  driver.output = true;
  EXPECT_TRUE(frame().forces_on);
  EXPECT_EQ(driver.sent, kForce);
}

TEST_F(phantom_frames, after_trouble_with_a_force_sent_send_zero_before_they_are_closed) {
  push();
  driver.end = kExceededForce;
  EXPECT_NE(frame().phase, Phase::closed);
  EXPECT_FALSE(frame().forces_on);
  EXPECT_FALSE(driver.output);
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_EQ(frame().phase, Phase::closed);
}

TEST_F(phantom_frames, close_with_zero_sent_and_the_output_off_for_good) {
  push();
  close();
  const auto& sample = frame();
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_FALSE(driver.output);
  EXPECT_FALSE(sample.forces_on);
  EXPECT_EQ(sample.phase, Phase::closed);
  EXPECT_FALSE(sample.trouble);
  frame(100);
  order(kForce);
  EXPECT_EQ(frame(100).phase, Phase::closed);
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_EQ(driver.switched_off, 1);
}

TEST_F(phantom_frames, at_the_pose_of_an_uncalibrated_device_are_trouble_only_if_they_stay_there) {
  push();
  for (int again = 0; again < 3; ++again) {
    driver.position = kUncalibrated;
    EXPECT_FALSE(frame(49).trouble);
    driver.position = kUncalibrated + Eigen::Vector3d(0, 0, 0.055);  // a step of the encoders
    EXPECT_FALSE(frame(1).trouble);
  }
  EXPECT_FALSE(frame(100).trouble) << "beside it along one axis";
  driver.position = kUncalibrated + Eigen::Vector3d(0, 5e-4, 0);
  frame(50);
  expect_trouble(kUncalibratedPose);
}

TEST_F(phantom_frames, are_not_ready_when_the_output_cannot_be_switched_on) {
  driver.enable = kDeviceFault;
  const auto& sample = frame(PhantomFrames::kSettling);
  EXPECT_NE(sample.phase, Phase::ready);
  EXPECT_FALSE(sample.forces_on);
  expect_trouble("switching the force output on");
}

TEST_F(phantom_frames, are_not_ready_when_the_output_stays_off) {
  driver.stays_off = true;
  EXPECT_NE(frame(PhantomFrames::kSettling).phase, Phase::ready);
  expect_trouble(kOutputStaysOff);
}

}  // namespace
}  // namespace forceshade::device
