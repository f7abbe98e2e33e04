// SPDX-License-Identifier: BSD-3-Clause
// A device that a program drives: what it says of programs that do what they must not, and what is left of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "tests/device/command/hostile.h"
#include "tests/device/framed_device.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

// Its words, or those of what did not open.
std::string driven(const Program& program, const FramedOptions& options, Attendant& attendant) try {
  return driven(*open_command(program.command(), options, attendant), kRate);
} catch (const DeviceError& error) {
  return error.what();
}

struct Hostile {
  const char *mode, *words;
};

void expect_words_and_an_end(const Hostile& hostile, FramedOptions options) {
  SCOPED_TRACE(hostile.mode);
  const Program program(hostile.mode);
  Listener listener;
  const std::string words = driven(program, options, listener);
  EXPECT_NE(words.find(hostile.words), std::string::npos) << words;
  EXPECT_EQ(program.left(), 0);
}

TEST(command_device, names_what_is_wrong_with_a_hello) {
  constexpr Hostile kHellos[]{
      {"no-peak", "the program's hello has no key \"peak_force_N\"; expected a number of N"},
      {"peak-text", "the program's hello has peak_force_N \"3 N\"; expected a number of N"},
      {"peak-nan", "expected a JSON object in one line"},
      {"other-version", "the program's hello has forceshade-device 2; expected 1, the version of the protocol"},
      {"unknown-key", "the program's hello has the key \"peek_force_N\"; expected "},
      {"workspace-turned", "the program's hello has workspace_mm [[100,0,0],[0,1,1]]; expected [[x, y, z], [x, y, z]] in mm"},
      {"continuous-above-peak",
       "the program's hello has continuous_force_N 4; expected a number of N from 0.001 to peak_force_N"},
      {"half-a-button", "the program's hello has buttons 0.5; expected a whole number from 0 to 16"},
      {"paces-by-number", "the program's hello has paces 1; expected true or false"},
      {"no-hello", "the program wrote \"hello\"; expected a JSON object in one line"},
      {"key-twice", "the key \"buttons\" twice"},
      {"fails", "the program failed: \"no arm at /dev/ttyACM0\""},
      {"exits",
       "the program ended with exit code 1 without an answer; it wrote last on standard error: \"no arm is connected\""},
      {"long-hello", "the program wrote a line of more than 65536 bytes"},
  };
  for (const Hostile& hostile : kHellos) expect_words_and_an_end(hostile, kPatient);
  FramedOptions hasty = kPatient;
  hasty.open = 300ms;
  expect_words_and_an_end({"silent", "the program did not answer within 0.3 s"}, hasty);
}

// Any other wrong answer, and one that is late, is tried in a simulated world (tests/world/arms_world_test.cpp).
TEST(command_device, ends_a_run_in_words_where_the_program_ends) {
  constexpr Hostile kAnswers[]{
      {"exits-at",
       "the program ended with exit code 1 without an answer; it wrote last on standard error: \"the arm was unplugged\""},
      {"crashes", "the program was killed by signal 6"},
  };
  for (const Hostile& hostile : kAnswers) expect_words_and_an_end(hostile, kPatient);
}

// The lines of a program that still reads end with a zero force and the end.
TEST(command_device, sends_zero_last) {
  for (const char* mode : {"garbage", "forks"}) {
    SCOPED_TRACE(mode);
    const Program program(mode);
    Attendant nobody;
    if (program.mode == "forks") {
      const auto device = open_command(program.command(), kPatient, nobody);
      ASSERT_FALSE(device->start(kRate));
    } else {
      driven(program, kPatient, nobody);
    }
    const std::vector<std::string> lines = program.lines();
    ASSERT_GE(lines.size(), 2U);
    EXPECT_EQ(lines.back(), R"({"end":true})");
    EXPECT_EQ(lines[lines.size() - 2], R"({"force_N":[0,0,0]})");
    EXPECT_EQ(program.left(), 0);
    if (program.mode == "garbage") {
      EXPECT_NE(std::ranges::find(lines, R"({"force_N":[0,0,0.5]})"), lines.end());
    }
  }
}

TEST(command_device, ends_what_does_not_end_by_itself) {
  for (const char* mode : {"hangs-at-end", "ignores-signals"}) {
    SCOPED_TRACE(mode);
    const Program program(mode);
    Listener listener;
    {
      const auto device = open_command(program.command(), kPatient, listener);
      ASSERT_FALSE(device->start(kRate));
    }
    EXPECT_EQ(program.left(), 0);
    const bool is_ended = listener.words.find("it did not end within 1 s, and was ended") != std::string::npos;
    EXPECT_EQ(is_ended, program.mode == "hangs-at-end") << listener.words;
  }
}

TEST(command_device, says_what_calibrates_it) {
  const Program program("uncalibrated");
  FramedOptions options = kPatient;
  options.calibration = 1s;
  Listener listener;
  EXPECT_EQ(driven(program, options, listener), "the device is not calibrated");
  EXPECT_NE(listener.words.find("the calibration of the device: turn each joint to its stop"), std::string::npos)
      << listener.words;
}

// Opened for no force, it is sent none, whatever is commanded.
TEST(command_device, sends_no_force_that_is_forbidden) {
  const Program program("right");
  Attendant nobody;
  {
    FramedOptions options = kPatient;
    options.force = false;
    const auto device = open_command(program.command(), options, nobody);
    ASSERT_FALSE(device->start(kRate));
    device->allow({.work = 1e6, .longest_step = 1});
    for (int tick = 0; tick < 20; ++tick) {
      wait_for_frame(*device);
      device->read();
      device->command({0, 0, 0.5F});
    }
    EXPECT_FALSE(device->state().forces_on);
  }
  for (const std::string& line : program.lines())
    EXPECT_TRUE(line == R"({"force_N":[0,0,0]})" || line == R"({"end":true})") << line;
}

// A program that writes much on its standard error does not stop.
TEST(command_device, allocates_nothing_once_started) {
  const Program program("chatters");
  Attendant nobody;
  const auto device = open_command(program.command(), kPatient, nobody);
  EXPECT_EQ(device->capabilities().model, "test arm");
  EXPECT_EQ(device->capabilities().peak_force, 3);
  EXPECT_EQ(device->capabilities().buttons, 2);
  EXPECT_TRUE(device->capabilities().paces);
  ASSERT_FALSE(device->start(kRate));
  expect_ticks_without_allocation(*device);
}

}  // namespace
}  // namespace forceshade::device
