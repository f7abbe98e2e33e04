// SPDX-License-Identifier: BSD-3-Clause
// The frames of a PHANToM's driver, one by one, without its scheduler and on a clock of the test's own.

#include "device/phantom/phantom_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/world/world.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;
using namespace hdapi;
using Phase = PhantomFrames::Phase;

constexpr int kWindow = 50;
constexpr HHD kDevice = 7;

// The driver's state, the errors that its calls return, and the orders that it got.
struct Driver {
  Eigen::Vector3d position{1, 2, 3};
  std::vector<double> temperatures{0.125, 0.25, 0.0625};
  HDenum calibration = kCalibrated;
  int rate = 1000;
  bool update_helps = true, withholds_position = false, switched = false;
  HDerror begin = 0, end = 0, enable = 0;
  std::map<HDenum, HDerror> fails;  // by what is read or set

  bool output = false;
  Eigen::Vector3d sent{0, 0, 0};
  std::vector<HDenum> updates;  // the styles of
  std::map<HDenum, int> readings;
  int switched_off = 0;
  std::vector<HDErrorInfo> errors;

  void fail(HDerror code) {
    if (code != kSuccess) errors.push_back({code, 42, kDevice});
  }
  // Gives the values, or the error that is ordered for it.
  void give(HDenum what, const auto& values, auto* to) {
    ++readings[what];
    fail(fails[what]);
    if (fails[what] == kSuccess) std::copy(values.begin(), values.end(), to);
  }
};
Driver driver;

Functions functions() {
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
  it.hdEnable = [](HDenum) { driver.fail(driver.enable), driver.output = true; };
  it.hdDisable = [](HDenum) { driver.output = false, ++driver.switched_off; };
  it.hdIsEnabled = [](HDenum) -> HDboolean { return driver.output ? 1 : 0; };
  it.hdGetIntegerv = [](HDenum what, int* value) { driver.give(what, std::array{what == kButtons ? 2 : driver.rate}, value); };
  it.hdGetBooleanv = [](HDenum what, HDboolean* value) {
    driver.give(what, std::array<HDboolean, 1>{driver.switched ? HDboolean{1} : HDboolean{0}}, value);
  };
  it.hdGetLongv = [](HDenum what, HDlong* values) { driver.give(what, std::array<HDlong, 6>{7, -8, 9, 0, 0, 0}, values); };
  it.hdGetDoublev = [](HDenum what, double* values) {
    switch (what) {
      case kPosition: return driver.withholds_position ? void() : driver.give(what, driver.position, values);
      case kMotorTemperature: return driver.give(what, driver.temperatures, values);
      case kJointAngles: return driver.give(what, std::array{0.5, 0.25, -0.125}, values);
      default: return driver.give(what, std::array{0.1, 0.2, 0.3}, values);
    }
  };
  it.hdSetDoublev = [](HDenum what, const double* values) {
    driver.fail(driver.fails[what]);
    driver.sent = {values[0], values[1], values[2]};
  };
  it.hdCheckCalibration = [] { return driver.calibration; };
  it.hdUpdateCalibration = [](HDenum style) {
    driver.updates.push_back(style);
    if (driver.update_helps) driver.calibration = kCalibrated;
  };
  return it;
}

class phantom_frames : public testing::Test {
 protected:
  void SetUp() override { begin({}); }

  // With a driver as new. Frames of a millisecond, in windows of fifty.
  void begin(FrameSettings settings) {
    driver = {};
    settings.gimbal = true;
    settings.window = kWindow;
    shared_ = std::make_unique<PhantomShared>();
    frames_ = std::make_unique<PhantomFrames>(functions_, kDevice, settings, *shared_);
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
  const PhantomSample& ordered_frames(int count) {
    for (int i = 0; i < count; ++i) {
      order(kForce);
      frame();
    }
    return shared_->samples.latest();
  }
  // Settled, with a force commanded that is sent.
  void push() {
    settle();
    ordered_frames(1);
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

  static inline const Eigen::Vector3d kForce{0.25, 1, -0.5}, kNone{0, 0, 0};

  world::World clock;
  const Functions functions_ = functions();
  std::unique_ptr<PhantomShared> shared_;
  std::unique_ptr<PhantomFrames> frames_;
};

TEST_F(phantom_frames, switch_the_output_on_after_a_window_of_good_ones_and_send_no_force_before) {
  for (const bool may_force : {true, false}) {
    begin({.force = may_force});
    for (int k = 0; k <= kWindow; ++k) {
      const auto& sample = ordered_frames(1);
      EXPECT_EQ(driver.sent, kNone) << k;
      EXPECT_EQ(driver.output, may_force && k == kWindow) << k;
      EXPECT_EQ(sample.forces_on, driver.output) << k;
      EXPECT_EQ(sample.phase == Phase::ready, k == kWindow) << k;
    }
    ordered_frames(1);
    EXPECT_NEAR((driver.sent - (may_force ? 0.002 : 0) * kForce).norm(), 0, 1e-9);
  }
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
    begin({});
    frame();
    frame(1, gap);
    frame(kWindow - 1, milliseconds);
    EXPECT_EQ(driver.output, good) << milliseconds << " ms, gap " << gap;
    frame(kWindow);
    EXPECT_TRUE(driver.output);
  }
}

TEST_F(phantom_frames, are_not_ready_when_the_output_cannot_be_switched_on) {
  driver.enable = kDeviceFault;
  EXPECT_NE(frame(kWindow + 1).phase, Phase::ready);
  expect_trouble("switching the force output on");
}

// Each hundredth frame until it helps, and then a window anew.
TEST_F(phantom_frames, update_the_calibration_and_settle_anew) {
  begin({.style = kCalibratesItself});
  driver.calibration = kCalibrationNeedsUpdate;
  driver.update_helps = false;
  frame(400);
  EXPECT_EQ(driver.updates, std::vector<HDenum>(4, kCalibratesItself));
  driver.update_helps = true;
  frame(1 + kWindow);
  EXPECT_FALSE(driver.output);
  frame();
  EXPECT_TRUE(driver.output);
}

// As a stylus out of its inkwell: nothing is wrong, and the device is ready as soon as it is calibrated.
TEST_F(phantom_frames, wait_for_a_calibration_that_takes_a_hand) {
  for (const HDenum style : {kCalibratesInInkwell, kCalibratesItself}) {
    begin({.style = style});
    driver.calibration = kCalibrationNeedsHand;
    EXPECT_FALSE(frame(1000).calibrated || is_troubled());
    EXPECT_TRUE(driver.updates.empty());
    driver.calibration = kCalibrationNeedsUpdate;
    frame();
    EXPECT_EQ(driver.updates, std::vector<HDenum>{style});
    settle();
  }
}

// A position jumps when it is calibrated.
TEST_F(phantom_frames, calibrate_a_device_that_runs_only_where_it_does_so_itself_and_gives_no_force) {
  for (const HDenum style : {kCalibratesItself, kCalibratesInInkwell}) {
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
  driver.temperatures = {0.125, 0.25, 0.0625, 0.5, 0.75, 0.25};
  EXPECT_EQ(frame().temperature, 0.75) << "of the six of another device";
  EXPECT_FALSE(is_troubled());
}

// Driver and device of another kind: what there is not is not read again and is no trouble; any other error is.
TEST_F(phantom_frames, do_without_what_the_driver_does_not_have) {
  const std::vector<std::pair<HDenum, const char*>> optional{{kMotorTemperature, "reading the motors' temperatures"},
                                                             {kEncoders, "reading the encoders"},
                                                             {kJointAngles, "reading the joint angles"},
                                                             {kInstantaneousRate, "reading the device's update rate"},
                                                             {kSafetySwitch, "reading the safety switch"}};
  for (const HDerror code : {kInvalidEnum, kInvalidValue, kInvalidOperation, kInvalidInputType}) {
    begin({});
    push();
    auto before = driver.readings;
    for (const auto& [what, step] : optional) driver.fails[what] = code;
    const auto& sample = frame(5);
    EXPECT_FALSE(sample.troubled) << code;
    for (const auto& [what, step] : optional) EXPECT_EQ(driver.readings[what], before[what] + 1) << step;
    EXPECT_EQ(sample.encoder, std::nullopt) << code;
    EXPECT_EQ(sample.joints, std::nullopt) << code;
  }
  for (const HDerror code : {HDerror{0xFF}, kBadHandle, kCommunication})
    for (const auto& [what, step] : optional) {
      begin({});
      settle();
      driver.fails[what] = code;
      frame();
      expect_trouble(step);
    }
}

// Under force; zero is sent then, in the same frame where its force is not set yet, and the output is off.
TEST_F(phantom_frames, in_which_something_goes_wrong_are_trouble_and_send_zero) {
  std::vector<std::pair<std::string, std::function<void()>>> cases{
      {"beginning a frame", [] { driver.begin = kCommunication; }},
      {"reading the position", [] { driver.fails[kPosition] = kDeviceFault; }},
      {"reading the gimbal", [] { driver.fails[kGimbalAngles] = kDeviceFault; }},
      {"setting the force", [] { driver.fails[hdapi::kForce] = kForceError; }},
      {"ending a frame", [] { driver.end = kExceededForce; }},
      {kNotFinite, [] { driver.withholds_position = true; }},
      // The first of several is kept.
      {"reading the buttons: the device reports a fault (error 0x0300, internal 42", [] {
         driver.fails = {{kButtons, kDeviceFault}, {hdapi::kForce, kForceError}};
         driver.withholds_position = true;
       }}};
  for (const std::vector<double>& wrong :
       {std::vector{0.1, std::nan(""), 0.1}, {std::nan(""), 0.1, 0.1}, {0.1, HUGE_VAL, 0.1}, {0.1, 0.1, -0.1}, {}})
    cases.push_back({kNoTemperature, [wrong] { driver.temperatures = wrong; }});
  for (const auto& [words, happens] : cases) {
    SCOPED_TRACE(words);
    begin({});
    push();
    happens();
    const int read = driver.readings[kButtons];
    const bool is_before_the_force = words != "setting the force" && words != "ending a frame";
    const auto& first = ordered_frames(1);
    EXPECT_FALSE(first.forces_on || driver.output);
    EXPECT_EQ(driver.sent == kNone, is_before_the_force);
    EXPECT_EQ(first.phase == Phase::closed, is_before_the_force);
    EXPECT_EQ(ordered_frames(2).phase, Phase::closed);
    EXPECT_EQ(driver.sent, kNone);
    EXPECT_EQ(driver.readings[kButtons] > read, words != "beginning a frame") << "what did not begin is not read";
    expect_trouble(words);
  }
}

// The driver has reported the lost connection once, to somebody else, and the position stands still.
TEST_F(phantom_frames, of_a_device_that_answers_no_more_are_trouble) {
  push();
  driver.rate = 499;
  ordered_frames(99);
  EXPECT_FALSE(is_troubled());
  driver.rate = 500;
  ordered_frames(1);
  driver.rate = 0;
  ordered_frames(100);
  expect_trouble(kNoAnswer);
  EXPECT_EQ(driver.sent, kNone);
}

TEST_F(phantom_frames, at_the_pose_of_an_uncalibrated_device_are_trouble_only_if_they_stay_there) {
  const Eigen::Vector3d there(0, -110, -35);
  settle();
  driver.position = there;
  EXPECT_FALSE(frame(49).troubled);
  driver.position = there + Eigen::Vector3d(0, 0, 0.055);  // a step of the encoders
  EXPECT_FALSE(frame(100).troubled);
  driver.position = there + Eigen::Vector3d(0, 5e-4, 0);
  frame(50);
  expect_trouble(kUncalibratedPose);
}

// Whole for an eighth of 24 ms, then less and less. None is held for as long as need be.
TEST_F(phantom_frames, hold_no_force_for_longer_than_its_giver_may_stall) {
  begin({.watchdog_timeout = 24ms});
  push();
  order(kNone, 24 * 3.6e6);
  EXPECT_FALSE(frame().troubled);
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
}

// A stalled loop's force pushes a hand that withdraws; what the hand may be given is counted here, and holds all the same.
TEST_F(phantom_frames, send_no_more_than_the_hand_may_be_given_whatever_the_loop_does) {
  push();
  order(kForce, 0, {.work = 2, .longest_step = 1});
  double work = 0;
  for (int k = 0; k < 20; ++k) {
    driver.position += 0.5 * kForce.normalized();
    work += driver.sent.norm() * 0.5;
    EXPECT_NEAR(frame().sent.work, work, 1e-9);
    EXPECT_LE(work + driver.sent.norm() * 1, 2 + 1e-9) << k;
  }
  EXPECT_GT(work, 1.9);
}

// For as long as the servo loop may take to see it.
TEST_F(phantom_frames, send_no_force_for_a_while_after_the_safety_switch_has_changed_either_way) {
  push();
  for (const bool switched : {true, false}) {
    driver.switched = switched;
    for (int k = 0; k < 50; ++k) {
      EXPECT_FALSE(ordered_frames(1).forces_on) << k;
      EXPECT_EQ(driver.sent, kNone) << k;
    }
    EXPECT_TRUE(ordered_frames(1).forces_on);
    EXPECT_NEAR((driver.sent - 0.002 * kForce).norm(), 0, 1e-9) << "it grows from nothing";
    EXPECT_TRUE(driver.output) << "the driver is not told";
  }
}

TEST_F(phantom_frames, close_with_zero_sent_and_the_output_off_for_good) {
  push();
  frames_->close();
  const auto& sample = frame();
  EXPECT_EQ(driver.sent, kNone);
  EXPECT_FALSE(driver.output || sample.forces_on || sample.troubled);
  EXPECT_EQ(sample.phase, Phase::closed);
  EXPECT_EQ(ordered_frames(100).phase, Phase::closed);
  EXPECT_EQ(driver.switched_off, 1);
}

}  // namespace
}  // namespace forceshade::device
