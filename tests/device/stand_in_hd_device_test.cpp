// SPDX-License-Identifier: BSD-3-Clause
// The device of the stand-in for the vendor's library: its motors, calibration, capabilities, box, arm and name.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "device/simulated/arm.h"
#include "device/simulated/model.h"
#include "tests/device/stand_in_hd/caller.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"

namespace forceshade::stand_in_hd {
namespace {

TEST_F(stand_in, writes_as_many_temperatures_as_there_are_motors) {
  for (const int motors : {3, 6}) {
    reset();
    tell({.output_degrees = motors});
    EXPECT_EQ(in_child([&](const Functions& hd) {
                Caller caller(hd);
                std::array<double, 7> temperatures{};
                temperatures.fill(-5);
                int said = 0;
                hd.hdGetIntegerv(kOutputDegrees, &said);
                EXPECT_EQ(said, motors);
                caller.inside = [&] { hd.hdGetDoublev(kMotorTemperature, temperatures.data()); };
                caller.start();
                caller.runs(5);
                caller.stop();
                EXPECT_EQ(std::count(temperatures.begin(), temperatures.end(), -5), 7 - motors);
              }),
              0);
  }
}

TEST_F(stand_in, without_a_device_crashes_or_writes_minus_eleven) {
  const int status = in_child([](const Functions& hd) { hd.hdIsEnabled(kForceOutput); });
  EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(in_child([](const Functions& hd) {
              double force = 0;
              hd.hdGetDoublev(kMaxForce, &force);
              EXPECT_EQ(force, -11);
              EXPECT_EQ(hd.hdGetError().code, kSuccess);
            }),
            0);
}

TEST_F(stand_in, forgets_in_every_new_process_that_it_was_calibrated_at_the_reset_pose) {
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(in_child([](const Functions& hd) {
                const Caller caller(hd);
                Orders orders{.calibration = std::nullopt, .styles = kCalibratesAtResetPose, .in_reset_pose = false};
                tell(orders);
                hd.hdUpdateCalibration(kCalibratesAtResetPose);
                EXPECT_EQ(hd.hdCheckCalibration(), kCalibrationNeedsHand);
                orders.in_reset_pose = true;
                tell(orders);
                EXPECT_EQ(hd.hdCheckCalibration(), kCalibrationNeedsHand);
                hd.hdUpdateCalibration(kCalibratesItself);
                EXPECT_EQ(hd.hdGetError().code, kInvalidValue);
                hd.hdUpdateCalibration(kCalibratesAtResetPose);
                EXPECT_EQ(hd.hdCheckCalibration(), kCalibrated);
                hd.hdDisableDevice(caller.device);
              }),
              0);
  EXPECT_EQ(seen().updates, 4);
}

TEST_F(stand_in, is_calibrated_in_its_inkwell_once_the_stylus_is_there) {
  Orders orders{.calibration = std::nullopt, .styles = kCalibratesInInkwell};
  tell(orders);
  EXPECT_EQ(in_child([&](const Functions& hd) {
              const Caller caller(hd);
              EXPECT_EQ(hd.hdCheckCalibration(), kCalibrationNeedsHand);
              orders.in_inkwell = true;
              tell(orders);
              EXPECT_EQ(hd.hdCheckCalibration(), kCalibrationNeedsUpdate);
              HDboolean there = 0;
              hd.hdGetBooleanv(kInkwellSwitch, &there);
              EXPECT_EQ(there, 1);
              hd.hdUpdateCalibration(kCalibratesInInkwell);
              EXPECT_EQ(hd.hdCheckCalibration(), kCalibrated);
              hd.hdDisableDevice(caller.device);
            }),
            0);
}

TEST_F(stand_in, of_the_style_that_calibrates_itself_may_need_it_again_while_it_runs) {
  tell({.calibration = std::nullopt, .styles = kCalibratesItself, .calibration_lost_at = 30});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              EXPECT_EQ(hd.hdCheckCalibration(), kCalibrationNeedsUpdate);
              hd.hdUpdateCalibration(kCalibratesItself);
              EXPECT_EQ(hd.hdCheckCalibration(), kCalibrated);
              std::vector<HDenum> states;
              caller.inside = [&] { states.push_back(caller.calibration); };
              caller.start();
              caller.runs(40);
              caller.stop();
              EXPECT_EQ(std::count(states.begin(), states.begin() + 29, kCalibrated), 29);
              EXPECT_EQ(states[29], kCalibrationNeedsUpdate);
            }),
            0);
}

TEST_F(stand_in, gives_each_capability_right_or_wrong_or_not_at_all) {
  const auto of_doubles = [](HDenum what) {
    return [what](const Functions& hd) {
      double value = -5;
      hd.hdGetDoublev(what, &value);
      return value;
    };
  };
  const auto of_integers = [](HDenum what) {
    return [what](const Functions& hd) -> double {
      int value = -5;
      hd.hdGetIntegerv(what, &value);
      return value;
    };
  };
  struct Capability {
    Answer Orders::*order;
    std::function<double(const Functions&)> get;
    double right;
  };
  for (const Capability& capability : {Capability{&Orders::peak_force, of_doubles(kMaxForce), 8.5},
                                       {&Orders::continuous_force, of_doubles(kContinuousForce), 1.4},
                                       {&Orders::velocity_limit, of_doubles(kVelocityLimit), 1500},
                                       {&Orders::impulse_limit, of_doubles(kImpulseLimit), 4},
                                       {&Orders::update_rate, of_integers(kUpdateRate), 1000},
                                       {&Orders::input_degrees, of_integers(kInputDegrees), 6}}) {
    for (const auto& [answer, expected, error] :
         {std::tuple{Answer(), capability.right, kSuccess}, std::tuple{Answer(7), 7.0, kSuccess},
          std::tuple{Answer::fails(kDeviceFault), -5.0, kDeviceFault}, std::tuple{Answer::nothing(), -5.0, kSuccess}}) {
      reset();
      Orders orders;
      orders.*capability.order = answer;
      tell(orders);
      EXPECT_EQ(in_child([&](const Functions& hd) {
                  const Caller caller(hd);
                  EXPECT_EQ(capability.get(hd), expected);
                  EXPECT_EQ(hd.hdGetError().code, error);
                  hd.hdDisableDevice(caller.device);
                }),
                0);
    }
  }
}

TEST_F(stand_in, gives_the_box_as_told) {
  tell({.workspace = 0});
  EXPECT_EQ(in_child([](const Functions& hd) {
              const Caller caller(hd);
              std::array<double, 6> box{1, 1, 1, 1, 1, 1};
              hd.hdGetDoublev(kUsableWorkspace, box.data());
              EXPECT_EQ(box, (std::array<double, 6>{}));
              hd.hdDisableDevice(caller.device);
            }),
            0);
}

// Position, encoders and angles are those of one arm, whatever position it is told to report.
TEST_F(stand_in, counts_and_turns_as_its_position_says) {
  tell({.position = Eigen::Vector3d(10, -20, 30)});
  EXPECT_EQ(in_child([](const Functions& hd) {
              Caller caller(hd);
              std::array<HDlong, 6> counts{};
              std::array<double, 3> angles{};
              caller.inside = [&] {
                hd.hdGetLongv(kEncoders, counts.data());
                hd.hdGetDoublev(kJointAngles, angles.data());
              };
              caller.start();
              caller.runs(5);
              caller.stop();
              const device::Model model = device::premium_1_5();
              const Eigen::Vector3d joints(angles[0], angles[1], angles[2]);
              EXPECT_LE((model.arm.forward(joints) / device::kMillimetre - Eigen::Vector3d(10, -20, 30)).norm(), 0.05);
              for (Eigen::Index i = 0; i < 3; ++i)
                EXPECT_EQ(static_cast<double>(counts[static_cast<std::size_t>(i)]) * model.quantum[i], joints[i]);
            }),
            0);
}

TEST_F(stand_in, says_who_it_is) {
  EXPECT_EQ(in_child([](const Functions& hd) {
              const Caller caller(hd);
              std::vector<std::string> names;
              for (const HDenum what : {kVersion, kModel, kDriverVersion, kVendor, kSerialNumber, kFirmware})
                names.emplace_back(hd.hdGetString(what));
              EXPECT_EQ(names, (std::vector<std::string>{"3.4.0", "Stand-in 1.5", "4.3.3", "Nobody", "S-0042", "192"}));
              hd.hdDisableDevice(caller.device);
            }),
            0);
}

}  // namespace
}  // namespace forceshade::stand_in_hd
