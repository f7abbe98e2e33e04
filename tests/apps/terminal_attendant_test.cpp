// SPDX-License-Identifier: BSD-3-Clause
// The person at the terminal: a process of its own on a terminal of its own, where the test types.

#include "apps/terminal_attendant.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <csignal>

#include "apps/signals.h"
#include "tests/support/pseudo_terminal.h"

namespace forceshade::apps {
namespace {

using tests::PseudoTerminal;

constexpr int kDone = 10, kNotDone = 11;
constexpr const char* kWords = "Hold the arm in its reset pose.";
constexpr const char* kPrompt = "Press Enter when this is done, or Ctrl-C to end here. ";

int confirm(device::Attendant& attendant) {
  end_runs_in_order();
  return attendant.did(kWords) ? kDone : kNotDone;
}

int confirm_by_a_person() {
  TerminalAttendant person("give --in-reset-pose");
  return confirm(person);
}

TEST(terminal_attendant, shows_what_is_to_be_done_and_waits_for_enter) {
  PseudoTerminal terminal(confirm_by_a_person);
  const std::string shown = terminal.shown_until(kPrompt);
  EXPECT_NE(shown.find(kWords), std::string::npos) << shown;
  EXPECT_TRUE(terminal.is_running());
  terminal.type("\n");
  EXPECT_EQ(terminal.end(), kDone);
}

TEST(terminal_attendant, takes_ctrl_c_for_no) {
  PseudoTerminal terminal(confirm_by_a_person);
  terminal.shown_until(kPrompt);
  terminal.type("\x03");
  EXPECT_EQ(terminal.end(), kNotDone);
}

TEST(terminal_attendant, takes_the_end_of_input_for_no) {
  PseudoTerminal terminal(confirm_by_a_person);
  terminal.shown_until(kPrompt);
  terminal.type("\x04");
  EXPECT_EQ(terminal.end(), kNotDone);
}

// An Enter that was typed too early, then the end of input: had the first one counted, it would be done.
TEST(terminal_attendant, does_not_count_what_was_typed_before) {
  PseudoTerminal terminal([] {
    pollfd typed{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    ::poll(&typed, 1, -1);
    return confirm_by_a_person();
  });
  terminal.type("\n");
  terminal.shown_until(kPrompt);
  terminal.type("\x04");
  EXPECT_EQ(terminal.end(), kNotDone);
}

TEST(terminal_attendant, uses_the_terminal_whatever_the_standard_streams_are) {
  PseudoTerminal terminal([] {
    // While nobody has the terminal open, its other end reads as though the process had ended.
    if (::dup(STDIN_FILENO) < 0) return kNotDone;
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) tests::send_to_null(stream);
    return confirm_by_a_person();
  });
  terminal.shown_until(kPrompt);
  terminal.type("\n");
  EXPECT_EQ(terminal.end(), kDone);
}

TEST(terminal_attendant, says_so_where_there_is_no_terminal) {
  // In a session of its own, which has no terminal; its words still come here.
  PseudoTerminal terminal([] {
    tests::send_to_null(STDIN_FILENO);
    if (::fork() == 0) {
      ::setsid();
      ::_exit(confirm_by_a_person());
    }
    int status = 0;
    ::wait(&status);
    return WEXITSTATUS(status);
  });
  const std::string shown = terminal.shown_until("give --in-reset-pose");
  EXPECT_NE(shown.find("there is no terminal"), std::string::npos) << shown;
  EXPECT_NE(shown.find(kWords), std::string::npos) << shown;
  EXPECT_EQ(terminal.end(), kNotDone);
}

TEST(terminal_attendant, confirms_the_reset_pose_where_that_was_said_beforehand) {
  PseudoTerminal terminal([] {
    HoldsResetPose holds;
    return confirm(holds);
  });
  const std::string shown = terminal.shown_until("--in-reset-pose");
  EXPECT_NE(shown.find(kWords), std::string::npos) << shown;
  EXPECT_EQ(terminal.end(), kDone);
}

TEST(terminal_attendant, offers_keys_for_buttons_only_where_that_was_said) {
  PseudoTerminal terminal([] {
    TerminalAttendant person("");
    return person.buttons() == nullptr ? kDone : kNotDone;
  });
  EXPECT_EQ(terminal.end(), kDone);
}

// One turn of the keys: pressed, let go of, both at once, and other keys.
TEST(keyboard_buttons, go_down_and_up_with_each_key_typed_and_leave_the_terminal_as_it_was) {
  PseudoTerminal terminal([] {
    termios before{}, during{}, after{};
    ::tcgetattr(STDIN_FILENO, &before);
    {
      const KeyboardButtons keys;
      if (!keys.works() || keys.down() != 0) return kNotDone;
      ::tcgetattr(STDIN_FILENO, &during);
      int step = 0;
      for (const unsigned expected : {1U, 0U, 2U, 3U}) {
        std::printf("step %d\n", ++step);
        std::fflush(stdout);
        while (keys.down() != expected) ::usleep(1000);  // the terminal's end ends it
      }
    }
    ::tcgetattr(STDIN_FILENO, &after);
    const bool turned = (during.c_lflag & (ICANON | ECHO)) == 0 && (during.c_lflag & ISIG) != 0;
    return turned && after.c_lflag == before.c_lflag && (before.c_lflag & ICANON) != 0 ? kDone : kNotDone;
  });
  int step = 0;
  for (const char* keys : {"0", "0", "q9 \n1", "0"}) {
    terminal.shown_until("step " + std::to_string(++step));
    terminal.type(keys);
  }
  EXPECT_EQ(terminal.end(), kDone);
  EXPECT_EQ(terminal.shown().find("q9"), std::string::npos) << "keys are not shown";
}

TEST(keyboard_buttons, do_not_work_where_there_is_no_terminal) {
  PseudoTerminal terminal([] {
    if (::fork() == 0) {
      ::setsid();
      const KeyboardButtons keys;
      ::_exit(!keys.works() && keys.down() == 0 ? kDone : kNotDone);
    }
    int status = 0;
    ::wait(&status);
    return WEXITSTATUS(status);
  });
  EXPECT_EQ(terminal.end(), kDone);
}

TEST(terminal_attendant, shows_no_control_characters_of_a_driver) {
  PseudoTerminal terminal([] {
    TerminalAttendant("").report("one\nname \x1b[2J");
    return kDone;
  });
  const std::string shown = terminal.shown_until("[2J");
  EXPECT_NE(shown.find("forceshade: one\r\nname \\x1b[2J"), std::string::npos) << shown;
  EXPECT_EQ(terminal.end(), kDone);
}

}  // namespace
}  // namespace forceshade::apps
