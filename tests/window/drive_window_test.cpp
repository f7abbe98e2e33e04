// SPDX-License-Identifier: BSD-3-Clause
// forceshade drive --device mouse in its real window: the command, its servo loop, and a mouse and keys on a display in memory.

#include <gtest/gtest.h>

#include <string>

#include "mouse_driver.h"

namespace forceshade::window {
namespace {

TEST_F(drive_window, ends_when_the_window_is_closed_or_the_time_is_up) {
  Driver closed({"--law", "wall"});
  EXPECT_TRUE(ask_to_close());
  EXPECT_TRUE(closed.end().starts_with("exit 0: "));
  Driver timed({"--law", "wall"}, {"--seconds", "1"});
  EXPECT_TRUE(timed.end().starts_with("exit 0: "));
  EXPECT_NE(timed.folder().read("run.json").find("\"time up\""), std::string::npos) << timed.folder().read("run.json");
}

TEST_F(drive_window, is_refused_without_a_display_before_anything_is_recorded) {
  const tests::TemporaryDirectory folder;
  Command command(folder, {"drive", "--law", "wall", "--device", "mouse", "--uncertified", "--record", "run.fsr"},
                  {"DISPLAY=", "WAYLAND_DISPLAY="});
  const std::string end = command.end();
  EXPECT_TRUE(end.starts_with("exit 2: ")) << end;
  EXPECT_NE(end.find("no window can be opened: "), std::string::npos) << end;
  EXPECT_NE(end.find("(is there a display?)"), std::string::npos) << end;
  EXPECT_EQ(folder.entries(), 1) << "expected nothing but the output";
}

}  // namespace
}  // namespace forceshade::window
