// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/servo_loop.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "forceshade/device/null.h"
#include "forceshade/device/open_device.h"
#include "forceshade/device/phantom.h"
#include "forceshade/device/replay.h"
#include "forceshade/device/simulated.h"
#include "forceshade/tests/kept_samples.h"
#include "forceshade/tests/stand_in_hd/stand_in_hd.h"

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

using tests::vector;

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

// A run with all of its samples.
struct Kept : ServoResult {
  Kept(Device& device, const fast::Law& law, ServoOptions options, const std::atomic<bool>& stop = kNeverStop) {
    tests::KeptSamples kept;
    options.sinks.push_back(&kept);
    static_cast<ServoResult&>(*this) = run_servo_loop(device, law, options, stop);
    samples = std::move(kept.samples);
  }
  std::vector<Sample> samples;
};

void expect_ends_at_zero_force(const Kept& run) {
  ASSERT_EQ(run.samples.size(), run.ticks + 1);
  const Sample& end = run.samples.back();
  EXPECT_EQ(end.tick, run.ticks);
  EXPECT_EQ(end.status, Sample::kEnd);
  EXPECT_EQ(vector(end.force), Eigen::Vector3f(0, 0, 0));
  if (run.ticks == 0) return;
  const Sample& last = run.samples[run.ticks - 1];
  EXPECT_EQ(end.position, last.position);
  EXPECT_EQ(end.device_time, last.device_time);
  EXPECT_GE(end.wall_ns, last.wall_ns);
}

TEST(servo_loop, commands_the_force_of_every_recorded_position) {
  const auto law = law_of(LawId::bump_2p_shaded, 0.5F);
  std::vector<Eigen::Vector3f> positions;
  for (int i = -40; i <= 40; ++i) positions.emplace_back(0.5F * static_cast<float>(i), 1.0F, 0.1F * static_cast<float>(i % 7));
  Replay replay(path_of(positions));
  const Kept result(replay, law, unpaced());

  EXPECT_EQ(result.end_reason, EndReason::end_of_data);
  EXPECT_FALSE(result.supervised);
  ASSERT_EQ(result.ticks, positions.size());
  for (std::size_t k = 0; k < result.ticks; ++k) {
    const Sample& sample = result.samples[k];
    EXPECT_EQ(sample.tick, k);
    EXPECT_EQ(vector(sample.position), positions[k]);
    EXPECT_EQ(sample.device_time, 0.5 * static_cast<double>(k));
    EXPECT_EQ(vector(sample.force), law.force(positions[k]));
    EXPECT_EQ(sample.law_force, sample.force);
    EXPECT_EQ(sample.status, static_cast<int>(law.evaluate(positions[k]).status));
    EXPECT_GE(sample.compute_ns, 0);
  }
  expect_ends_at_zero_force(result);
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(0, 0, 0));
  EXPECT_GT(result.achieved_rate_hz, 0);
  EXPECT_LE(result.compute_us.p50, result.compute_us.p99);
  EXPECT_LE(result.compute_us.p99, result.compute_us.p999);
  EXPECT_LE(result.compute_us.p999, result.compute_us.p9999);
  EXPECT_LE(result.compute_us.p9999, result.compute_us.max);
  EXPECT_LE(result.compute_us.max, result.tick_us.max);
  EXPECT_TRUE(result.wakeup_us.histogram.empty());
}

// By hand, K = 0.5 N/mm. Forces held, in N along z: 0, 0.5, 1, 1.5, 0.5, 0. Steps along z, in mm: -2, -1, -1, +2, +3.
// Work in mJ: 0, -0.5, -1, +3, +1.5.
TEST(servo_loop, counts_the_energy_of_a_held_force) {
  Replay replay(path_of({{0, 0, 1}, {5, 0, -1}, {-3, 2, -2}, {-3, 2, -3}, {0, 0, -1}, {9, 9, 2}}));
  const Kept result(replay, wall(), unpaced());
  EXPECT_EQ(result.energy_given_mJ(), 4.5);
  EXPECT_EQ(result.energy_taken_mJ(), 1.5);
  EXPECT_EQ(result.peak_force_N, 1.5);
  EXPECT_EQ(result.invalid_positions, 0U);
}

// The step into z = NaN is counted as the longest there is, 1 mm at 1 kHz, straight along 1 N, and so is the one out of z = -1
// into 2e4, which no law answers, with 0.5 N. The one from z = -2 to z = -1 gives 1 N times 1 mm.
TEST(servo_loop, counts_invalid_positions_and_goes_on) {
  const float nan = std::nanf("");
  Replay replay(path_of({{0, 0, -2}, {0, 0, nan}, {0, 0, -2}, {0, 0, -1}, {2e4F, 0, -1}, {0, 0, -1}}));
  const Kept result(replay, wall(), unpaced());
  EXPECT_EQ(result.ticks, 6U);
  EXPECT_EQ(result.invalid_positions, 2U);
  EXPECT_EQ(vector(result.samples[1].force), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(vector(result.samples[4].force), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(result.energy_given_mJ(), 2);
  EXPECT_EQ(result.energy_taken_mJ(), 0);
}

TEST(servo_loop, ends_when_time_is_up) {
  Endless device;
  const Kept result(device, wall(), {.max_seconds = 0.07, .paced = false});
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
  const Kept result(device, wall(), {.rate_hz = kHighestRateHz}, device.stop);
  EXPECT_EQ(result.end_reason, EndReason::stopped);
  EXPECT_EQ(result.ticks, 5U);
  EXPECT_EQ(device.commands.back(), Eigen::Vector3f(0, 0, 0));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, reads_nothing_when_stopped_before_it_starts) {
  Endless device;
  const std::atomic<bool> stop = true;
  const Kept result(device, wall(), {}, stop);
  EXPECT_EQ(result.ticks, 0U);
  EXPECT_EQ(device.commands.size(), 1U);
  EXPECT_TRUE(std::isnan(result.samples.back().position[2]));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, ends_at_a_device_fault_with_its_words) {
  struct Faulty final : Still {
    ReadResult at(std::size_t reading) noexcept override {
      if (reading == 3) return Fault{"the amplifier is off"};
      return here();
    }
  } device;
  const Kept result(device, wall(), unpaced());
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, "the amplifier is off");
  EXPECT_EQ(result.ticks, 3U);
  EXPECT_EQ(device.commands.back(), Eigen::Vector3f(0, 0, 0));
  expect_ends_at_zero_force(result);
}

TEST(servo_loop, starts_the_device_once_with_its_rate) {
  Endless device;
  run_servo_loop(device, wall(), {.rate_hz = 2000, .max_seconds = 0.01, .paced = false}, kNeverStop);
  EXPECT_EQ(device.rates, std::vector<double>{2000});
}

TEST(servo_loop, reads_nothing_from_a_device_that_does_not_start) {
  struct Dead final : Still {
    std::optional<Fault> start(double) noexcept override { return Fault{"no such device"}; }
    ReadResult at(std::size_t) noexcept override { return here(); }
  } device;
  const Kept result(device, wall(), unpaced());
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
  const Kept result(device, wall(), unpaced());
  EXPECT_EQ(result.end_reason, EndReason::device_fault);
  EXPECT_STREQ(result.fault, "the motors are too warm");
  EXPECT_EQ(result.ticks, 3U);
  EXPECT_EQ(device.commands.back(), Eigen::Vector3f(0, 0, 0));
  expect_ends_at_zero_force(result);
}

// A device that can push: in free space for its first `free_readings`, then 1 mm inside the wall and trembling by a count.
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

TEST(servo_loop, supervises_a_device_that_can_push) {
  Pushing device;
  const Kept run(device, wall(), {.max_seconds = 0.8, .paced = false});
  EXPECT_EQ(run.end_reason, EndReason::time_up);
  EXPECT_TRUE(run.supervised);
  EXPECT_EQ(run.passivity, PassivityController::Kind::damping);
  // The gentle start: 50 free ticks, then half a second in which the force grows to the law's.
  const auto limited = [&](const Sample& sample) { return (sample.limited >> static_cast<int>(Rule::gentle_start) & 1) != 0; };
  EXPECT_FALSE(limited(run.samples[99]));
  EXPECT_TRUE(limited(run.samples[100]));
  EXPECT_LT(run.samples[100].force[2], run.samples[100].law_force[2]);
  EXPECT_TRUE(limited(run.samples[548]));
  EXPECT_FALSE(limited(run.samples[549]));
  EXPECT_EQ(run.samples[549].force, run.samples[549].law_force);
  EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::gentle_start)], 449U);
  EXPECT_EQ(device.commands[100], vector(run.samples[100].force));
  EXPECT_FALSE(run.trip);
}

// Thrown half a metre a tick at tick 300, under force.
TEST(servo_loop, trip_means_zero_in_the_same_tick_and_the_end) {
  struct Thrown final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      if (reading >= 300) there.position.x() += 500;
      return there;
    }
  } device;
  const Kept run(device, wall(), unpaced());
  EXPECT_EQ(run.end_reason, EndReason::tripped);
  ASSERT_TRUE(run.trip);
  EXPECT_EQ(name_of(run.trip->rule), "jump");
  EXPECT_EQ(run.trip->tick, 300U);
  EXPECT_EQ(run.ticks, 301U);
  EXPECT_GT(device.commands[299].z(), 0);
  EXPECT_EQ(device.commands[300], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(device.commands[301], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(device.commands.size(), 302U);
  EXPECT_EQ(run.samples[300].tripped, 1 + static_cast<int>(Rule::jump));
  EXPECT_EQ(run.samples[299].tripped, 0);
  EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::jump)], 0U);
  expect_ends_at_zero_force(run);
}

// A hand that comes down fast and presses far is given less force than the supervisor would allow, for want of energy; the arm
// stands still under it, and nothing is wrong with its encoders.
TEST(servo_loop, does_not_take_a_force_that_is_withheld_for_one_that_moves_nothing) {
  const Operator hand{Grip{},
                      Intention({{0.1, {-30, 0, 5}}, {0.3, {-30, 0, -20}}, {1, {-30, 0, -20}}}, Intention::Between::straight),
                      Tremor(1, 0.03), true};
  Simulated device(premium_1_5(), hand);
  const Kept run(device, wall(), unpaced());
  EXPECT_EQ(run.end_reason, EndReason::end_of_data) << (run.trip ? name_of(run.trip->rule) : run.fault);
  EXPECT_GT(run.account.largest_change, 0.5);
}

TEST(servo_loop, trip_by_lateness_only_when_there_are_deadlines) {
  struct Slow final : Pushing {
    std::optional<Fault> on_command() noexcept override {
      if (commands.size() == 2) std::this_thread::sleep_for(std::chrono::milliseconds(60));
      return std::nullopt;
    }
  };
  Slow paced;
  const Kept late(paced, wall(), {.max_seconds = 0.2});
  ASSERT_TRUE(late.trip);
  EXPECT_EQ(late.trip->rule, Rule::watchdog);
  EXPECT_LE(late.ticks, 3U);
  Slow unhurried;
  EXPECT_EQ(Kept(unhurried, wall(), {.max_seconds = 0.2, .paced = false}).end_reason, EndReason::time_up);
}

TEST(servo_loop, gives_no_force_without_the_dead_man_button) {
  struct Held final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      there.buttons = reading < 700 ? 2 : 1;
      return there;
    }
  } device;
  const Kept run(device, wall(), {.max_seconds = 0.8, .paced = false, .dead_man_button = 1});
  EXPECT_GT(device.commands[699].z(), 0);
  EXPECT_EQ(device.commands[700], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(run.samples[700].limited, 1 << static_cast<int>(Rule::dead_man));
  Pushing same;
  for (const int button : {-1, 2})
    EXPECT_THROW(run_servo_loop(same, wall(), {.dead_man_button = button}, kNeverStop), std::invalid_argument) << button;
}

// Pressed in and let out a little higher, in turns, against a wall that the loop's hold makes active: what is asked for is
// what is done.
TEST(servo_loop, keeps_a_device_passive_as_told) {
  struct Harvester final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      if (reading > 700) there.position.z() = reading % 2 == 0 ? -1.2F : -0.3F;
      return there;
    }
  };
  const auto lowest = [](PassivityController::Kind kind) {
    Harvester device;
    const Kept run(device, wall(), {.max_seconds = 1, .paced = false, .passivity = kind});
    EXPECT_EQ(run.passivity, kind);
    EXPECT_FALSE(run.trip) << name_of(run.trip->rule);
    std::size_t altered = 0;
    for (const Sample& sample : run.samples) altered += sample.altered;
    EXPECT_EQ(altered, run.account.altered);
    return run.account.lowest_balance / run.passivity_settings.epsilon;
  };
  EXPECT_LT(lowest(PassivityController::Kind::observer), -20);
  EXPECT_GE(lowest(PassivityController::Kind::damping), -1);
  EXPECT_GE(lowest(PassivityController::Kind::tank), -1);
}

TEST(servo_loop, runs_on_the_processor_it_is_told) {
  struct Where final : Still {
    ReadResult at(std::size_t) noexcept override {
      cpu = sched_getcpu();
      return here();
    }
    int cpu = -1;
  } device;
  cpu_set_t before, after;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &before)) continue;
    const Kept run(device, wall(), {.max_seconds = 0.005, .cpu = cpu});
    EXPECT_EQ(run.privileges.cpu, cpu);
    EXPECT_EQ(device.cpu, cpu);
  }
  EXPECT_EQ(Kept(device, wall(), {.max_seconds = 0.005, .cpu = CPU_SETSIZE}).privileges.cpu, std::nullopt);
  ASSERT_EQ(sched_getaffinity(0, sizeof after, &after), 0);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

// Sleeping until an absolute time never ends early, so this holds on a machine under any load.
TEST(servo_loop, never_reads_before_the_tick_is_due) {
  Endless device;
  const Kept result(device, wall(), {.rate_hz = 2000, .max_seconds = 0.02});
  ASSERT_EQ(result.ticks, 40U);
  for (const Sample& sample : result.samples) EXPECT_GE(sample.wall_ns, static_cast<std::int64_t>(sample.tick) * 500'000);
  EXPECT_LE(result.achieved_rate_hz, 2000);
}

TEST(servo_loop, counts_a_deadline_missed_and_whose_fault_it_was) {
  struct Slow final : Still {
    ReadResult at(std::size_t) noexcept override { return here(); }
    std::optional<Fault> on_command() noexcept override {
      if (commands.size() == 2) std::this_thread::sleep_for(std::chrono::milliseconds(25));
      return std::nullopt;
    }
  };
  Slow paced;
  const Kept late(paced, wall(), {.rate_hz = 100, .max_seconds = 0.05});
  EXPECT_GE(late.missed_deadlines, 2U);
  EXPECT_EQ(late.overruns, 0U);
  EXPECT_GE(late.wakeup_us.max, 5000);
  struct Busy final : Still {
    ReadResult at(std::size_t) noexcept override { return here(); }
    std::optional<Fault> on_command() noexcept override {
      const std::clock_t begin = std::clock();
      while (commands.size() == 2 && std::clock() - begin < 25 * CLOCKS_PER_SEC / 1000) {
      }
      return std::nullopt;
    }
  } busy;
  EXPECT_EQ(Kept(busy, wall(), {.rate_hz = 100, .max_seconds = 0.05}).overruns, 1U);
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

TEST(servo_loop, refuses_a_device_that_does_not_know_its_limits) {
  struct Unknowing final : Pushing {
    Capabilities capabilities() const noexcept override { return known; }
    Capabilities known = Pushing::capabilities();
  };
  const auto refuses = [](auto change) {
    Unknowing device;
    change(device.known);
    EXPECT_THROW(run_servo_loop(device, wall(), unpaced(), kNeverStop), std::invalid_argument);
    EXPECT_TRUE(device.commands.empty());
  };
  const float nan = std::nanf("");
  refuses([=](Capabilities& c) { c.peak_force = nan; });
  refuses([=](Capabilities& c) { c.continuous_force = nan; });
  refuses([=](Capabilities& c) { c.resolution = nan; });
  refuses([=](Capabilities& c) { c.friction = nan; });
  refuses([=](Capabilities& c) { c.workspace_low.z() = nan; });
  refuses([=](Capabilities& c) { c.workspace_high.x() = nan; });
}

TEST(servo_loop, ends_when_the_rounding_mode_changes_under_it) {
  struct Careless final : Still {
    ReadResult at(std::size_t reading) noexcept override {
      if (reading == 3) std::fesetround(FE_UPWARD);
      return here();
    }
  } device;
  const auto law = wall();
  const Kept run(device, law, unpaced());
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(run.end_reason, EndReason::device_fault);
  EXPECT_STREQ(run.fault, "rounding other than to nearest");
  EXPECT_EQ(run.ticks, 3U);
  expect_ends_at_zero_force(run);
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
    const ServoOptions options{.rate_hz = kHighestRateHz};
    const Kept result(device, law_of(name.id, 0.5F), options);
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

}  // namespace
}  // namespace forceshade::device
