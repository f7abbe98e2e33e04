// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <utility>

#include "forceshade/recording.h"
#include "run/recorder/layout.h"
#include "run/recorder/loss.h"
#include "run/recorder/sqlite.h"
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

void push(Recorder& recorder, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t tick = from; tick < to; ++tick) recorder.push(sample(tick));
}

void expect_result(Recorder& recorder, std::uint64_t written, std::uint64_t lost, const std::string& error = "") {
  const Recorder::Result result = recorder.close("time up");
  EXPECT_EQ(result.written, written);
  EXPECT_EQ(result.lost, lost);
  EXPECT_EQ(result.error, error);
}

// As many as were pushed.
void expect_samples(const std::string& path, std::uint64_t count) {
  const auto samples = samples_of(path);
  EXPECT_EQ(samples.size(), count);
  expect_ticks(samples);
}

// In a world, what sleeps 100 ms finds a writer that has come so far: it looks every 25.
TEST_IN_THE_WORLD(recorder, gives_back_every_sample_to_the_bit) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  {
    Recorder recorder(path, {{"law", "wall"}, {"device", std::string("null\0, of no kind", 17)}});
    push(recorder, 0, 10'000);
    expect_result(recorder, 10'000, 0);
  }
  EXPECT_EQ(directory.entries(), 1) << "a finished recording is one file";
  expect_samples(path, 10'000);

  Recording recording(path);
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{});
  const Metadata& metadata = recording.metadata();
  EXPECT_EQ(metadata.at("law"), "wall");
  EXPECT_EQ(metadata.at("device"), std::string("null\0, of no kind", 17));
  EXPECT_EQ(metadata.at("end_reason"), "time up");
  EXPECT_EQ(metadata.at("started").size(), std::strlen("2026-01-31T12:00:00Z"));
}

// A program from before damping refuses what it would misread.
TEST_IN_THE_WORLD(recorder, says_by_its_format_whether_forces_were_damped) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  for (const auto& [metadata, format] :
       {std::pair{Metadata{{"law", "wall"}}, kFormatVersion}, {Metadata{{kDampingKey, "1000"}}, kFormatOfDamping}}) {
    Recorder(path, metadata).close("time up");
    EXPECT_EQ(Database(path, Database::Access::read).integer("PRAGMA user_version"), format);
    std::filesystem::remove(path);
  }
}

TEST_IN_THE_WORLD(recorder, allocates_nothing_in_push) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100});
  const std::size_t before = tests::allocations();
  push(recorder, 0, 100'000);
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
    push(recorder, 0, 150);
    system::sleep_for(2s);
    EXPECT_EQ(Recording(path).extent().samples, 100U);
    push(recorder, 150, 160);
    expect_result(recorder, 110, 50);
  }
  Recording recording(path);
  EXPECT_EQ(recording.extent().missing, 50U);
  EXPECT_EQ(problems_of(recording),
            (std::vector<std::string>{path + ": missing: ticks 100 to 149", path + ": 50 samples were lost while recording"}));
}

TEST_IN_THE_WORLD(recorder, waits_for_the_disk_if_it_may) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100, .interval = 10ms, .waits = true});
  push(recorder, 0, 1000);
  expect_result(recorder, 1000, 0);
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
  push(recorder, 1, 1000);
  FaultyDisk::full = false;
  expect_result(recorder, 101, 899);
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
    push(recorder, 0, kWritten);
    system::sleep_for(100ms);
    ASSERT_TRUE(Recording(path).extent().samples == kWritten);
    FaultyDisk::full = true;
    push(recorder, kWritten, kWritten + kWaiting);
    system::sleep_for(100ms);
    ASSERT_TRUE(recorder.failing());
    if (gets_room) {
      FaultyDisk::full = false;
      system::sleep_for(100ms);
      ASSERT_TRUE(!recorder.failing());
    }
    const std::uint64_t written = gets_room ? kWritten + kWaiting : kWritten;
    expect_result(recorder, written, gets_room ? 0 : kWaiting, gets_room ? "" : path + ": database or disk is full");
    expect_samples(path, written);
    EXPECT_EQ(Recording(path).extent().samples, written);
    EXPECT_EQ(Recording(path).ended(), gets_room);
  }
}

// SQLite goes on writing, and nobody will ever read it.
TEST_IN_THE_WORLD(recorder, says_that_its_file_was_deleted) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  Recorder recorder(path, {});
  push(recorder, 0, 10);
  std::filesystem::remove(path);
  expect_result(recorder, 0, 10, path + ": the recording was deleted while it was made");
}

// Before the first tick the file reaches the disk, so that a loss of power leaves its metadata, and at the end all of it does.
TEST_IN_THE_WORLD(recorder, syncs_the_file_at_its_beginning_and_at_its_end) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {});
  const int begun = FaultyDisk::syncs;
  EXPECT_GT(begun, 0);
  push(recorder, 0, 10);
  recorder.close("time up");
  EXPECT_GT(FaultyDisk::syncs, begun);
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
    push(recorder, 0, 10);
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
