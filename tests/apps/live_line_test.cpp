// SPDX-License-Identifier: BSD-3-Clause
#include "apps/live_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace forceshade::apps {
namespace {

const LiveLine kOrdinary{12.34, 1000, 15, 1.5, 8.5, -2.25, ""};
const LiveLine kLimited{12.34, 1000, 15, 1.5, 8.5, -2.25, "velocity, force"};

TEST(live_line, shows_everything_where_there_is_room) {
  EXPECT_EQ(live_line(kOrdinary, 100), "   12.3 s    1000 Hz  late    15 us  [####                ]   1.500 N     -2.250 mJ");
  EXPECT_TRUE(live_line(kLimited, 120).ends_with("velocity, force"));
}

TEST(live_line, is_never_wider_than_the_room) {
  const double huge = std::numeric_limits<double>::max(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const LiveLine& line : {kOrdinary, kLimited, LiveLine{huge, huge, huge, huge, 1, -huge, std::string(300, 'x')},
                               LiveLine{nan, nan, nan, nan, nan, nan, ""}})
    for (int room = -1; room <= 200; ++room)
      EXPECT_LE(static_cast<int>(live_line(line, room).size()), std::max(room, 0)) << room;
}

TEST(live_line, leaves_out_the_bar_first_and_the_force_last) {
  const auto shows = [](const char* what, int room) { return live_line(kLimited, room).find(what) != std::string::npos; };
  EXPECT_TRUE(shows("[####", 110));
  EXPECT_FALSE(shows("[", 90));
  EXPECT_TRUE(shows("late", 79));
  int last = 110;
  for (const char* piece : {"[", "late", "Hz", " s", "mJ", "velocity", " N"}) {
    int room = 110;
    while (room > 0 && shows(piece, room)) --room;
    EXPECT_LE(room, last) << piece;
    last = room;
  }
  EXPECT_TRUE(shows("1.500 N", 10));
}

TEST(live_line, bar_is_full_at_the_full_force_and_beyond) {
  const auto hashes = [](double force) {
    LiveLine line = kOrdinary;
    line.force = force;
    const std::string text = live_line(line, 200);
    return std::count(text.begin(), text.end(), '#');
  };
  EXPECT_EQ(hashes(0), 0);
  EXPECT_EQ(hashes(4.25), 10);
  EXPECT_EQ(hashes(8.5), 20);
  EXPECT_EQ(hashes(1e9), 20);
}

}  // namespace
}  // namespace forceshade::apps
