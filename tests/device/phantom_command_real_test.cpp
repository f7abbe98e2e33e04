// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM driven by the command, whose frames have to be good within its limits: what it prints, and its exit code.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "device/phantom/hdapi_words.h"
#include "tests/device/phantom_command.h"

namespace forceshade::device {
namespace {

using stand_in_hd::Crash;
using stand_in_hd::Moment;
using tests::CommandRun;

TEST_F(phantom, in_its_reset_pose_as_the_command_line_says_is_driven) {
  tell({.calibration = std::nullopt, .styles = hdapi::kCalibratesAtResetPose, .position = kFree});
  const CommandRun driven = drive("--in-reset-pose");
  EXPECT_EQ(driven.code, 0) << driven.err;
  expect_words(driven.err, {hdapi::kHoldInResetPose, "taken as done, as said by --in-reset-pose"});
  EXPECT_GE(seen().updates, 1);
}

// The stand-in prints in hdInitDevice and in hdStartScheduler.
TEST_F(phantom, writes_nothing_into_the_json_on_standard_output_and_is_named_there) {
  tell({.position = kFree});
  const CommandRun run = drive("--json -");
  EXPECT_EQ(run.code, 0) << run.err;
  expect_words(run.err, {"InitLogFile"});
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << run.out;
  EXPECT_EQ(json["device"]["model"], "Stand-in 1.5");
  EXPECT_EQ(json["device"]["serial"], "S-0042");
  EXPECT_EQ(json["paced_by"], "device");
  EXPECT_EQ(json["ticks"], 200);
}

TEST_F(phantom, writes_nothing_into_the_recording_on_standard_output) {
  tell({.position = kFree});
  const CommandRun run = drive("--record -");
  EXPECT_EQ(run.code, 0) << run.err;
  std::istringstream rows(run.out);
  std::string row, columns;
  std::getline(rows, columns);
  EXPECT_TRUE(columns.starts_with("tick,")) << columns;
  int ticks = 0;
  for (; std::getline(rows, row); ++ticks)
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(columns.begin(), columns.end(), ',')) << row;
  EXPECT_EQ(ticks, 201) << "and the zero force that ends them";
}

TEST_F(phantom, follows_this_machines_clock_where_the_command_line_says_so) {
  tell({.position = kFree});
  const CommandRun run = drive("--pace clock");
  EXPECT_EQ(run.code, 0) << run.err;
  expect_words(run.out, {" Hz, paced by the clock\n"});
}

TEST_F(phantom, whose_library_fails_in_a_frame_ends_the_command_in_words_and_with_its_exit_code) {
  struct Case {
    Crash crash;
    const char* words;
  };
  for (const auto& [crash, words] :
       {Case{{.how = Crash::How::exit, .when = Moment::settling}, "the process of the PHANToM's driver "},
        Case{{.how = Crash::How::segmentation_fault, .when = Moment::settling},
             "was ended by a signal (Segmentation fault)"}}) {
    stand_in_hd::reset();
    tell({.position = kFree, .crash = crash});
    const CommandRun run = drive("");
    EXPECT_EQ(run.code, 3) << run.err;
    expect_words(run.err, {"forceshade: device fault: ", words});
  }
}

}  // namespace
}  // namespace forceshade::device
