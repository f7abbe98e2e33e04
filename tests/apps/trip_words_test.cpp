// SPDX-License-Identifier: BSD-3-Clause
#include "apps/trip_words.h"

#include <gtest/gtest.h>

namespace forceshade::apps {
namespace {

device::ServoResult stopped(device::Rule rule, const device::Delay& delay, bool real_time = false) {
  device::ServoResult run;
  run.trip = {rule, delay.tick};
  run.worst_delay = delay;
  run.watchdog_timeout = 0.02;
  run.privileges.scheduling = real_time;
  return run;
}

constexpr device::Delay kOverslept{.tick = 812, .late_ms = 23.14, .before_ms = 0.2, .computed_ms = 0};
constexpr device::Delay kComputed{.tick = 812, .late_ms = 61, .before_ms = 62, .computed_ms = 61.5};
constexpr device::Delay kWaited{.tick = 812, .late_ms = 61, .before_ms = 62, .computed_ms = 0.3};

TEST(trip_words, state_how_late_a_tick_was_what_was_late_and_what_helps) {
  const std::string late = "watchdog: tick 812 began 61 ms after it was due, and --watchdog-timeout 0.02 allows 20 ms: ";
  EXPECT_EQ(
      words_of_trip(stopped(device::Rule::watchdog, kComputed)),
      late +
          "the tick before took 62 ms, of which 61.5 ms were computing. A lower --rate helps, or a surface of fewer parts "
          "or triangles.");
  EXPECT_EQ(
      words_of_trip(stopped(device::Rule::watchdog, kWaited, true)),
      late +
          "the tick before took 62 ms, of which 0.3 ms were computing. What helps: another processor for the loop (taskset), "
          "fewer other programs, or a machine that is not virtual.");
  EXPECT_EQ(
      words_of_trip(stopped(device::Rule::missed_deadlines, kOverslept)),
      "missed deadlines: tick 812 began 23.1 ms after it was due, and --watchdog-timeout 0.02 allows 20 ms: the system woke "
      "the loop late, and it grants the loop no real-time scheduling. What helps: the right to it ('ulimit -r 90', or a line "
      "with rtprio in /etc/security/limits.conf), fewer other programs, or a machine that is not virtual.");
}

TEST(trip_words, name_the_rule_where_lateness_was_not_the_reason) {
  EXPECT_EQ(words_of_trip(stopped(device::Rule::jump, kOverslept)), "jump");
  EXPECT_EQ(words_of_trip(stopped(device::Rule::unfinished, kOverslept)), "unfinished");
}

}  // namespace
}  // namespace forceshade::apps
