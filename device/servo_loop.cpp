// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/servo_loop.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <limits>

#include "forceshade/csv/csv.h"

namespace forceshade::device {
namespace {

static_assert(std::atomic<bool>::is_always_lock_free, "the stop flag is set from signal handlers");

constexpr std::int64_t kSecond = 1'000'000'000;  // ns

std::int64_t now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

void sleep_until(std::int64_t due, const std::atomic<bool>& stop) noexcept {
  const timespec time{.tv_sec = due / kSecond, .tv_nsec = due % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR && !stop) {
  }
}

// Real-time privileges for as long as it lives, as far as the system grants them.
class RealTime {
 public:
  RealTime() noexcept {
    pthread_getschedparam(pthread_self(), &old_policy_, &old_parameters_);
    const sched_param parameters{.sched_priority = kPriority};
    scheduling = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
    memory_locked = mlockall(MCL_CURRENT) == 0;
  }
  ~RealTime() {
    if (memory_locked) munlockall();
    if (scheduling) pthread_setschedparam(pthread_self(), old_policy_, &old_parameters_);
  }
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  bool scheduling = false;
  bool memory_locked = false;

 private:
  // Above the interrupt threads of a real-time kernel (50), below its watchdogs (99).
  static constexpr int kPriority = 80;

  int old_policy_ = SCHED_OTHER;
  sched_param old_parameters_{};
};

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

std::size_t ticks_in(double seconds, double rate_hz) {
  const double ticks = std::max(1.0, std::round(seconds * rate_hz));
  return ticks < 0x1p53 ? static_cast<std::size_t>(ticks) : kUnlimited;
}

struct Limits {
  std::int64_t period_ns;
  std::size_t ticks;
  std::size_t capacity;  // of the record, in ticks
};

Limits limits_of(const ServoOptions& options, const Device& device) {
  const auto& [rate_hz, max_seconds, paced, record_capacity, sink] = options;
  if (!(rate_hz >= kLowestRateHz && rate_hz <= kHighestRateHz))
    throw std::invalid_argument("rate: expected " + csv::shortest(kLowestRateHz) + " to " + csv::shortest(kHighestRateHz) +
                                " Hz, got " + csv::shortest(rate_hz));
  if (max_seconds && !(*max_seconds > 0 && std::isfinite(*max_seconds)))
    throw std::invalid_argument("seconds: expected a positive number, got " + csv::shortest(*max_seconds));

  const std::size_t ticks = max_seconds ? ticks_in(*max_seconds, rate_hz) : kUnlimited;
  const std::size_t bound = std::min(ticks, device.readings_left().value_or(kUnlimited));
  const std::size_t capacity = bound == kUnlimited ? kUnboundedTicks : bound;
  return {std::llround(1e9 / rate_hz), ticks, record_capacity.value_or(capacity)};
}

// mJ given to the hand from one tick to the next by the force held; nothing for a step from or to a position that is not
// finite.
double work_between(const Tick& held, const Tick& next) noexcept {
  const Eigen::Vector3d step = next.reading.position.cast<double>() - held.reading.position.cast<double>();
  const double work = held.force.cast<double>().dot(step);
  return std::isfinite(work) ? work : 0;
}

Sample sample_of(const Tick& tick, const Eigen::Vector3f& law_force, double energy) noexcept {
  const auto array = [](const Eigen::Vector3f& v) { return std::array{v.x(), v.y(), v.z()}; };
  Sample sample{.tick = tick.number, .wall_ns = tick.wall_ns, .device_time = tick.reading.time};
  sample.energy = energy;
  sample.compute_ns = tick.compute_ns;
  sample.position = array(tick.reading.position);
  sample.law_force = array(law_force);
  sample.force = array(tick.force);
  if (tick.reading.gimbal) sample.gimbal = array(*tick.reading.gimbal);
  sample.buttons = tick.reading.buttons;
  sample.status = tick.status ? static_cast<std::uint8_t>(*tick.status) : Sample::kEnd;
  return sample;
}

// The loop proper. `result.record` has room for limits.capacity ticks and the row that ends the run.
void run(Device& device, const fast::Law& law, const ServoOptions& options, const Limits& limits, const std::atomic<bool>& stop,
         ServoResult& result) noexcept {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  Reading last{.position = Eigen::Vector3f::Constant(kUnknown)};
  const auto end_with = [&](const Fault& fault) {
    result.end_reason = EndReason::device_fault;
    result.fault = fault.words;
  };
  const std::optional<Fault> unstarted = device.start(options.rate_hz);
  if (unstarted) end_with(*unstarted);
  const std::int64_t start = now();
  const auto due = [&](std::size_t tick) { return start + static_cast<std::int64_t>(tick) * limits.period_ns; };

  double energy = 0;
  for (; result.end_reason != EndReason::device_fault; ++result.ticks) {
    if (options.paced) sleep_until(due(result.ticks), stop);
    const std::int64_t woken_at = now();
    if (stop) {
      result.end_reason = EndReason::stopped;
      break;
    }
    if (result.ticks == limits.ticks) {
      result.end_reason = EndReason::time_up;
      break;
    }
    const ReadResult read = device.read();
    const std::int64_t read_at = now();
    if (const Fault* fault = std::get_if<Fault>(&read)) {
      end_with(*fault);
      break;
    }
    if (std::holds_alternative<EndOfData>(read)) {
      result.end_reason = EndReason::end_of_data;
      break;
    }
    if (result.ticks == limits.capacity) {
      result.end_reason = EndReason::record_full;
      break;
    }
    last = *std::get_if<Reading>(&read);
    const fast::Evaluation evaluation = law.evaluate(last.position);
    const std::optional<Fault> refused = device.command(evaluation.force);
    const std::int64_t commanded_at = now();
    const bool late = options.paced && commanded_at > due(result.ticks + 1);
    if (late) ++result.missed_deadlines;
    result.record.push_back({result.ticks, read_at - start, last, evaluation.force, evaluation.status, commanded_at - read_at});
    const Tick& tick = result.record.back();
    if (result.ticks > 0) energy += work_between(result.record[result.ticks - 1], tick);
    if (options.sink) {
      Sample sample = sample_of(tick, evaluation.force, energy);
      sample.wakeup_ns = options.paced ? woken_at - due(result.ticks) : 0;
      sample.late = late;
      options.sink->push(sample);
    }
    if (refused) end_with(*refused);
  }

  const std::optional<Fault> unstopped = device.command(Eigen::Vector3f::Zero());
  if (unstopped && result.end_reason != EndReason::device_fault) end_with(*unstopped);
  const std::int64_t elapsed = std::max<std::int64_t>(now() - start, 1);
  result.record.push_back({result.ticks, elapsed, last, Eigen::Vector3f::Zero(), std::nullopt, 0});
  if (options.sink) options.sink->push(sample_of(result.record.back(), Eigen::Vector3f::Zero(), energy));
  result.achieved_rate_hz = static_cast<double>(result.ticks) / (static_cast<double>(elapsed) / 1e9);
}

ComputeTime compute_time_of(std::span<const Tick> ticks) {
  if (ticks.empty()) return {};
  std::vector<std::int64_t> times;
  times.reserve(ticks.size());
  for (const Tick& tick : ticks) times.push_back(tick.compute_ns);
  std::sort(times.begin(), times.end());
  const auto per_mille = [&](std::size_t share) {
    return static_cast<double>(times[(times.size() * share + 999) / 1000 - 1]) / 1e3;
  };
  return {per_mille(500), per_mille(990), per_mille(999), per_mille(1000)};
}

void summarise(ServoResult& result) {
  const std::span ticks(result.record.data(), result.ticks);
  result.compute_us = compute_time_of(ticks);
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    if (ticks[k].status == Status::invalid) ++result.invalid_positions;
    result.peak_force_N = std::max(result.peak_force_N, ticks[k].force.cast<double>().norm());
    if (k == 0) continue;
    const double work = work_between(ticks[k - 1], ticks[k]);
    (work > 0 ? result.energy_given_mJ : result.energy_taken_mJ) += std::abs(work);
  }
}

}  // namespace

std::string_view name_of(EndReason reason) noexcept {
  switch (reason) {
    case EndReason::end_of_data: return "end of data";
    case EndReason::time_up: return "time up";
    case EndReason::stopped: return "stopped";
    case EndReason::device_fault: return "device fault";
    case EndReason::record_full: break;
  }
  return "record full";
}

ServoResult run_servo_loop(Device& device, const fast::Law& law, const ServoOptions& options, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw FloatingPointModeError(fault);
  const Limits limits = limits_of(options, device);
  ServoResult result;
  // Written once before the loop, so that no page of the record is met there for the first time.
  result.record.resize(limits.capacity + 1);
  result.record.clear();
  {
    std::optional<RealTime> real_time;
    if (options.paced) real_time.emplace();
    result.realtime_scheduling = real_time && real_time->scheduling;
    result.memory_locked = real_time && real_time->memory_locked;
    run(device, law, options, limits, stop, result);
  }
  summarise(result);
  return result;
}

}  // namespace forceshade::device
