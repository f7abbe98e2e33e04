// SPDX-License-Identifier: BSD-3-Clause
// The line that follows a run, in a simulated world: a loop that pushes 1000 ticks a second, and the view's own thread.

#include "apps/live_view.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

}  // namespace
}  // namespace forceshade::apps
