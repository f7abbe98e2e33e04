// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs of the servo loop for tests: a wall, devices that stay where they are, a run with all of its samples.

#include <gtest/gtest.h>

#include <atomic>
#include <utility>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "tests/support/kept_samples.h"

namespace forceshade::device {

inline const std::atomic<bool> kNeverStop = false;

inline fast::Law law_of(LawId id, float stiffness) {
  return std::get<fast::Law>(fast::Law::build(id, {.radius = 15.24F, .width = 25.4F, .stiffness = stiffness}));
}

// Half a newton for every millimetre below z = 0: exact in binary32 on the paths below.
inline fast::Law wall() {
  return law_of(LawId::wall, 0.5F);
}

// One position a tick at 1 kHz.
inline std::vector<Reading> path_of(const std::vector<Eigen::Vector3f>& positions) {
  std::vector<Reading> path;
  path.reserve(positions.size());
  for (const Eigen::Vector3f& position : positions) path.push_back({position, 0.001 * static_cast<double>(path.size())});
  return path;
}

// Ends after five thousand ticks where nothing else ends it.
inline ServoOptions unpaced() {
  return {.max_seconds = 5, .paced = false};
}

// Stays at z = -1 and does what the test says at a given reading, from 0.
class Still : public Device {
 public:
  Capabilities capabilities() const noexcept override { return {}; }
  std::optional<Fault> start(double rate) noexcept override {
    rates.push_back(rate);
    return std::nullopt;
  }
  ReadResult read() noexcept override { return at(reads_++); }
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    commands.push_back(force);
    return on_command();
  }
  std::vector<double> rates;
  std::vector<Eigen::Vector3f> commands;

 protected:
  Still() { commands.reserve(1000); }
  static Reading here() { return {{3, 4, -1}, 0}; }
  virtual ReadResult at(std::size_t reading) noexcept = 0;
  virtual std::optional<Fault> on_command() noexcept { return std::nullopt; }

 private:
  std::size_t reads_ = 0;
};

class Endless final : public Still {
  ReadResult at(std::size_t) noexcept override { return here(); }
};

// A device that can push: in free space for its first `kFree` readings, then 0.3 mm inside the wall and trembling by a count.
class Pushing : public Still {
 public:
  Capabilities capabilities() const noexcept override {
    return {.resolution = 0.03F, .peak_force = 8.5F, .continuous_force = 1.4F, .buttons = 2};
  }

 protected:
  static constexpr std::size_t kFree = 100;
  ReadResult at(std::size_t reading) noexcept override { return place(reading); }
  static Reading place(std::size_t reading) {
    const float z = reading < kFree ? 0.4F : -0.3F;
    return {{3, 0.03F * static_cast<float>(reading % 2), z}, 1e-3 * static_cast<double>(reading)};
  }
};

// A run with all of its samples.
struct Kept : ServoResult {
  template <class Field>
  Kept(Device& device, Field&& field, ServoOptions options, const std::atomic<bool>& stop = kNeverStop) {
    tests::KeptSamples kept;
    options.sinks.push_back(&kept);
    static_cast<ServoResult&>(*this) = run_servo_loop(device, field, options, stop);
    samples = std::move(kept.samples);
  }
  std::vector<Sample> samples;
};

inline void expect_ends_at_zero_force(const Kept& run) {
  ASSERT_EQ(run.samples.size(), run.ticks + 1);
  const Sample& end = run.samples.back();
  EXPECT_EQ(end.tick, run.ticks);
  EXPECT_EQ(end.status, Sample::kEnd);
  EXPECT_EQ(tests::vector(end.force), Eigen::Vector3f(0, 0, 0));
  if (run.ticks == 0) return;
  const Sample& last = run.samples[run.ticks - 1];
  EXPECT_EQ(end.position, last.position);
  EXPECT_EQ(end.device_time, last.device_time);
  EXPECT_GE(end.wall_ns, last.wall_ns);
}

}  // namespace forceshade::device
