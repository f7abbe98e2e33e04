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

}  // namespace
}  // namespace forceshade::device
