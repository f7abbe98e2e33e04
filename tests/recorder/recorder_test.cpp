// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "forceshade/recording.h"
#include "run/recorder/layout.h"
#include "run/recorder/loss.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/recorder/numbered_samples.h"
#include "tests/support/allocations.h"
#include "tests/support/temporary_directory.h"
#include "tests/world/in_the_world.h"

namespace forceshade::recorder {
namespace {

using namespace std::chrono_literals;
using tests::FaultyDisk;
using tests::TemporaryDirectory;

// In a world, what sleeps 100 ms finds a writer that has come so far: it looks every 25.
TEST_IN_THE_WORLD(recorder, gives_back_every_sample_to_the_bit) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  {
    Recorder recorder(path, {{"law", "wall"}, {"device", "null"}});
    for (std::uint64_t tick = 0; tick < 10'000; ++tick) recorder.push(sample(tick));
    const auto [written, lost, error] = recorder.close("time up");
    EXPECT_EQ(written, 10'000U);
    EXPECT_EQ(lost, 0U);
    EXPECT_EQ(error, "");
  }
  EXPECT_EQ(directory.entries(), 1) << "a finished recording is one file";
  const auto samples = samples_of(path);
  ASSERT_EQ(samples.size(), 10'000U);
  expect_ticks(samples);

  Recording recording(path);
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{});
  const Metadata& metadata = recording.metadata();
  EXPECT_EQ(metadata.at("law"), "wall");
  EXPECT_EQ(metadata.at("device"), "null");
  EXPECT_EQ(metadata.at("end_reason"), "time up");
  EXPECT_EQ(metadata.at("started").size(), std::strlen("2026-01-31T12:00:00Z"));
}

TEST_IN_THE_WORLD(recorder, allocates_nothing_in_push) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100});
  const std::size_t before = tests::allocations();
  for (std::uint64_t tick = 0; tick < 100'000; ++tick) recorder.push(sample(tick));
  EXPECT_EQ(tests::allocations(), before);
  recorder.close("time up");
  EXPECT_GT(tests::allocations(), before) << "the trap does not see allocations";
}

// Nothing is written before the ring is full: the first hundred are kept, the rest is a gap that the file reports.
TEST_IN_THE_WORLD(recorder, counts_what_a_full_ring_refuses_and_shows_the_gap) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  {
    Recorder recorder(path, {}, {.ring = 100, .interval = 1s});
    for (std::uint64_t tick = 0; tick < 150; ++tick) recorder.push(sample(tick));
    system::sleep_for(2s);
    EXPECT_EQ(Recording(path).extent().samples, 100U);
    for (std::uint64_t tick = 150; tick < 160; ++tick) recorder.push(sample(tick));
    const auto [written, lost, error] = recorder.close("time up");
    EXPECT_EQ(written, 110U);
    EXPECT_EQ(lost, 50U);
    EXPECT_EQ(error, "");
  }
  Recording recording(path);
  EXPECT_EQ(recording.extent().missing, 50U);
  EXPECT_EQ(problems_of(recording),
            (std::vector<std::string>{path + ": missing: ticks 100 to 149", path + ": 50 samples were lost while recording"}));
}

TEST_IN_THE_WORLD(recorder, waits_for_the_disk_if_it_may) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100, .interval = 10ms, .waits = true});
  for (std::uint64_t tick = 0; tick < 1000; ++tick) recorder.push(sample(tick));
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 1000U);
  EXPECT_EQ(lost, 0U);
  expect_ticks(samples_of(directory.file("run.fsr")));
}

TEST_IN_THE_WORLD(recorder, that_may_wait_does_not_wait_for_a_disk_that_takes_nothing) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100, .interval = 10ms, .waits = true});
  FaultyDisk::full = true;
  recorder.push(sample(0));
  system::sleep_for(100ms);
  ASSERT_TRUE(recorder.failing());
  for (std::uint64_t tick = 1; tick < 1000; ++tick) recorder.push(sample(tick));
  FaultyDisk::full = false;
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 101U);
  EXPECT_EQ(lost, 899U);
}

// All pushes together take less than one write of this disk, of which every chunk needs several.
TEST_IN_THE_WORLD(recorder, loses_nothing_to_a_slow_disk_and_never_waits_for_it) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {});
  FaultyDisk::write_ms = FaultyDisk::sync_ms = 40;
  std::int64_t pushing = 0;
  for (std::uint64_t tick = 0; tick < 500; ++tick) {
    const std::int64_t before = system::now();
    recorder.push(sample(tick));
    pushing += system::now() - before;
    system::sleep_for(1ms);
  }
  EXPECT_LT(pushing, system::in_ns(1ms));
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 500U);
  EXPECT_EQ(lost, 0U);
  const auto samples = samples_of(directory.file("run.fsr"));
  EXPECT_EQ(samples.size(), 500U);
  expect_ticks(samples);
}

TEST_IN_THE_WORLD(recorder, says_that_the_disk_is_full_and_keeps_what_it_took) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  const FaultyDisk disk;
  {
    Recorder recorder(path, {});
    for (std::uint64_t tick = 0; tick < 500; ++tick) recorder.push(sample(tick));
    system::sleep_for(100ms);
    ASSERT_TRUE(Recording(path).extent().samples == 500);
    EXPECT_FALSE(recorder.failing());
    FaultyDisk::full = true;
    for (std::uint64_t tick = 500; tick < 700; ++tick) recorder.push(sample(tick));
    system::sleep_for(100ms);
    ASSERT_TRUE(recorder.failing());
    const auto [written, lost, error] = recorder.close("time up");
    EXPECT_EQ(written, 500U);
    EXPECT_EQ(lost, 200U);
    EXPECT_EQ(error, path + ": database or disk is full");
  }
  EXPECT_GT(FaultyDisk::refused_writes, 0);
  const auto samples = samples_of(path);
  EXPECT_EQ(samples.size(), 500U);
  expect_ticks(samples);
  Recording recording(path);
  EXPECT_FALSE(recording.ended());
  EXPECT_EQ(problems_of(recording).size(), 1U);
}

// A chunk that the disk refused waits in the writer, further ones behind it in the ring: each sample is lost once, or, where
// there is room again, none is.
TEST_IN_THE_WORLD(recorder, counts_every_chunk_that_waits_for_a_full_disk) {
  constexpr std::uint64_t kWritten = 300, kWaiting = 3 * kLongestChunk + 7;
  for (const bool gets_room : {false, true}) {
    const TemporaryDirectory directory;
    const std::string path = directory.file("run.fsr");
    const FaultyDisk disk;
    Recorder recorder(path, {});
    for (std::uint64_t tick = 0; tick < kWritten; ++tick) recorder.push(sample(tick));
    system::sleep_for(100ms);
    ASSERT_TRUE(Recording(path).extent().samples == kWritten);
    FaultyDisk::full = true;
    for (std::uint64_t tick = kWritten; tick < kWritten + kWaiting; ++tick) recorder.push(sample(tick));
    system::sleep_for(100ms);
    ASSERT_TRUE(recorder.failing());
    if (gets_room) {
      FaultyDisk::full = false;
      system::sleep_for(100ms);
      ASSERT_TRUE(!recorder.failing());
    }
    const auto [written, lost, error] = recorder.close("time up");
    EXPECT_EQ(written, gets_room ? kWritten + kWaiting : kWritten);
    EXPECT_EQ(lost, gets_room ? 0 : kWaiting);
    EXPECT_EQ(error, gets_room ? "" : path + ": database or disk is full");
    const auto samples = samples_of(path);
    EXPECT_EQ(samples.size(), written);
    expect_ticks(samples);
  }
}

TEST_IN_THE_WORLD(recorder, loses_nothing_when_a_full_disk_gets_room_again) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  const FaultyDisk disk;
  Recorder recorder(path, {});
  FaultyDisk::full = true;
  for (std::uint64_t tick = 0; tick < 700; ++tick) recorder.push(sample(tick));
  system::sleep_for(100ms);
  ASSERT_TRUE(recorder.failing());
  FaultyDisk::full = false;
  system::sleep_for(100ms);
  ASSERT_TRUE(!recorder.failing());
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 700U);
  EXPECT_EQ(lost, 0U);
  EXPECT_EQ(error, "");
  Recording recording(path);
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{});
}

// Before the first tick the file reaches the disk, so that a loss of power leaves its metadata, and at the end all of it does.
TEST_IN_THE_WORLD(recorder, syncs_the_file_at_its_beginning_and_at_its_end) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {});
  const int begun = FaultyDisk::syncs;
  EXPECT_GT(begun, 0);
  for (std::uint64_t tick = 0; tick < 10; ++tick) recorder.push(sample(tick));
  recorder.close("time up");
  EXPECT_GT(FaultyDisk::syncs, begun);
}

TEST_IN_THE_WORLD(recorder, says_that_the_recording_was_deleted) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  Recorder recorder(path, {});
  for (std::uint64_t tick = 0; tick < 10; ++tick) recorder.push(sample(tick));
  std::filesystem::remove(path);
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 0U);
  EXPECT_EQ(lost, 10U);
  EXPECT_EQ(error, path + ": the recording was deleted while it was made");
}

TEST_IN_THE_WORLD(recorder, never_overwrites_and_leaves_no_file_that_it_cannot_begin) {
  const TemporaryDirectory directory;
  const std::string old = directory.write("old.fsr", "precious");
  EXPECT_THROW(Recorder(old, {}), Error);
  EXPECT_EQ(directory.read("old.fsr"), "precious");
  EXPECT_THROW(Recorder(directory.file("absent/run.fsr"), {}), Error);
  const FaultyDisk disk;
  FaultyDisk::full = true;
  EXPECT_THROW(Recorder(directory.file("run.fsr"), {}), Error);
  EXPECT_EQ(directory.entries(), 1);
}

TEST_IN_THE_WORLD(recorder, without_a_close_is_marked_as_cut_off) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  {
    Recorder recorder(path, {});
    for (std::uint64_t tick = 0; tick < 10; ++tick) recorder.push(sample(tick));
  }
  Recording recording(path);
  EXPECT_FALSE(recording.ended());
  EXPECT_EQ(recording.extent().samples, 10U);
}

TEST(recorder, says_what_is_lost_and_is_silent_where_nothing_is) {
  for (const auto& [result, words] : {std::pair{Recorder::Result{7, 0, ""}, ""},
                                      {Recorder::Result{7, 1, ""}, "a.fsr: the disk was too slow; recorded 7 samples, lost 1"},
                                      {Recorder::Result{7, 0, "a.fsr: full"}, "a.fsr: full; recorded 7 samples, lost 0"},
                                      {Recorder::Result{0, 8, "a.fsr: full"}, "a.fsr: full; recorded 0 samples, lost 8"}})
    EXPECT_EQ(words_of_loss("a.fsr", result), words);
}

}  // namespace
}  // namespace forceshade::recorder
