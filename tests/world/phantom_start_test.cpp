// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM that is opened and started, or says why not.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "device/phantom/hdapi_words.h"
#include "device/phantom/phantom.h"
#include "forceshade/device.h"
#include "tests/world/phantom_fixture.h"

namespace forceshade::world {
namespace {

using Words = std::vector<std::string>;

IN_WORLD(that_cannot_be_opened_says_why_and_what_to_check) {
  const char* const number = "highest force: expected a number of newtons above 0";
  struct Case {
    Orders orders;
    Words words;
    const char* absent = "(no such words)";
  };
  for (const auto& [orders, words, absent] :
       {Case{{.init_fails_silently = true}, {"the driver says no more", "permission"}},
        Case{{.init = hdapi::kDeviceFault},
             {"0x0300", "internal 42", "Some error.", "\"Left arm\" must be written", "permission", "licence", "cable"}},
        Case{{.init = hdapi::kInvalidValue}, {"0x0101", "a name that it does not find there"}},
        Case{{.init = hdapi::kNoLicence}, {"the vendor's licence is missing"}, "permission"},
        Case{{.init = hdapi::kAlreadyInitiated}, {"close the program that has it open"}, "permission"},
        Case{{.peak_force = Answer::fails(hdapi::kInvalidEnum)}, {"highest force", "does not say"}},
        Case{{.peak_force = 0.0}, {number}}, Case{{.peak_force = std::nan("")}, {number}},
        Case{{.peak_force = Answer::nothing()}, {number}}}) {
    tell(orders);
    const std::string why = tests::thrown_by<DeviceError>([] { Phantom device = opened(kPatient, nobody(), "Left arm"); });
    expect_words(why, words);
    EXPECT_EQ(why.find(absent), std::string::npos) << why;
    EXPECT_EQ(seen().name, "Left arm");
    EXPECT_FALSE(seen().initialised);
  }
  tell({.init = hdapi::kCommunication});
  expect_words(tests::thrown_by<DeviceError>([] { Phantom device = opened(kPatient); }),
               {"the default device was asked for", "Default PHANToM"});
}

// Each on the same device, which starts in between; an error of the scheduler's start, which has started it all the same,
// leaves frames that run while it is decided to give up.
IN_WORLD(that_cannot_be_started_says_why_and_gives_no_force) {
  struct Case {
    Orders orders;
    Words words;
    Phantom::Options options = kPatient;
  };
  const auto within = [](std::chrono::milliseconds start) {
    Phantom::Options hasty = kPatient;
    hasty.start = hasty.calibration = start;
    return hasty;
  };
  const Eigen::Vector3d frozen(0, -110, -35);
  for (const auto& [orders, words, options] :
       {Case{{.schedule = hdapi::kSchedulerFull}, {"scheduling the frames", "0x0501"}},
        Case{{.start = hdapi::kTimer}, {"starting the driver's scheduler", "0x0304"}},
        Case{{.start_with_error = hdapi::kTimer}, {"starting the driver's scheduler", "0x0304"}},
        Case{{.rate = hdapi::kInvalidValue}, {"setting the driver's rate", "0x0101"}},
        Case{{.begin = hdapi::kCommunication}, {"beginning a frame", "communication", "0x0302"}},
        Case{{.get_position = hdapi::kDeviceFault}, {"reading the position", "0x0300"}},
        Case{{.output_stays_off = true}, {"is still off"}},
        Case{{.temperature = Answer::fails(hdapi::kCommunication)}, {"temperatures", "0x0302"}},
        Case{{.position = frozen}, {"(0, -110, -35)", "inkwell"}},
        Case{{.position = Eigen::Vector3d(0, HUGE_VAL, 0)}, {hdapi::kNotFinite}},
        Case{{.hung = true}, {hdapi::kNoFrames}, within(100ms)},
        Case{{.frame_time = 10ms}, {"runs its frames too slowly"}, {.start = 100ms}},
        Case{{.instantaneous_rate = 1000, .frame_hz = 800},
             {"too irregular", "expected 1000 frames a second", "late, longest gap"},
             {.watchdog_timeout = 2s, .start = 1500ms}},
        Case{{.instantaneous_rate = 0},
             {"no longer answers", "check cable and power"},
             {.watchdog_timeout = 2s, .start = 1200ms, .rate_tolerance = 1}},
        Case{{.calibration = hdapi::kCalibrationNeedsHand}, {"not calibrated", "inkwell"}, within(200ms)}}) {
    SCOPED_TRACE(words.front());
    {
      tell(orders);
      Phantom device = opened(options);
      const auto fault = device.start(orders.rate != hdapi::kSuccess ? 500 : 1000);  // the driver's own is 1000
      ASSERT_TRUE(fault);
      expect_words(fault->words, words);
      EXPECT_FALSE(seen().output);
      EXPECT_EQ(seen().updates, 0);
      for (const auto& frame : seen().frames) EXPECT_TRUE(frame.force.isZero(0));
      tell({});
      EXPECT_STREQ(device.start(1000)->words, "the PHANToM was started before");
    }
    Phantom again = opened(kPatient);
    EXPECT_FALSE(again.start(500));
    EXPECT_EQ(seen().rate, 500);
  }
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

// A Premium: each process has to calibrate it anew, in a pose that only the user can see. Asked, the user says that it is
// there, and so it is; that it is not; or that it is, and it is elsewhere.
IN_WORLD(that_calibrates_in_its_reset_pose_starts_once_the_user_holds_it_there) {
  int updates = 0;
  for (const auto& [does, is_there, asked] : {std::tuple{true, true, 1}, {true, true, 1}, {false, true, 1}, {true, false, 3}}) {
    tell({.calibration = std::nullopt, .styles = hdapi::kCalibratesAtResetPose, .in_reset_pose = is_there});
    Attends listener;
    listener.does = does;
    Phantom device = opened(kPatient, listener);
    const std::size_t frames = seen().frames.size();
    const auto fault = device.start(1000);
    EXPECT_EQ(!fault, does && is_there);
    EXPECT_EQ(listener.asked, std::vector<std::string>(static_cast<std::size_t>(asked), hdapi::kHoldInResetPose));
    EXPECT_EQ(seen().updates, updates += does ? asked : 0);
    if (fault) {
      expect_words(fault->words, {"not calibrated"});
      EXPECT_EQ(seen().frames.size(), frames) << "it runs no frame";
    } else {
      EXPECT_TRUE(std::holds_alternative<Reading>(device.read()));
      EXPECT_TRUE(device.state().calibrated);
      expect_words(listener.heard, {"the driver's thread has ", " priority", " frames a second, ", "longest gap"});
    }
  }
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
