// SPDX-License-Identifier: BSD-3-Clause
// The forces that the frames of a PHANToM's driver send, for how long, and when none.

#include <gtest/gtest.h>

#include "device/phantom/phantom_frames.h"
#include "tests/device/phantom_frames_fixture.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;
using namespace hdapi;
using Phase = PhantomFrames::Phase;

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

// By an emergency switch, say: when it comes on again, the force grows from nothing.
TEST_F(phantom_frames, send_no_force_while_the_output_is_off) {
  push();
  driver.output = false;
  EXPECT_FALSE(frame().forces_on);
  EXPECT_EQ(driver.sent, kNone);
  driver.output = true;
  EXPECT_TRUE(frame().forces_on);
  expect_first_of_a_ramp();
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
    expect_first_of_a_ramp();
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

}  // namespace
}  // namespace forceshade::device
