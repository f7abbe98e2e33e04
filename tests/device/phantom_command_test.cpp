// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM through the command, as its users have it, where it does not come to a run: what is printed, and the exit code.

#include <gtest/gtest.h>

#include <string>

#include "tests/device/stand_in_hd/phantom_fixture.h"
#include "tests/support/command_run.h"

namespace forceshade::device {
namespace {

using tests::CommandRun;

CommandRun drive() {
  const tests::TemporaryDirectory here;
  return tests::run_command(here, tests::words_of("drive --law wall --uncertified --device phantom --seconds 0.2"));
}

TEST_F(phantom, that_nobody_says_is_in_its_reset_pose_is_refused_where_there_is_no_terminal) {
  tell({.needs_reset_pose = true});
  const CommandRun refused = drive();
  EXPECT_EQ(refused.code, 3) << refused.err;
  expect_words(refused.err, {"there is no terminal", "give --in-reset-pose", "device fault: the PHANToM is not calibrated"});
  EXPECT_EQ(seen().updates, 0);
  EXPECT_EQ(seen().frames, 0U);
}

// The words for each way to fail are those of phantom_process_test.
TEST_F(phantom, whose_library_fails_while_it_is_opened_ends_the_command_in_words_and_with_its_exit_code) {
  tell({.crash = {.how = stand_in_hd::Crash::How::abort, .when = stand_in_hd::Moment::before_start}});
  const CommandRun run = drive();
  EXPECT_EQ(run.code, 3) << run.err;
  expect_words(run.err, {"forceshade: device fault: ", "was ended by a signal (Aborted)"});
}

}  // namespace
}  // namespace forceshade::device
