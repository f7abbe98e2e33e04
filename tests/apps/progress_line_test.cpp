// SPDX-License-Identifier: BSD-3-Clause
#include "apps/progress_line.h"

#include <gtest/gtest.h>

#include <optional>

namespace forceshade::apps {
namespace {

// A line on a clock that only a test moves.
class Watched {
 public:
  explicit Watched(bool is_terminal) {
    line_.emplace("sweeps", is_terminal, [this] { return ProgressLine::Clock::time_point(now_); });
  }

  // Draws so many seconds later; returns what is written to standard error.
  std::string after(int seconds, double done, const std::string& details = "") {
    now_ += std::chrono::seconds(seconds);
    testing::internal::CaptureStderr();
    line_->draw(done, details);
    return testing::internal::GetCapturedStderr();
  }
  std::string end() {
    testing::internal::CaptureStderr();
    line_.reset();
    return testing::internal::GetCapturedStderr();
  }

 private:
  std::chrono::seconds now_{1000};
  std::optional<ProgressLine> line_;
};

TEST(progress_line, logs_share_time_left_and_rate_each_minute_where_there_is_no_terminal) {
  Watched line(false);
  EXPECT_EQ(line.after(0, 0), "");
  EXPECT_EQ(line.after(59, 0.1, "98 M inputs/s  wall direction"), "");
  EXPECT_EQ(line.after(1, 0.2, "98 M inputs/s  wall direction"),
            "forceshade: sweeps: 20.0 %  0:04:00 left  98 M inputs/s  wall direction\n");
  EXPECT_EQ(line.after(30, 0.3), "") << "half a minute later";
  EXPECT_EQ(line.after(30, 0.5), "forceshade: sweeps: 50.0 %  0:02:00 left\n");
  EXPECT_EQ(line.end(), "");
}

TEST(progress_line, counts_only_what_this_run_has_done_for_the_time_left) {
  Watched line(false);
  line.after(0, 0.5);
  EXPECT_EQ(line.after(3600, 0.6), "forceshade: sweeps: 60.0 %  4:00:00 left\n");
}

TEST(progress_line, states_no_time_where_nothing_has_been_done_yet) {
  Watched line(false);
  line.after(0, 0.25);
  EXPECT_EQ(line.after(60, 0.25), "forceshade: sweeps: 25.0 %\n");
}

TEST(progress_line, is_drawn_over_itself_on_a_terminal_and_removed_at_the_end) {
  Watched line(true);
  EXPECT_EQ(line.after(0, 0), "");
  EXPECT_EQ(line.after(10, 0.5, "5 points/s"), "\r50.0 %  0:00:10 left  5 points/s  Ctrl-C stops  sweeps\033[K");
  EXPECT_EQ(line.after(0, 0.6), "") << "not at every call";
  EXPECT_EQ(line.end(), "\r\033[K");
}

TEST(progress_line, leaves_a_terminal_alone_that_it_did_not_draw_on) {
  Watched line(true);
  line.after(0, 0);
  EXPECT_EQ(line.end(), "");
}

}  // namespace
}  // namespace forceshade::apps
