// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the frames of a PHANToM's driver one by one, without its scheduler and on a clock of the test's own, so that every order
// of events can be had.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "device/phantom/phantom_frames.h"
#include "tests/world/world.h"

namespace forceshade::device {

inline constexpr int kWindow = 50;

// The driver's state, the errors that its calls return, and the orders that it got.
struct Driver {
  Eigen::Vector3d position{1, 2, 3};
  std::vector<double> temperatures{0.125, 0.25, 0.0625};
  std::array<hdapi::HDlong, 6> counts{7, -8, 9, 0, 0, 0};
  hdapi::HDenum calibration = hdapi::kCalibrated;
  int rate = 1000;
  bool update_helps = true;
  bool stays_off = false, withholds_position = false, switched = false;
  hdapi::HDerror begin = 0, get_position = 0, buttons = 0, temperature = 0, encoders = 0, joints = 0, rate_error = 0, set = 0,
                 end = 0, enable = 0, safety_switch = 0;

  bool output = false;
  Eigen::Vector3d sent{0, 0, 0};
  std::vector<hdapi::HDenum> updates;  // the styles of
  int readings = 0, temperature_readings = 0, encoder_readings = 0, joint_readings = 0, rate_readings = 0, checks = 0,
      switch_readings = 0, switched_on = 0, switched_off = 0;
  std::vector<hdapi::HDErrorInfo> errors;

  void fail(hdapi::HDerror code) {
    if (code != hdapi::kSuccess) errors.push_back({code, 42, 7});
  }
};

inline Driver driver;

inline const hdapi::Functions& functions() {
  static const hdapi::Functions hd = [] {
    hdapi::Functions it{};
    it.hdBeginFrame = [](hdapi::HHD) { driver.fail(driver.begin); };
    it.hdEndFrame = [](hdapi::HHD) { driver.fail(driver.end); };
    it.hdGetErrorString = [](hdapi::HDerror) { return "Some error."; };
    it.hdGetError = [] {
      if (driver.errors.empty()) return hdapi::HDErrorInfo{};
      const hdapi::HDErrorInfo last = driver.errors.back();
      driver.errors.pop_back();
      return last;
    };
    it.hdEnable = [](hdapi::HDenum) {
      driver.fail(driver.enable);
      ++driver.switched_on;
      driver.output = !driver.stays_off;
    };
    it.hdDisable = [](hdapi::HDenum) {
      driver.output = false;
      ++driver.switched_off;
    };
    it.hdIsEnabled = [](hdapi::HDenum) -> hdapi::HDboolean { return driver.output ? 1 : 0; };
    it.hdGetIntegerv = [](hdapi::HDenum what, int* value) {
      if (what == hdapi::kInstantaneousRate) ++driver.rate_readings;
      *value = what == hdapi::kButtons ? 2 : driver.rate;
      driver.fail(what == hdapi::kButtons ? driver.buttons : driver.rate_error);
    };
    it.hdGetBooleanv = [](hdapi::HDenum, hdapi::HDboolean* value) {
      ++driver.switch_readings;
      driver.fail(driver.safety_switch);
      *value = driver.switched ? 1 : 0;
    };
    it.hdGetLongv = [](hdapi::HDenum, hdapi::HDlong* values) {
      ++driver.encoder_readings;
      driver.fail(driver.encoders);
      if (driver.encoders == hdapi::kSuccess) std::copy(driver.counts.begin(), driver.counts.end(), values);
    };
    it.hdGetDoublev = [](hdapi::HDenum what, double* values) {
      const auto give = [&](const Eigen::Vector3d& v) { std::copy(v.begin(), v.end(), values); };
      if (what == hdapi::kPosition) {
        ++driver.readings;
        driver.fail(driver.get_position);
        if (driver.get_position == hdapi::kSuccess && !driver.withholds_position) give(driver.position);
      } else if (what == hdapi::kMotorTemperature) {
        ++driver.temperature_readings;
        driver.fail(driver.temperature);
        if (driver.temperature == hdapi::kSuccess) std::copy(driver.temperatures.begin(), driver.temperatures.end(), values);
      } else if (what == hdapi::kJointAngles) {
        ++driver.joint_readings;
        driver.fail(driver.joints);
        if (driver.joints == hdapi::kSuccess) give({0.5, 0.25, -0.125});
      } else {
        give({0.1, 0.2, 0.3});
      }
    };
    it.hdSetDoublev = [](hdapi::HDenum, const double* values) {
      driver.fail(driver.set);
      driver.sent = {values[0], values[1], values[2]};
    };
    it.hdCheckCalibration = [] {
      ++driver.checks;
      return driver.calibration;
    };
    it.hdUpdateCalibration = [](hdapi::HDenum style) {
      driver.updates.push_back(style);
      if (driver.update_helps) driver.calibration = hdapi::kCalibrated;
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
      EXPECT_EQ(PhantomFrames::tick(frames_.get()), hdapi::kCallbackContinue);
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
    ASSERT_EQ(shared_->samples.latest().phase, PhantomFrames::Phase::ready);
  }
  bool is_troubled() { return shared_->samples.latest().troubled; }
  void expect_trouble(const std::string& words) {
    ASSERT_TRUE(is_troubled()) << words;
    EXPECT_EQ(std::string(shared_->trouble.data()).substr(0, words.size()), words);
  }
  void expect_first_of_a_ramp() { EXPECT_NEAR((driver.sent - 0.002 * kForce).norm(), 0, 1e-9); }
  void close() { frames_->close(); }

  static inline const Eigen::Vector3d kForce{0.25, 1, -0.5}, kNone{0, 0, 0};
  static inline const Eigen::Vector3d kUncalibrated{0, -110, -35};

  world::World clock;
  std::unique_ptr<PhantomShared> shared_;
  std::unique_ptr<PhantomFrames> frames_;
};

}  // namespace forceshade::device
