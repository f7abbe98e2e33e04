// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/servo_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "forceshade/csv/csv.h"
#include "forceshade/csv/output_file.h"
#include "forceshade/device/null.h"
#include "forceshade/device/open_device.h"
#include "forceshade/device/phantom.h"
#include "forceshade/device/replay.h"
#include "forceshade/tests/stand_in_hd/stand_in_hd.h"
#include "forceshade/tests/temporary_directory.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace {
thread_local std::size_t allocations = 0;
}

// Never inlined: where only one of a pair is, the compiler takes new and free() for a mismatch.
#define REPLACED [[gnu::noinline]]

REPLACED void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
REPLACED void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
REPLACED void operator delete(void* memory) noexcept {
  std::free(memory);
}
REPLACED void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
REPLACED void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
REPLACED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace forceshade::device {
namespace {

using tests::TemporaryDirectory;

const std::atomic<bool> kNeverStop = false;

fast::Law law_of(LawId id, float stiffness) {
  return std::get<fast::Law>(fast::Law::build(id, {.radius = 15.24F, .width = 25.4F, .stiffness = stiffness}));
}

// Half a newton for every millimetre below z = 0: exact in binary32 on the paths below.
fast::Law wall() {
  return law_of(LawId::wall, 0.5F);
}

std::vector<Reading> path_of(const std::vector<Eigen::Vector3f>& positions) {
  std::vector<Reading> path;
  path.reserve(positions.size());
  for (const Eigen::Vector3f& position : positions) path.push_back({position, 0.5 * static_cast<double>(path.size())});
  return path;
}

ServoOptions unpaced() {
  return {.paced = false};
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

void expect_ends_at_zero_force(const ServoResult& result) {
  ASSERT_EQ(result.record.size(), result.ticks + 1);
  const Tick& end = result.record.back();
  EXPECT_EQ(end.number, result.ticks);
  EXPECT_EQ(end.status, std::nullopt);
  EXPECT_EQ(end.force, Eigen::Vector3f(0, 0, 0));
  if (result.ticks == 0) return;
  const Tick& last = result.record[result.ticks - 1];
  EXPECT_EQ(end.reading.position, last.reading.position);
  EXPECT_EQ(end.reading.time, last.reading.time);
  EXPECT_GE(end.wall_ns, last.wall_ns);
}

TEST(servo_loop, commands_the_force_of_every_recorded_position) {
  const auto law = law_of(LawId::bump_2p_shaded, 0.5F);
  std::vector<Eigen::Vector3f> positions;
  for (int i = -40; i <= 40; ++i) positions.emplace_back(0.5F * static_cast<float>(i), 1.0F, 0.1F * static_cast<float>(i % 7));
  Replay replay(path_of(positions));
  const ServoResult result = run_servo_loop(replay, law, unpaced(), kNeverStop);

  EXPECT_EQ(result.end_reason, EndReason::end_of_data);
  ASSERT_EQ(result.ticks, positions.size());
  for (std::size_t k = 0; k < result.ticks; ++k) {
    const Tick& tick = result.record[k];
    EXPECT_EQ(tick.number, k);
    EXPECT_EQ(tick.reading.position, positions[k]);
    EXPECT_EQ(tick.reading.time, 0.5 * static_cast<double>(k));
    EXPECT_EQ(tick.force, law.force(positions[k]));
    EXPECT_EQ(tick.status, law.evaluate(positions[k]).status);
    EXPECT_GE(tick.compute_ns, 0);
  }
  expect_ends_at_zero_force(result);
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(0, 0, 0));
  EXPECT_GT(result.achieved_rate_hz, 0);
  EXPECT_LE(result.compute_us.p50, result.compute_us.p99);
  EXPECT_LE(result.compute_us.p99, result.compute_us.p999);
  EXPECT_LE(result.compute_us.p999, result.compute_us.max);
}

// By hand, K = 0.5 N/mm. Forces held, in N along z: 0, 0.5, 1, 1.5, 0.5, 0. Steps along z, in mm: -2, -1, -1, +2, +3.
// Work in mJ: 0, -0.5, -1, +3, +1.5.
TEST(servo_loop, counts_the_energy_of_a_held_force) {
  Replay replay(path_of({{0, 0, 1}, {5, 0, -1}, {-3, 2, -2}, {-3, 2, -3}, {0, 0, -1}, {9, 9, 2}}));
  const ServoResult result = run_servo_loop(replay, wall(), unpaced(), kNeverStop);
  EXPECT_EQ(result.energy_given_mJ, 4.5);
  EXPECT_EQ(result.energy_taken_mJ, 1.5);
  EXPECT_EQ(result.peak_force_N, 1.5);
  EXPECT_EQ(result.invalid_positions, 0U);
}

// The step into z = NaN and the one out of it count for nothing; the one from z = -2 to z = -1 gives 1 N times 1 mm.
TEST(servo_loop, counts_invalid_positions_and_goes_on) {
  const float nan = std::nanf("");
  Replay replay(path_of({{0, 0, -2}, {0, 0, nan}, {0, 0, -2}, {0, 0, -1}, {2e4F, 0, -1}, {0, 0, -1}}));
  const ServoResult result = run_servo_loop(replay, wall(), unpaced(), kNeverStop);
  EXPECT_EQ(result.ticks, 6U);
  EXPECT_EQ(result.invalid_positions, 2U);
  EXPECT_EQ(result.record[1].force, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(result.record[4].force, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(result.energy_given_mJ, 1);
  EXPECT_EQ(result.energy_taken_mJ, 0);
}

TEST(servo_loop, ends_when_time_is_up) {
  Endless device;
  const ServoResult result = run_servo_loop(device, wall(), {.max_seconds = 0.07, .paced = false}, kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::time_up);
  EXPECT_EQ(result.ticks, 70U);
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, ends_when_stopped) {
  struct Stopping final : Still {
    ReadResult at(std::size_t reading) noexcept override {
      if (reading == 4) stop = true;
      return here();
    }
    std::atomic<bool> stop = false;
  } device;
  const ServoResult result = run_servo_loop(device, wall(), {.rate_hz = kHighestRateHz, .record_capacity = 10}, device.stop);
  EXPECT_EQ(result.end_reason, EndReason::stopped);
  EXPECT_EQ(result.ticks, 5U);
  EXPECT_EQ(device.commands.back(), Eigen::Vector3f(0, 0, 0));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, reads_nothing_when_stopped_before_it_starts) {
  Endless device;
  const std::atomic<bool> stop = true;
  const ServoResult result = run_servo_loop(device, wall(), {}, stop);
  EXPECT_EQ(result.ticks, 0U);
  EXPECT_EQ(device.commands.size(), 1U);
  EXPECT_TRUE(std::isnan(result.record.back().reading.position.z()));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, ends_at_a_device_fault_with_its_words) {
  struct Faulty final : Still {
    ReadResult at(std::size_t reading) noexcept override {
      if (reading == 3) return Fault{"the amplifier is off"};
      return here();
    }
  } device;
  const ServoResult result = run_servo_loop(device, wall(), unpaced(), kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, "the amplifier is off");
  EXPECT_EQ(result.ticks, 3U);
  EXPECT_EQ(device.commands.back(), Eigen::Vector3f(0, 0, 0));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, starts_the_device_once_with_its_rate) {
  Endless device;
  run_servo_loop(device, wall(), {.rate_hz = 2000, .paced = false, .record_capacity = 10}, kNeverStop);
  EXPECT_EQ(device.rates, std::vector<double>{2000});
}

TEST(servo_loop, reads_nothing_from_a_device_that_does_not_start) {
  struct Dead final : Still {
    std::optional<Fault> start(double) noexcept override { return Fault{"no such device"}; }
    ReadResult at(std::size_t) noexcept override { return here(); }
  } device;
  const ServoResult result = run_servo_loop(device, wall(), unpaced(), kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, "no such device");
  EXPECT_EQ(result.ticks, 0U);
  EXPECT_EQ(device.commands.size(), 1U);
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, ends_when_the_device_refuses_a_command) {
  struct Refusing final : Still {
    ReadResult at(std::size_t) noexcept override { return here(); }
    std::optional<Fault> on_command() noexcept override {
      if (commands.size() < 3) return std::nullopt;
      return Fault{commands.size() == 3 ? "the motors are too warm" : "a later fault"};
    }
  } device;
  const ServoResult result = run_servo_loop(device, wall(), unpaced(), kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, "the motors are too warm");
  EXPECT_EQ(result.ticks, 3U);
  EXPECT_EQ(device.commands.back(), Eigen::Vector3f(0, 0, 0));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, ends_when_the_record_is_full) {
  Endless device;
  const ServoResult result = run_servo_loop(device, wall(), {.paced = false, .record_capacity = 10}, kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::record_full);
  EXPECT_EQ(result.ticks, 10U);
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, bounds_a_run_that_nothing_else_bounds) {
  Null device;
  const ServoResult result = run_servo_loop(device, wall(), unpaced(), kNeverStop);
  EXPECT_EQ(result.end_reason, EndReason::record_full);
  EXPECT_EQ(result.ticks, kUnboundedTicks);
}

// Sleeping until an absolute time never ends early, so this holds on a machine under any load.
TEST(servo_loop, never_reads_before_the_tick_is_due) {
  Endless device;
  const ServoResult result = run_servo_loop(device, wall(), {.rate_hz = 2000, .max_seconds = 0.02}, kNeverStop);
  ASSERT_EQ(result.ticks, 40U);
  for (const Tick& tick : result.record) EXPECT_GE(tick.wall_ns, static_cast<std::int64_t>(tick.number) * 500'000);
  EXPECT_LE(result.achieved_rate_hz, 2000);
}

TEST(servo_loop, counts_a_deadline_missed) {
  struct Slow final : Still {
    ReadResult at(std::size_t) noexcept override { return here(); }
    std::optional<Fault> on_command() noexcept override {
      if (commands.size() == 2) std::this_thread::sleep_for(std::chrono::milliseconds(25));
      return std::nullopt;
    }
  };
  Slow paced;
  EXPECT_GE(run_servo_loop(paced, wall(), {.rate_hz = 100, .max_seconds = 0.05}, kNeverStop).missed_deadlines, 2U);
  Slow unhurried;
  EXPECT_EQ(run_servo_loop(unhurried, wall(), {.max_seconds = 0.05, .paced = false}, kNeverStop).missed_deadlines, 0U);
}

TEST(servo_loop, refuses_a_rate_or_duration_out_of_range) {
  Endless device;
  const double nan = std::nan("");
  for (const double rate : {0.0, -1000.0, 99.9, 10000.1, nan})
    EXPECT_THROW(run_servo_loop(device, wall(), {.rate_hz = rate}, kNeverStop), std::invalid_argument) << rate;
  for (const double seconds : {0.0, -1.0, nan, HUGE_VAL})
    EXPECT_THROW(run_servo_loop(device, wall(), {.max_seconds = seconds}, kNeverStop), std::invalid_argument) << seconds;
  EXPECT_TRUE(device.commands.empty());
}

TEST(servo_loop, refuses_a_rounding_mode_that_is_not_to_nearest) {
  Endless device;
  const auto law = wall();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    EXPECT_THROW(run_servo_loop(device, law, unpaced(), kNeverStop), FloatingPointModeError) << mode;
    std::fesetround(FE_TONEAREST);
  }
  EXPECT_TRUE(device.commands.empty());
}

#if defined(__SSE2__)
TEST(servo_loop, refuses_flushed_subnormals_and_a_rounding_mode_that_only_sse_has) {
  Endless device;
  const auto law = wall();
  const unsigned mode = _mm_getcsr();
  for (const unsigned bit : {0x8000U, 0x0040U, 0x2000U, 0x4000U}) {
    _mm_setcsr(mode | bit);
    EXPECT_THROW(run_servo_loop(device, law, unpaced(), kNeverStop), FloatingPointModeError) << bit;
    _mm_setcsr(mode);
  }
  EXPECT_TRUE(device.commands.empty());
}
#endif

// Notes how many allocations this thread had made at each command.
class Watching : public Still {
 public:
  std::size_t allocations_between_first_read_and_last_command() const { return at_last_command_ - at_first_read_; }

 protected:
  ReadResult at(std::size_t reading) noexcept override {
    if (reading == 0) at_first_read_ = allocations;
    if (reading == 500) return EndOfData{};
    return here();
  }
  std::optional<Fault> on_command() noexcept override {
    at_last_command_ = allocations;
    return std::nullopt;
  }

 private:
  std::size_t at_first_read_ = 0;
  std::size_t at_last_command_ = 0;
};

TEST(servo_loop, allocates_nothing_after_the_first_reading) {
  for (const LawName& name : kLaws) {
    Watching device;
    const ServoOptions options{.rate_hz = kHighestRateHz, .record_capacity = 1000};
    const ServoResult result = run_servo_loop(device, law_of(name.id, 0.5F), options, kNeverStop);
    EXPECT_EQ(result.ticks, 500U);
    EXPECT_EQ(device.allocations_between_first_read_and_last_command(), 0U) << name.name;
  }
}

TEST(servo_loop, simulated_device_allocates_nothing_once_started) {
  const auto device = open_device("simulated");
  device->start(1000);
  const std::size_t before = allocations;
  for (int tick = 0; tick < 2000; ++tick) {
    device->read();
    device->command({0, 0, 0.1F});
  }
  EXPECT_EQ(allocations, before);
}

// Neither while it runs nor when it fails.
TEST(servo_loop, phantom_allocates_nothing_once_started) {
  setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  stand_in_hd::reset();
  Phantom device("", {.patience = std::chrono::seconds(20), .start = std::chrono::seconds(20)});
  ASSERT_FALSE(device.start(1000));
  const std::size_t before = allocations;
  for (int tick = 0; tick < 2000; ++tick) {
    device.read();
    device.command({0, 0, 0.1F});
  }
  EXPECT_EQ(allocations, before);
  stand_in_hd::tell({.begin = hdapi::kCommunication});
  const std::size_t told = allocations;
  while (!std::holds_alternative<Fault>(device.read())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(allocations, told);
}

TEST(servo_loop, allocation_by_a_device_is_seen) {
  struct Allocating final : Watching {
    ReadResult at(std::size_t reading) noexcept override {
      kept.push_back(std::make_unique<int>(1));
      return Watching::at(reading);
    }
    std::vector<std::unique_ptr<int>> kept;
  } device;
  run_servo_loop(device, wall(), unpaced(), kNeverStop);
  EXPECT_GE(device.allocations_between_first_read_and_last_command(), 499U);
}

TEST(record, holds_every_number_of_every_tick) {
  const TemporaryDirectory directory;
  Replay replay(path_of({{0.1F, -0.0F, 1e-30F}, {1, 2, -0.3F}, {0, 0, std::nanf("")}}));
  const ServoResult result = run_servo_loop(replay, wall(), unpaced(), kNeverStop);
  write_record(result.record, directory.file("record.csv"));
  EXPECT_EQ(directory.entries(), 1);

  EXPECT_TRUE(
      directory.read("record.csv").starts_with("tick,t_s,device_t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status,compute_us\n0,"));
  auto file = csv::open_input(directory.file("record.csv"));
  csv::Reader rows(file, "record.csv",
                   {"tick", "t_s", "device_t_s", "x_mm", "y_mm", "z_mm", "fx_N", "fy_N", "fz_N", "status", "compute_us"});
  const std::vector<std::string> statuses = {"free", "contact", "invalid", "end"};
  std::size_t count = 0;
  for (; rows.next(); ++count) {
    const Tick& tick = result.record.at(count);
    EXPECT_EQ(rows.text(0), std::to_string(count));
    EXPECT_EQ(std::llround(rows.binary64(1) * 1e9), tick.wall_ns);
    EXPECT_EQ(rows.binary64(2), tick.reading.time);
    for (std::size_t i = 0; i < 3; ++i) {
      const float coordinate = tick.reading.position[static_cast<Eigen::Index>(i)];
      if (std::isnan(coordinate))
        EXPECT_TRUE(std::isnan(rows.binary32(3 + i)));
      else
        EXPECT_EQ(rows.binary32(3 + i), coordinate);
      EXPECT_EQ(rows.binary32(6 + i), tick.force[static_cast<Eigen::Index>(i)]);
    }
    EXPECT_EQ(rows.text(9), statuses.at(count));
    EXPECT_EQ(std::llround(rows.binary64(10) * 1e3), tick.compute_ns);
  }
  EXPECT_EQ(count, 4U);
}

TEST(record, that_cannot_be_written_says_why) {
  const TemporaryDirectory directory;
  EXPECT_THROW(write_record({}, directory.file("absent/record.csv")), csv::OutputError);
}

}  // namespace
}  // namespace forceshade::device
