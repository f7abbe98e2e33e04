// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <future>
#include <thread>

#include "forceshade/recording.h"
#include "recorder/layout.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/support/allocations.h"
#include "tests/support/comes_true.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::recorder {
namespace {

using namespace std::chrono_literals;
using device::Sample;
using tests::comes_true;  // the writer's thread has come so far
using tests::FaultyDisk;
using tests::TemporaryDirectory;
using Clock = std::chrono::steady_clock;

// Every byte differs from tick to tick, and every member from the others.
Sample sample(std::uint64_t tick) {
  Sample s;
  unsigned char bytes[sizeof s];
  for (std::size_t i = 0; i < sizeof s; ++i) bytes[i] = static_cast<unsigned char>((tick * 7 + i * 13) ^ (tick >> 8));
  std::memcpy(&s, bytes, sizeof s);
  s.tick = tick;
  return s;
}

std::vector<Sample> samples_of(const std::string& path) {
  std::vector<Sample> all;
  Recording(path).for_each_chunk([&](std::span<const Sample> chunk) { all.insert(all.end(), chunk.begin(), chunk.end()); });
  return all;
}

// 0, 1, 2, ... as they were pushed.
void expect_ticks(const std::vector<Sample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample expected = sample(k);
    ASSERT_EQ(std::memcmp(&samples[k], &expected, sizeof expected), 0) << "tick " << k;
  }
}

TEST(recorder, gives_back_every_sample_to_the_bit) {
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

TEST(recorder, allocates_nothing_in_push) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100});
  const std::size_t before = tests::allocations();
  for (std::uint64_t tick = 0; tick < 100'000; ++tick) recorder.push(sample(tick));
  EXPECT_EQ(tests::allocations(), before);
  recorder.close("time up");
  EXPECT_GT(tests::allocations(), before) << "the trap does not see allocations";
}

// Nothing is written before the ring is full: the first hundred are kept, the rest is a gap that the file reports.
TEST(recorder, counts_what_a_full_ring_refuses_and_shows_the_gap) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  {
    Recorder recorder(path, {}, {.ring = 100, .interval = 1s});
    for (std::uint64_t tick = 0; tick < 150; ++tick) recorder.push(sample(tick));
    ASSERT_TRUE(comes_true([&] { return Recording(path).extent().samples == 100; }));
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

TEST(recorder, waits_for_the_disk_if_it_may) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100, .interval = 10ms, .waits = true});
  for (std::uint64_t tick = 0; tick < 1000; ++tick) recorder.push(sample(tick));
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 1000U);
  EXPECT_EQ(lost, 0U);
  expect_ticks(samples_of(directory.file("run.fsr")));
}

TEST(recorder, that_may_wait_does_not_wait_for_a_disk_that_takes_nothing) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {}, {.ring = 100, .interval = 10ms, .waits = true});
  FaultyDisk::full = true;
  recorder.push(sample(0));
  ASSERT_TRUE(comes_true([&] { return recorder.failing(); }));
  auto pushing = std::async(std::launch::async, [&] {
    for (std::uint64_t tick = 1; tick < 1000; ++tick) recorder.push(sample(tick));
  });
  EXPECT_EQ(pushing.wait_for(10s), std::future_status::ready);
  const std::uint64_t refused = pushing.wait_for(0s) == std::future_status::ready ? 899 : 0;
  FaultyDisk::full = false;  // for a push that waits
  pushing.wait();
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 1000 - refused);
  EXPECT_EQ(lost, refused);
}

// All pushes together take less than one write of this disk, of which every chunk needs several.
TEST(recorder, loses_nothing_to_a_slow_disk_and_never_waits_for_it) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {});
  FaultyDisk::write_ms = FaultyDisk::sync_ms = 40;
  auto pushing = Clock::duration::zero();
  for (std::uint64_t tick = 0; tick < 500; ++tick) {
    const auto before = Clock::now();
    recorder.push(sample(tick));
    pushing += Clock::now() - before;
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_LT(pushing, 40ms);
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 500U);
  EXPECT_EQ(lost, 0U);
  const auto samples = samples_of(directory.file("run.fsr"));
  EXPECT_EQ(samples.size(), 500U);
  expect_ticks(samples);
}

TEST(recorder, says_that_the_disk_is_full_and_keeps_what_it_took) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  const FaultyDisk disk;
  {
    Recorder recorder(path, {});
    for (std::uint64_t tick = 0; tick < 500; ++tick) recorder.push(sample(tick));
    ASSERT_TRUE(comes_true([&] { return Recording(path).extent().samples == 500; }));
    EXPECT_FALSE(recorder.failing());
    FaultyDisk::full = true;
    for (std::uint64_t tick = 500; tick < 700; ++tick) recorder.push(sample(tick));
    EXPECT_TRUE(comes_true([&] { return recorder.failing(); }));
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
TEST(recorder, counts_every_chunk_that_waits_for_a_full_disk) {
  constexpr std::uint64_t kWritten = 300, kWaiting = 3 * kLongestChunk + 7;
  for (const bool gets_room : {false, true}) {
    const TemporaryDirectory directory;
    const std::string path = directory.file("run.fsr");
    const FaultyDisk disk;
    Recorder recorder(path, {});
    for (std::uint64_t tick = 0; tick < kWritten; ++tick) recorder.push(sample(tick));
    ASSERT_TRUE(comes_true([&] { return Recording(path).extent().samples == kWritten; }));
    FaultyDisk::full = true;
    for (std::uint64_t tick = kWritten; tick < kWritten + kWaiting; ++tick) recorder.push(sample(tick));
    ASSERT_TRUE(comes_true([&] { return recorder.failing(); }));
    if (gets_room) {
      FaultyDisk::full = false;
      ASSERT_TRUE(comes_true([&] { return !recorder.failing(); }));
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

TEST(recorder, loses_nothing_when_a_full_disk_gets_room_again) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  const FaultyDisk disk;
  Recorder recorder(path, {});
  FaultyDisk::full = true;
  for (std::uint64_t tick = 0; tick < 700; ++tick) recorder.push(sample(tick));
  ASSERT_TRUE(comes_true([&] { return recorder.failing(); }));
  FaultyDisk::full = false;
  ASSERT_TRUE(comes_true([&] { return !recorder.failing(); }));
  const auto [written, lost, error] = recorder.close("time up");
  EXPECT_EQ(written, 700U);
  EXPECT_EQ(lost, 0U);
  EXPECT_EQ(error, "");
  Recording recording(path);
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{});
}

// Before the first tick the file reaches the disk, so that a loss of power leaves its metadata, and at the end all of it does.
TEST(recorder, syncs_the_file_at_its_beginning_and_at_its_end) {
  const TemporaryDirectory directory;
  const FaultyDisk disk;
  Recorder recorder(directory.file("run.fsr"), {});
  const int begun = FaultyDisk::syncs;
  EXPECT_GT(begun, 0);
  for (std::uint64_t tick = 0; tick < 10; ++tick) recorder.push(sample(tick));
  recorder.close("time up");
  EXPECT_GT(FaultyDisk::syncs, begun);
}

TEST(recorder, says_that_the_recording_was_deleted) {
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

TEST(recorder, never_overwrites_and_leaves_no_file_that_it_cannot_begin) {
  const TemporaryDirectory directory;
  const std::string old = directory.write("old.fsr", "precious");
  EXPECT_THROW(Recorder(old, {}), RecordingError);
  EXPECT_EQ(directory.read("old.fsr"), "precious");
  EXPECT_THROW(Recorder(directory.file("absent/run.fsr"), {}), RecordingError);
  const FaultyDisk disk;
  FaultyDisk::full = true;
  EXPECT_THROW(Recorder(directory.file("run.fsr"), {}), RecordingError);
  EXPECT_EQ(directory.entries(), 1);
}

TEST(recorder, without_a_close_is_marked_as_cut_off) {
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

// How many ms of samples, before it was killed, are not in the file of a process that recorded at 1 kHz for this long, on a
// disk that takes half a second to sync.
double ms_lost_when_killed_after(std::chrono::milliseconds time, const std::string& path) {
  struct Shared {
    std::atomic<std::uint64_t> pushed;
    std::int64_t pushed_at[20'000];  // ns
  };
  const auto now = [] { return Clock::now().time_since_epoch().count(); };
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto& shared = *new (memory) Shared;
  const pid_t child = fork();
  if (child == 0) {
    const FaultyDisk disk;
    Recorder recorder(path, {{"law", "wall"}});
    FaultyDisk::sync_ms = 500;
    for (std::uint64_t tick = 0; tick < 20'000; ++tick) {
      shared.pushed_at[tick] = now();
      recorder.push(sample(tick));
      shared.pushed = tick + 1;
      std::this_thread::sleep_for(1ms);
    }
    _exit(0);
  }
  EXPECT_TRUE(comes_true([&] { return shared.pushed > 0; }));
  std::this_thread::sleep_for(time);
  kill(child, SIGKILL);
  const std::int64_t killed_at = now();
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));

  const auto samples = samples_of(path);
  expect_ticks(samples);
  EXPECT_LE(samples.size(), shared.pushed);
  const double lost =
      samples.size() >= shared.pushed ? 0 : static_cast<double>(killed_at - shared.pushed_at[samples.size()]) / 1e6;
  Recording recording(path);
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{path + ": no end: cut off, or still being made, after " +
                                                             std::to_string(samples.size()) + " samples"});
  munmap(memory, sizeof(Shared));
  return lost;
}

// A machine whose disk or processor stood still for some time may lose more, once: a recorder that does so loses it each time.
TEST(recorder, loses_less_than_100_ms_when_killed) {
  constexpr int kTries = 20;
  const TemporaryDirectory directory;
  double longest = 0;
  int stood_still = 0;
  for (auto time = 150ms; time < 500ms; time += 31ms) {
    double lost = 100;
    for (int k = 0; k < kTries && lost >= 100; ++k) {
      lost = ms_lost_when_killed_after(time, directory.file(std::to_string(time.count()) + "-" + std::to_string(k) + ".fsr"));
      if (HasFailure()) return;
      if (lost >= 100) ++stood_still;
    }
    EXPECT_LT(lost, 100) << "in each of " << kTries << " tries, killed after " << time.count() << " ms";
    longest = std::max(longest, lost);
  }
  std::printf("killed %d times, lost at most the last %.1f ms; more, %d times\n", 12 + stood_still, longest, stood_still);
}

}  // namespace
}  // namespace forceshade::recorder
