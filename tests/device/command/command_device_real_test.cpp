// SPDX-License-Identifier: BSD-3-Clause
// How fast the frames of a device are that a program drives.

#include <gtest/gtest.h>

#include <string>

#include "tests/device/command/hostile.h"
#include "tests/device/framed_device.h"

namespace forceshade::device {
namespace {

// Where the device has the clock, frames are as fast as its answers, here at most 1 kHz; else as fast as the rate.
TEST(command_device, follows_the_frames_of_a_device_that_paces) {
  for (const char* mode : {"paces", "right"}) {
    const Program program(mode);
    FramedOptions options = kPatient;
    Listener listener;
    const auto device = open_command(program.command(), options, listener);
    constexpr double kSlow = 50;  // Hz
    ASSERT_FALSE(device->start(kSlow));
    EXPECT_EQ(std::stod(listener.words) > 1.15 * kSlow, program.mode == "paces") << listener.words;
  }
}

// Its end is waited for as long as an answer.
TEST(command_device, that_closes_its_output_and_goes_on_ends_a_run_in_words) {
  const Program program("closes");
  FramedOptions options = kPatient;
  options.answer = std::chrono::seconds(1);
  Listener listener;
  const auto device = open_command(program.command(), options, listener);
  ASSERT_FALSE(device->start(kRate));
  device->allow({.work = 1e6, .longest_step = 1});
  device->command({0, 0, 0.5F});
  const std::string words = fault_of(*device).words;
  EXPECT_NE(words.find("the program closed its output, and did not end"), std::string::npos) << words;
}

}  // namespace
}  // namespace forceshade::device
