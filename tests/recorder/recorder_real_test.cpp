// SPDX-License-Identifier: BSD-3-Clause
// The loss of a recorder that is killed, in ms. scripts/real measures it over many runs.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <new>
#include <thread>

#include "forceshade/recording.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/recorder/numbered_samples.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/wait_until.h"

namespace forceshade::recorder {
namespace {

using namespace std::chrono_literals;
using tests::FaultyDisk;

// The ms of samples, before it was killed, that are not in the file of a process that recorded at 1 kHz for this long, on a
// disk that takes half a second to sync.
double ms_lost_when_killed_after(std::chrono::milliseconds time, const std::string& path) {
  struct Shared {
    std::atomic<std::uint64_t> pushed;
    std::int64_t pushed_at[20'000];  // ns
  };
  const auto now = [] { return std::chrono::steady_clock::now().time_since_epoch().count(); };
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
  tests::wait_until([&] { return shared.pushed > 0; });
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

TEST(recorder, loses_less_than_100_ms_when_killed) {
  const tests::TemporaryDirectory directory;
  for (auto time = 150ms; time < 500ms; time += 31ms) {
    const double lost = ms_lost_when_killed_after(time, directory.file(std::to_string(time.count()) + ".fsr"));
    std::printf("killed after %d ms, lost %.1f ms\n", static_cast<int>(time.count()), lost);
    EXPECT_LT(lost, 100);
  }
}

}  // namespace
}  // namespace forceshade::recorder
