// SPDX-License-Identifier: BSD-3-Clause
// What is done in each frame of a PHANToM's driver, frame by frame: without its scheduler and on a clock of the test's own, so
// that every order of events can be had.

#include "device/phantom/phantom_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tests/device/faults/virtual_clock.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;
using namespace hdapi;
using Phase = PhantomFrames::Phase;

constexpr int kWindow = 50;

// What the driver has, what its calls fail with, and what it was told.
struct Driver {
  Eigen::Vector3d position{1, 2, 3};
  std::vector<double> temperatures{0.125, 0.25, 0.0625};
  std::array<HDlong, 6> counts{7, -8, 9, 0, 0, 0};
  HDenum calibration = kCalibrated;
  int rate = 1000;
  bool update_helps = true;
  bool stays_off = false, withholds_position = false, switched = false;
  HDerror begin = 0, get_position = 0, buttons = 0, temperature = 0, encoders = 0, joints = 0, rate_error = 0, set = 0, end = 0,
          enable = 0, safety_switch = 0;

  bool output = false;
  Eigen::Vector3d sent{0, 0, 0};
  std::vector<HDenum> updates;  // the styles of
  int readings = 0, temperature_readings = 0, encoder_readings = 0, joint_readings = 0, rate_readings = 0, checks = 0,
      switch_readings = 0, switched_on = 0, switched_off = 0;
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
      ++driver.switched_on;
      driver.output = !driver.stays_off;
    };
    it.hdDisable = [](HDenum) {
      driver.output = false;
      ++driver.switched_off;
    };
    it.hdIsEnabled = [](HDenum) -> HDboolean { return driver.output ? 1 : 0; };
    it.hdGetIntegerv = [](HDenum what, int* value) {
      if (what == kInstantaneousRate) ++driver.rate_readings;
      *value = what == kButtons ? 2 : driver.rate;
      driver.fail(what == kButtons ? driver.buttons : driver.rate_error);
    };
    it.hdGetBooleanv = [](HDenum, HDboolean* value) {
      ++driver.switch_readings;
      driver.fail(driver.safety_switch);
      *value = driver.switched ? 1 : 0;
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
        if (driver.temperature == kSuccess) std::copy(driver.temperatures.begin(), driver.temperatures.end(), values);
      } else if (what == kJointAngles) {
        ++driver.joint_readings;
        driver.fail(driver.joints);
        if (driver.joints == kSuccess) give({0.5, 0.25, -0.125});
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
      if (driver.update_helps) driver.calibration = kCalibrated;
    };
    return it;
  }();
  return hd;
}

class phantom_frames : public testing::Test {
 protected:
  void SetUp() override {
    driver = {};
    begin({});
  }

  // Frames of a millisecond, in windows of fifty.
  void begin(FrameSettings settings) {
    settings.gimbal = true;
    settings.window = kWindow;
    shared_ = std::make_unique<PhantomShared>();
    frames_ = std::make_unique<PhantomFrames>(functions(), 7, settings, *shared_);
  }
  const PhantomSample& frame(int count = 1, double milliseconds = 1) {
    for (int i = 0; i < count; ++i) {
      clock.pass(milliseconds);
      EXPECT_EQ(PhantomFrames::tick(frames_.get()), kCallbackContinue);
    }
    return shared_->samples.latest();
  }
  // As of the next frame, with a stall before it.
  void order(const Eigen::Vector3d& force, double age = 0, const Allowance& allowance = {}) {
    shared_->orders.publish(
        {.force = force, .time = clock.now() + static_cast<std::int64_t>(1e6 * (1 - age)), .allowance = allowance});
  }
  // Settled, with a force commanded that is sent.
  void push() {
    settle();
    order(kForce);
    frame();
    ASSERT_EQ(driver.sent, kForce);
  }
  void settle() {
    frame(kWindow + 1);
    ASSERT_EQ(shared_->samples.latest().phase, Phase::ready);
  }
  bool is_troubled() { return shared_->samples.latest().troubled; }
  void expect_trouble(const std::string& words) {
    ASSERT_TRUE(is_troubled()) << words;
    EXPECT_EQ(std::string(shared_->trouble.data()).substr(0, words.size()), words);
  }
  void close() { frames_->close(); }

  static inline const Eigen::Vector3d kForce{0.25, 1, -0.5}, kNone{0, 0, 0};
  static inline const Eigen::Vector3d kUncalibrated{0, -110, -35};

  faults::VirtualClock clock;
  std::unique_ptr<PhantomShared> shared_;
  std::unique_ptr<PhantomFrames> frames_;
};

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
  EXPECT_EQ(driver.sent, kForce);
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

// Whole for an eighth of 24 ms, then less and less.
TEST_F(phantom_frames, hold_no_force_for_longer_than_its_giver_may_stall) {
  begin({.watchdog_timeout = 24ms});
  push();
  for (const auto& [age, share] : {std::pair{0.0, 1.0}, {3.0, 1.0}, {13.5, 0.5}, {24.0, 0.0}}) {
    order(kForce, age);
    frame();
    EXPECT_NEAR((driver.sent - share * kForce).norm(), 0, 1e-6) << age << " ms";
    EXPECT_FALSE(is_troubled());
  }
  order(kForce, 24.1);
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
  order(kNone, 24 * 3.6e6);
  EXPECT_FALSE(frame().troubled);
  EXPECT_TRUE(driver.output);
}

// A stalled loop's force pushes a hand that withdraws; what the hand may be given is counted here, and holds all the same.
TEST_F(phantom_frames, send_no_more_than_the_hand_may_be_given_whatever_the_loop_does) {
  push();
  const Eigen::Vector3d direction = kForce.normalized();
  order(kForce, 0, {.work = 2, .longest_step = 1});
  double work = 0;
  for (int k = 0; k < 20; ++k) {
    driver.position += 0.5 * direction;
    work += driver.sent.norm() * 0.5;
    const auto& sample = frame();
    EXPECT_NEAR(sample.sent.work, work, 1e-9);
    EXPECT_LE(work + driver.sent.norm() * 1, 2 + 1e-9) << k;
    EXPECT_NEAR((sample.sent.acting.cast<double>() - driver.sent).norm(), 0, 1e-6);
  }
  EXPECT_GT(work, 1.9);
  EXPECT_FALSE(is_troubled());
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

// For as long as the servo loop may take to see it.
TEST_F(phantom_frames, send_no_force_for_a_while_after_the_safety_switch_has_changed_either_way) {
  push();
  for (const bool switched : {true, false}) {
    driver.switched = switched;
    for (int k = 0; k < 50; ++k) {
      order(kForce);
      EXPECT_FALSE(frame().forces_on) << k;
      EXPECT_EQ(driver.sent, kNone) << k;
    }
    order(kForce);
    EXPECT_TRUE(frame().forces_on);
    EXPECT_EQ(driver.sent, kForce);
    EXPECT_TRUE(driver.output) << "the driver is not told";
  }
}

TEST_F(phantom_frames, do_without_a_safety_switch) {
  driver.safety_switch = kInvalidInputType;
  push();
  EXPECT_EQ(driver.switch_readings, 1);
  EXPECT_FALSE(is_troubled());
}

TEST_F(phantom_frames, whose_safety_switch_cannot_be_read_are_trouble) {
  push();
  driver.safety_switch = kCommunication;
  frame();
  expect_trouble("reading the safety switch: communication");
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
  EXPECT_FALSE(sample.troubled);
  frame(100);
  order(kForce);
  EXPECT_EQ(frame(100).phase, Phase::closed);
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_EQ(driver.switched_off, 1);
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
