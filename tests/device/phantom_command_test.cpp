// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM through the command, as its users have it, where it does not come to a run: what is printed, and the exit code.

#include <gtest/gtest.h>

#include <string>

#include "tests/device/stand_in_hd/phantom_fixture.h"
#include "tests/support/command_run.h"

namespace forceshade::device {
namespace {

using stand_in_hd::Crash;
using stand_in_hd::Moment;
using tests::CommandRun;

CommandRun drive() {
  const tests::TemporaryDirectory here;
  return tests::run_command(here, tests::words_of("drive --law wall --uncertified --device phantom --seconds 0.2"));
}

TEST_F(phantom, that_nobody_says_is_in_its_reset_pose_is_refused_where_there_is_no_terminal) {
  const Orders premium{.calibration = std::nullopt, .styles = hdapi::kCalibratesAtResetPose};
  tell(premium);
  const CommandRun refused = drive();
  EXPECT_EQ(refused.code, 3) << refused.err;
  expect_words(refused.err, {"there is no terminal", "give --in-reset-pose", "device fault: the PHANToM is not calibrated"});
  EXPECT_EQ(seen().updates, 0);
  EXPECT_TRUE(seen().frames.empty());
}

TEST_F(phantom, whose_library_fails_while_it_is_opened_ends_the_command_in_words_and_with_its_exit_code) {
  struct Case {
    Crash crash;
    const char* words;
  };
  for (const auto& [crash, words] :
       {Case{{.how = Crash::How::exit, .when = Moment::before_start}, "ended with exit code 0"},
        Case{{.how = Crash::How::abort, .when = Moment::before_start}, "was ended by a signal (Aborted)"},
        Case{{.how = Crash::How::exception, .when = Moment::before_start}, "the vendor's library failed: thrown by the driver"},
        Case{{.how = Crash::How::segmentation_fault, .when = Moment::before_start},
             "was ended by a signal (Segmentation fault)"}}) {
    stand_in_hd::reset();
    tell({.crash = crash});
    const CommandRun run = drive();
    EXPECT_EQ(run.code, 3) << run.err;
    expect_words(run.err, {"forceshade: device fault: ", words});
  }
}

}  // namespace
}  // namespace forceshade::device
