// SPDX-License-Identifier: BSD-3-Clause
// The words beside a run: the line that follows it, in a simulated world of a loop that pushes 1000 ticks a second and the
// view's own thread, and those of its last ticks.

#include "apps/live_view.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "apps/drive_summary.h"
#include "tests/world/in_the_world.h"

namespace forceshade::apps {
namespace {

// The lines drawn while a second of ticks is pushed. At tick 450 the loop wakes up 700 us late.
std::vector<std::string> drawn() {
  testing::internal::CaptureStderr();
  {
    LiveView view(8);
    const std::int64_t begin = system::now();
    for (std::uint64_t tick = 0; tick <= 1000; ++tick) {
      const std::int64_t due = begin + static_cast<std::int64_t>(tick) * 1'000'000;
      system::sleep_until(due);
      view.push({.tick = tick,
                 .wall_ns = due - begin,
                 .wakeup_ns = tick == 450 ? 700'000 : 10'000,
                 .force = {0, 0, static_cast<float>(tick) * 0.004F}});
    }
  }
  std::vector<std::string> lines;
  std::string all = testing::internal::GetCapturedStderr();
  for (std::size_t at = 0; (at = all.find('\r', at)) != std::string::npos; ++at)
    lines.push_back(all.substr(at + 1, all.find('\r', at + 1) - at - 1));
  return lines;
}

TEST_IN_THE_WORLD(live_view, draws_ten_times_a_second_and_leaves_an_empty_line) {
  const std::vector<std::string> lines = drawn();
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines.back(), "\033[K");
  EXPECT_TRUE(lines[1].starts_with("    0.2 s    1000 Hz")) << lines[1];
  EXPECT_NE(lines[4].find("2.0"), std::string::npos) << lines[4];
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(lines[i].find("late   700 us") != std::string::npos, i == 4) << i << ": " << lines[i];
}

// The device's clock says how long a tick was, and the loop's where that stands still.
TEST(last_ticks, have_a_speed_by_the_device_s_clock_or_by_that_of_the_loop) {
  for (const auto& [device_time, words] : {std::pair{2.002, ", 50 mm/s; force "}, {2.0, ", 100 mm/s; force "}}) {
    testing::internal::CaptureStdout();
    print_last_ticks({{.tick = 6, .wall_ns = 1'000'000, .device_time = 2, .position = {0, 0, 0}},
                      {.tick = 7, .wall_ns = 2'000'000, .device_time = device_time, .position = {0, 0, 0.1F}}});
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace forceshade::apps
