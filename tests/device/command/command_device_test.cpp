// SPDX-License-Identifier: BSD-3-Clause
// A device that a program drives: what it says of programs that do what they must not, and what is left of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "device/command/command.h"
#include "device/command/command_messages.h"
#include "files/lines.h"
#include "tests/device/framed_device.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

constexpr double kRate = 200;  // Hz

struct Listener final : Attendant {
  void report(const std::string& said) noexcept override { words += said + '\n'; }
  std::string words;
};

// hostile.py in this mode, and its log.
struct Program {
  explicit Program(const std::string& name) : mode(name), log(here.file("log")) {}

  std::string command() const { return "exec python3 '" HOSTILE_PROGRAM "' " + mode + " '" + log + "'"; }

  // The folders in /proc of the processes that have its log in their command line.
  std::vector<std::string> processes() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream in(entry.path() / "cmdline");
      std::string line;
      std::getline(in, line);  // empty where the process ended meanwhile
      if (line.find(log) != std::string::npos) all.push_back(entry.path());
    }
    return all;
  }
  std::size_t left() const { return processes().size(); }

  // The lines that it was sent, without their times.
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);) all.push_back(line.substr(line.find(' ') + 1));
    return all;
  }

  tests::TemporaryDirectory here;
  std::string mode, log;
};

// A program of the shell's does not open, in these words.
void expect_words(const std::string& program, const FramedOptions& options, const std::string& words) {
  Attendant nobody;
  tests::expect_words(tests::thrown_by<DeviceError>([&] { open_command(program, options, nobody); }), {words});
}

TEST(command_device, names_what_is_wrong_with_a_hello) {
  const std::string right =
      R"({"forceshade-device":1,"name":"test arm","workspace_mm":[[-100,-100,-100],[100,100,100]],"peak_force_N":3,)"
      R"("continuous_force_N":1,"resolution_mm":0.05,"buttons":2,"paces":false})";
  const std::string its = "the program's hello has ";
  for (const auto& [part, instead, words] : std::vector<std::array<std::string, 3>>{
           {R"("peak_force_N":3,)", "", its + "no key \"peak_force_N\"; expected a number of N"},
           {"N\":3,", "N\":\"3 N\",", its + "peak_force_N \"3 N\"; expected a number of N"},
           {"N\":3,", "N\":NaN,", "expected a JSON object in one line"},
           {"device\":1", "device\":2", its + "forceshade-device 2; expected 1, the version of the protocol"},
           {"\"peak", "\"peek_force_N\":3,\"peak", its + "the key \"peek_force_N\"; expected "},
           {"[[-100,-100,-100],[100,100,100]]", "[[100,0,0],[0,1,1]]",
            its + "workspace_mm [[100,0,0],[0,1,1]]; expected [[x, y, z], [x, y, z]] in mm"},
           {"N\":1,", "N\":4,", its + "continuous_force_N 4; expected a number of N from 0.001 to peak_force_N"},
           {"buttons\":2", "buttons\":0.5", its + "buttons 0.5; expected a whole number from 0 to 16"},
           {"buttons\":2", "buttons\":-1", its + "buttons -1; expected a whole number from 0 to 16"},
           {"paces\":false", "paces\":1", its + "paces 1; expected true or false"},
           {"\"paces", "\"buttons\":3,\"paces", "the key \"buttons\" twice"},
           {right, "hello", "the program wrote \"hello\"; expected a JSON object in one line"},
           {right, R"({"failure":"no arm at /dev/ttyACM0"})", "the program failed: \"no arm at /dev/ttyACM0\""}}) {
    std::string hello = right;
    hello.replace(hello.find(part), part.size(), instead);
    expect_words("echo '" + hello + "'", kPatient, words);
  }
  FramedOptions hasty = kPatient;
  hasty.open = 300ms, hasty.end = 0ms;
  expect_words("exec sleep 600", hasty, "the program did not answer within 0.3 s");
}

// Any other wrong answer, and one that is late, is tried in a simulated world (tests/world/arms_world_test.cpp).
TEST(command_device, ends_a_run_in_words_where_the_program_crashes) {
  const Program program("crashes");
  Attendant nobody;
  tests::expect_words(driven(*open_command(program.command(), kPatient, nobody), kRate),
                      {"the program was killed by signal 6"});
  EXPECT_EQ(program.left(), 0U);
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
      driven(*open_command(program.command(), kPatient, nobody), kRate);
    }
    const std::vector<std::string> lines = program.lines();
    ASSERT_GE(lines.size(), 2U);
    EXPECT_EQ(lines.back(), R"({"end":true})");
    EXPECT_EQ(lines[lines.size() - 2], R"({"force_N":[0,0,0]})");
    EXPECT_EQ(program.left(), 0U);
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
    FramedOptions options = kPatient;
    if (program.mode == "hangs-at-end") options.end = 0ms;
    {
      const auto device = open_command(program.command(), options, listener);
      ASSERT_FALSE(device->start(kRate));
    }
    EXPECT_EQ(program.left(), 0U);
    const bool is_ended = listener.words.find("it did not end within 1 s, and was ended") != std::string::npos;
    EXPECT_EQ(is_ended, program.mode == "hangs-at-end") << listener.words;
  }
}

TEST(command_device, says_what_calibrates_it) {
  const Program program("uncalibrated");
  FramedOptions options = kPatient;
  options.calibration = 1s;
  Listener listener;
  EXPECT_EQ(driven(*open_command(program.command(), options, listener), kRate), "the device is not calibrated");
  EXPECT_NE(listener.words.find("the calibration of the device: turn each joint to its stop"), std::string::npos)
      << listener.words;
}

// Opened for no force, or with its forces switched off, it is sent none, whatever is commanded.
TEST(command_device, sends_no_force_that_is_forbidden) {
  for (const auto& [mode, may_force] : {std::pair{"right", false}, {"off", true}}) {
    SCOPED_TRACE(mode);
    const Program program(mode);
    Attendant nobody;
    FramedOptions options = kPatient;
    options.force = may_force;
    auto device = open_command(program.command(), options, nobody);
    ASSERT_FALSE(device->start(kRate));
    device->allow({.work = 1e6, .longest_step = 1});
    for (int tick = 0; tick < 20; ++tick) {
      wait_for_frame(*device);
      device->read();
      device->command({0, 0, 0.5F});
    }
    EXPECT_FALSE(device->state().forces_on);
    device.reset();
    for (const std::string& line : program.lines())
      EXPECT_TRUE(line == R"({"force_N":[0,0,0]})" || line == R"({"end":true})") << line;
  }
}

// The loop's process is killed first where memory runs out, and the program then reads the end of its input.
TEST(command_device, has_a_program_that_memory_is_taken_from_last) {
  const auto readiness = [](const std::string& process) {
    int score = 0;
    std::ifstream(process + "/oom_score_adj") >> score;
    return score;
  };
  const int before = readiness("/proc/self");
  if (!(std::ofstream("/proc/self/oom_score_adj") << before << std::flush))
    GTEST_SKIP() << "/proc/self/oom_score_adj is not to be written";
  const Program program("right");
  Attendant nobody;
  {
    const auto device = open_command(program.command(), kPatient, nobody);
    EXPECT_EQ(readiness("/proc/self"), 1000);
    ASSERT_GT(program.left(), 0U);
    for (const std::string& process : program.processes()) EXPECT_EQ(readiness(process), before);
  }
  EXPECT_EQ(readiness("/proc/self"), before);
}

// A program that writes much on its standard error does not stop.
TEST(command_device, allocates_nothing_once_started) {
  const Program program("chatters");
  Attendant nobody;
  const auto device = open_command(program.command(), kPatient, nobody);
  EXPECT_EQ(device->capabilities().model, "test arm");
  EXPECT_EQ(device->capabilities().peak_force, 3);
  EXPECT_EQ(device->capabilities().resolution, 0.05F);
  EXPECT_EQ(device->capabilities().buttons, 2);
  EXPECT_TRUE(device->capabilities().paces);
  ASSERT_FALSE(device->start(kRate));
  expect_ticks_without_allocation(*device);
}

TEST(command_device, has_answers_of_which_each_is_later_than_the_one_before) {
  command::Answers answers(0);
  for (const auto& [time, is_later] :
       {std::pair{"-5", true}, {"-5", false}, {"-6", false}, {"1", true}, {"1.0", false}, {"1.0000001", true}}) {
    const std::string line = std::string(R"({"time_s":)") + time + R"(,"position_mm":[0,0,0],"buttons":0})";
    const std::string words = tests::thrown_by<files::ProcessFailed>([&] { answers.state_of(line); });
    EXPECT_EQ(words.find("expected a later time than ") == std::string::npos, is_later) << time << ": " << words;
  }
}

TEST(command_device, has_a_second_or_what_its_options_say_to_end) {
  for (const auto& [said, grace] : {std::pair{10ms, 1000ms}, {3000ms, 3000ms}})
    EXPECT_EQ(command::limits_of({.end = said}).grace, grace);
}

}  // namespace
}  // namespace forceshade::device
