// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/parts.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "forceshade/recording.h"
#include "tests/support/temporary_directory.h"
#include "tests/world/in_the_world.h"

namespace forceshade::apparatus {
namespace {

using recorder::problems_of;
using recorder::Recorder;
using recorder::Recording;
using tests::TemporaryDirectory;

TEST_IN_THE_WORLD(parts, that_cannot_be_made_leave_the_one_before_as_it_is) {
  const TemporaryDirectory directory;
  Parts parts(Recorder::Options{});
  parts.push({.tick = 0});  // goes nowhere
  parts.begin(directory.file("a.fsr"), {});
  parts.push({.tick = 0});
  EXPECT_THROW(parts.begin(directory.file("a.fsr"), {}), Error);
  parts.push({.tick = 1});
  parts.end("over");
  Recording recording(directory.file("a.fsr"));
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{});
  EXPECT_EQ(recording.extent().samples, 2U);
}

// A ring that is full while the disk is in order: nothing failed, and still samples are missing.
TEST_IN_THE_WORLD(parts, that_lost_a_tick_say_so_even_where_the_disk_took_the_others) {
  const TemporaryDirectory directory;
  for (const bool has_next : {false, true}) {
    Parts parts({.ring = 4, .interval = std::chrono::seconds(10)});
    const std::string path = directory.file(has_next ? "b.fsr" : "a.fsr");
    parts.begin(path, {});
    for (std::uint64_t tick = 0; tick < 50; ++tick) parts.push({.tick = tick});
    std::string words = "nothing";
    try {
      if (has_next) parts.begin(directory.file("c.fsr"), {});
      parts.end("over");
    } catch (const Error& error) {
      words = error.what();
    }
    EXPECT_TRUE(words.starts_with(path + ": the disk was too slow; recorded ")) << words;
    const std::uint64_t samples = Recording(path).extent().samples;
    EXPECT_LT(samples, 50U);
    EXPECT_NE(words.find("recorded " + std::to_string(samples) + " samples, lost " + std::to_string(50 - samples)),
              std::string::npos)
        << words;
  }
}

// The lost ticks belong to the part before, and are reported by end(): the last part is whole.
TEST_IN_THE_WORLD(parts, after_one_that_lost_ticks_have_their_own_end) {
  const TemporaryDirectory directory;
  Parts parts({.ring = 4, .interval = std::chrono::seconds(10)});
  parts.begin(directory.file("a.fsr"), {});
  for (std::uint64_t tick = 0; tick < 50; ++tick) parts.push({.tick = tick});
  parts.begin(directory.file("b.fsr"), {});
  parts.push({.tick = 50});
  EXPECT_THROW(parts.end("over"), Error);
  Recording last(directory.file("b.fsr"));
  EXPECT_EQ(problems_of(last), std::vector<std::string>{});
  EXPECT_EQ(last.extent().samples, 1U);
  ASSERT_TRUE(last.ended());
  EXPECT_EQ(last.metadata().at("end_reason"), "over");
}

}  // namespace
}  // namespace forceshade::apparatus
