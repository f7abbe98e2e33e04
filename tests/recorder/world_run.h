// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recorders in a simulated world: the thread that writes is a fiber, the disk is SQLite's own with its delays in the world's
// time. So every step at which the process can die is tried, and the files are read again as they lie there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/recording.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/recorder/numbered_samples.h"
#include "tests/support/temporary_directory.h"
#include "tests/world/searches.h"

namespace forceshade::recorder {

namespace fs = std::filesystem;
using tests::FaultyDisk;
using tests::TemporaryDirectory;
using world::Found;
using world::Ns;
using world::Outcome;
using world::Plan;
using world::World;

inline constexpr Ns kMillisecond = 1'000'000;
inline constexpr Ns kMostMissing = 100 * kMillisecond;  // docs/recording.md

// A loop that pushes ticks at 1 kHz into what writes them in files, and what of the ticks is there.
class WorldRun {
 public:
  // Writes so many files, and calls push_into() for the ticks.
  using Write = std::function<void(WorldRun&)>;
  WorldRun(int files, std::uint64_t ticks, Write write) : files_(files), ticks_(ticks), write_(std::move(write)) {}

  Outcome run(const Plan& plan, bool dies_at_each_step = false) {
    World world(plan.schedule);
    world::Arm no_arm(plan);
    world.at_step = [&](long) {
      if (plan.at_step) plan.at_step(no_arm);
      if (dies_at_each_step) die();
    };
    Outcome outcome;
    const Ns begin = world.now();
    outcome.end = world.run([&] { write_(*this); }, 60 * system::kSecond);
    if (outcome.end != World::End::over) violate(8, "it does not end");
    expect_whole();
    outcome.violations = violations_;
    outcome.decisions = world.decisions();
    outcome.steps = world.steps();
    outcome.lasted = world.now() - begin;
    outcome.digest = static_cast<std::uint64_t>(outcome.lasted) * 31 + static_cast<std::uint64_t>(outcome.steps);
    return outcome;
  }

  // The file of this number, from 1.
  std::string path(int file) const { return folder_.file(std::to_string(file) + ".fsr"); }

  void push_into(device::SampleSink& sink) {
    system::Thread loop("loop", [&] {
      const Ns begin = system::now();
      for (std::uint64_t tick = 0; tick < ticks_; ++tick) {
        system::sleep_until(begin + static_cast<Ns>(tick) * kMillisecond);
        device::Sample next = sample(tick);
        next.wall_ns = static_cast<std::int64_t>(tick);  // its number, where a part does not count it anew
        const Ns before = system::now();
        sink.push(next);
        pushed_.push_back(before);
      }
    });
    loop.join();
  }

  void violate(int rule, const std::string& words) {
    if (violations_.size() < 10) violations_.push_back({rule, words});
  }

  std::uint64_t ticks() const { return ticks_; }

  long deaths = 0, states = 0;  // steps at which it died; different files that were left
  double most_missing = 0;      // ms

 private:
  // As another process finds the files once this one is dead: none of its locks is left.
  void die() {
    if (is_looking_) return;
    is_looking_ = true;
    ++deaths;
    if (seen_ != FaultyDisk::writes) {
      seen_ = FaultyDisk::writes;
      ++states;
      read_copies();
    }
    const World& world = *world::current();
    for (std::size_t tick = 0; tick < pushed_.size(); ++tick) {
      if (tick < is_there_.size() && is_there_[tick]) continue;
      const Ns missing = world.now() - pushed_[tick];
      most_missing = std::max(most_missing, static_cast<double>(missing) * 1e-6);
      if (missing > kMostMissing && world.held_until() < pushed_[tick])
        violate(7, "tick " + std::to_string(tick) + " is missing " + std::to_string(missing) + " ns after it was pushed");
    }
    is_looking_ = false;
  }

  void read_copies() {
    is_there_.assign(ticks_, false);
    std::int64_t next = 0;
    for (int file = 1; file <= files_; ++file) {
      const std::string copy = copies_.file(std::to_string(file) + ".fsr");
      for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
        fs::remove(copy + suffix);
        if (fs::exists(path(file) + suffix)) fs::copy_file(path(file) + suffix, copy + suffix);
      }
      if (!fs::exists(copy)) continue;
      try {
        Recording recording(copy);
        read(recording, next);
      } catch (const Error& error) {
        violate(7, error.what());
      }
    }
  }

  // Every tick in order, each as it was pushed, and nothing wrong with the file but that it has no end.
  void read(Recording& recording, std::int64_t& next) {
    std::uint64_t own = 0;
    recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
      for (const device::Sample& got : chunk) {
        const auto tick = static_cast<std::uint64_t>(got.wall_ns);
        device::Sample expected = sample(tick);
        expected.wall_ns = got.wall_ns;
        expected.tick = own++;
        if (got.wall_ns < next || tick >= ticks_ || std::memcmp(&got, &expected, sizeof got) != 0)
          return violate(7, recording.path() + " has a wrong tick " + std::to_string(own - 1));
        if (own > 1 && got.wall_ns != next) violate(7, recording.path() + " lacks tick " + std::to_string(next));
        next = got.wall_ns + 1;
        is_there_[tick] = true;
      }
    });
    for (const std::string& problem : problems_of(recording))
      if (recording.ended() || !problem.starts_with(recording.path() + ": no end: ")) violate(7, problem);
  }

  void expect_whole() {
    is_there_.assign(ticks_, false);
    std::int64_t next = 0;
    for (int file = 1; file <= files_; ++file) {
      Recording recording(path(file));
      if (!recording.ended()) violate(7, "no end");
      read(recording, next);
    }
    if (std::ranges::count(is_there_, true) != static_cast<long>(ticks_)) violate(7, "not every tick is there");
  }

  const int files_;
  const std::uint64_t ticks_;
  const Write write_;
  const TemporaryDirectory folder_, copies_;
  const FaultyDisk disk_;
  std::vector<Ns> pushed_;  // when, of each tick
  std::vector<bool> is_there_;
  std::vector<world::Violation> violations_;
  int seen_ = -1;
  bool is_looking_ = false;
};

inline void expect_kept(const char* what, const Found& found) {
  std::printf("%s: %ld sessions, %ld broke a rule, digest %016lx\n", what, found.tried, found.broken, found.digest);
  EXPECT_GT(found.tried, 0);
  EXPECT_EQ(found.broken, 0) << found.first;
}

inline void expect_kept_at_each_death(WorldRun& run) {
  const Outcome outcome = run.run({}, true);
  std::printf("%ld deaths left %ld different states of the files; the oldest tick that was missing was of %.3f ms before\n",
              run.deaths, run.states, run.most_missing);
  EXPECT_GT(run.states, 50);
  for (const world::Violation& violation : outcome.violations) ADD_FAILURE() << violation.words;
}

}  // namespace forceshade::recorder
