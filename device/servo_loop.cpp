// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/servo_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "device/damped_work.h"
#include "device/passivity_controller.h"
#include "device/supervisor.h"
#include "device/timing.h"
#include "files/csv.h"
#include "forceshade/fast.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

static_assert(std::atomic<bool>::is_always_lock_free, "the stop flag is set from signal handlers");

double milliseconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) / 1e6;
}

std::size_t ticks_in(std::optional<double> seconds, double rate_hz) {
  constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
  if (!seconds) return kUnlimited;
  const double ticks = std::max(1.0, std::round(*seconds * rate_hz));
  return ticks < 0x1p53 ? static_cast<std::size_t>(ticks) : kUnlimited;
}

void check(const ServoOptions& options, const Capabilities& capabilities) {
  const auto refuse = [](const std::string& what, double got) { throw std::invalid_argument(what + ", got " + shortest(got)); };
  if (!(options.rate_hz >= kLowestRateHz && options.rate_hz <= kHighestRateHz))
    refuse("rate: expected " + shortest(kLowestRateHz) + " to " + shortest(kHighestRateHz) + " Hz", options.rate_hz);
  if (options.max_seconds && !(*options.max_seconds > 0 && std::isfinite(*options.max_seconds)))
    refuse("seconds: expected a positive number", *options.max_seconds);
  if (options.watchdog_timeout && !(*options.watchdog_timeout > 0 && *options.watchdog_timeout <= kLongestWatchdogTimeout))
    refuse("watchdog timeout: expected at most " + shortest(kLongestWatchdogTimeout) + " s", *options.watchdog_timeout);
  if (const auto damping = fast::Damping::build(options.damping_at_rate()); std::holds_alternative<ParameterError>(damping))
    throw std::invalid_argument("damping at this rate: " + std::get<ParameterError>(damping).message());
  // A limit that is not a number would limit nothing.
  const auto expect_number = [](const char* what, bool number) {
    if (!number) throw std::invalid_argument(std::string("the device's ") + what + " is not a number");
  };
  expect_number("peak force", !std::isnan(capabilities.peak_force));
  expect_number("continuous force", !std::isnan(capabilities.continuous_force));
  expect_number("resolution", !std::isnan(capabilities.resolution));
  expect_number("friction", !std::isnan(capabilities.friction));
  expect_number("workspace", !capabilities.workspace_low.hasNaN() && !capabilities.workspace_high.hasNaN());
  if (const auto button = options.dead_man_button; button && !(*button >= 0 && *button < capabilities.buttons))
    refuse(capabilities.buttons == 0
               ? "dead-man button: expected none, because the device has no buttons"
               : "dead-man button: expected 0 to " + std::to_string(capabilities.buttons - 1) + ", a button of the device",
           *button);
}

std::array<float, 3> array(const Eigen::Vector3f& v) noexcept {
  return {v.x(), v.y(), v.z()};
}

Sample sample_of(const Reading& reading, const Placement& placement) noexcept {
  Sample sample{.device_time = reading.time};
  sample.position = array(placement.to_subject(reading.position));
  if (reading.encoder) sample.encoder = *reading.encoder;
  if (reading.gimbal) sample.gimbal = array(*reading.gimbal);
  sample.buttons = reading.buttons;
  return sample;
}

// Everything that a run needs, made before its first tick.
class Run {
 public:
  Run(Device& device, fast::Session& session, const ServoOptions& options, const std::atomic<bool>& stop)
      : device_(device),
        session_(session),
        options_(options),
        stop_(stop),
        period_(std::llround(1e9 / options.rate_hz)),
        ticks_(ticks_in(options.max_seconds, options.rate_hz)) {
    const Capabilities capabilities = device.capabilities();
    const SafetySettings settings = safety_settings(capabilities, options);
    // Longer than the device itself waits for its frames, so that it is the one to say what happened.
    longest_wait_ = std::llround(2e9 * settings.limits.watchdog_timeout);
    result.followed_device = options.paced && options.follows_device && capabilities.paces;
    result.supervised = settings.supervised;
    result.acts_on_lateness = settings.limits.acts_on_lateness;
    result.watchdog_timeout = settings.limits.watchdog_timeout;
    if (result.supervised) supervisor_.emplace(settings.limits, options.rate_hz);
    result.passivity = settings.passivity;
    result.passivity_settings = settings.passivity_settings;
    controller_.emplace(result.passivity_settings, result.passivity);
    result.damping = options.damping_at_rate();
    if (!result.damping.is_off()) damping_ = std::get<fast::Damping>(fast::Damping::build(result.damping));
  }

  // Start, ticks, and the zero force that ends them.
  void run() noexcept;

  // Once it is over.
  void summarise() {
    result.wakeup_us = wakeup_.durations();
    result.compute_us = compute_.durations();
    result.tick_us = tick_.durations();
    result.account = controller_->account();
    for (std::size_t rule = 0; supervisor_ && rule < kRules; ++rule)
      result.limited_ticks[rule] = supervisor_->count(static_cast<Rule>(rule));
    if (supervisor_) result.trip = supervisor_->tripped();
    result.damped_energy = {work_.spring, work_.damper, work_.sampling, damping_ ? work_.most(result.damping) : 0};
    if (result.trip) --result.limited_ticks[static_cast<std::size_t>(result.trip->rule)];
  }

  ServoResult result;

 private:
  std::int64_t due(std::size_t tick) const noexcept { return start_ + static_cast<std::int64_t>(tick) * period_; }
  // Waits until a tick is due. When that was, in ns.
  std::int64_t wait() noexcept;
  void end_with(EndReason reason) noexcept { end_ = reason; }
  void end_with(const std::optional<Fault>& fault) noexcept {
    if (!fault || end_ == EndReason::device_fault) return;
    end_ = EndReason::device_fault;
    result.fault = fault->words;
  }
  void tick() noexcept;
  std::uint32_t periods(std::int64_t woken_at) noexcept;
  fast::Evaluation rendered(const Eigen::Vector3f& position, std::uint32_t periods) noexcept;
  void render(const Reading& reading, std::int64_t woken_at, std::int64_t read_at) noexcept;
  void finish() noexcept;

  void push(Sample sample) noexcept {
    sample.tick = result.ticks;
    sample.energy = controller_->account().net();
    for (SampleSink* sink : options_.sinks) sink->push(sample);
  }

  Device& device_;
  fast::Session& session_;
  const ServoOptions& options_;
  const std::atomic<bool>& stop_;
  std::int64_t period_, start_ = 0, due_ = 0, computed_ = 0;  // ns; the last: processor time when the tick began
  std::int64_t longest_wait_ = 0;                             // ns, for a frame of the device's
  std::size_t ticks_;
  std::optional<Supervisor> supervisor_;
  std::optional<PassivityController> controller_;
  std::optional<fast::Damping> damping_;  // none where it is off
  DampedWork<double> work_;
  std::int64_t slot_ = -1,
               frame_ = 0;  // of the tick before: the last whole period since the start; the beginning of its frame, ns
  struct {
    double took_ms = 0, computed_ms = 0;
  } before_;  // of the tick before, as Delay has it
  Reading last_{.position = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN())};
  std::optional<EndReason> end_;
  Histogram wakeup_, compute_, tick_;
};

void Run::run() noexcept {
  end_with(device_.start(options_.rate_hz));
  start_ = system::now();
  while (!end_) tick();
  finish();
}

std::int64_t Run::wait() noexcept {
  if (!options_.paced) return system::now();
  if (!result.followed_device) {
    const std::int64_t next = due(result.ticks);
    while (!system::sleep_until(next) && !stop_) continue;
    return next;
  }
  const std::int64_t deadline = system::now() + longest_wait_;
  std::int64_t frame = due_;
  while (frame == due_ && !stop_ && system::now() < deadline) frame = device_.wait_for_frame(deadline);
  return frame;
}

void Run::tick() noexcept {
  // A frame's position is as old as the frame, so nothing is done between them. By the loop's own clock the position is read
  // last, when whatever used the caches during the wait is through.
  const bool has_frames = result.followed_device;
  if (options_.paced && has_frames) session_.look_ahead();
  due_ = wait();
  const std::int64_t woken_at = system::now();
  if (options_.paced) computed_ = system::processor_time();
  if (stop_) return end_with(EndReason::stopped);
  if (result.ticks == ticks_) return end_with(EndReason::time_up);
  if (options_.paced && !has_frames) session_.look_ahead();
  const ReadResult read = device_.read();
  const std::int64_t read_at = system::now();
  if (const Fault* fault = std::get_if<Fault>(&read)) return end_with(*fault);
  if (std::holds_alternative<EndOfData>(read)) return end_with(EndReason::end_of_data);
  // The device's own code, or its driver's, may have changed it in this thread.
  if (const char* fault = fast::arithmetic_fault()) return end_with(Fault{fault});
  last_ = *std::get_if<Reading>(&read);
  render(last_, woken_at, read_at);
  ++result.ticks;
}

// The periods since the tick before, at most 17, which stands for all above. A late tick, after which others follow at once,
// has those that passed, and they have none.
std::uint32_t Run::periods(std::int64_t woken_at) noexcept {
  std::int64_t passed = 1;
  if (result.followed_device) {
    const std::int64_t since = due_ - std::exchange(frame_, due_);
    passed = since == 0 ? 0 : std::max<std::int64_t>((since + period_ / 2) / period_, 1);
  } else if (options_.paced) {
    const std::int64_t slot = std::max<std::int64_t>(slot_, (woken_at - start_) / period_);
    passed = slot - std::exchange(slot_, slot);
  }
  return static_cast<std::uint32_t>(std::min<std::int64_t>(passed, 17));
}

fast::Evaluation Run::rendered(const Eigen::Vector3f& position, std::uint32_t periods) noexcept {
  const fast::Evaluation spring = session_.step(position);
  if (!damping_) return spring;
  const fast::Evaluation damped = damping_->tick(position, periods, spring);
  std::optional<DampedTick> tick;
  if (damped.status != Status::invalid) tick = {position, spring.force, damped.force, damping_->state().velocity};
  work_.add(tick, periods, result.damping.rate);
  return damped;
}

void Run::render(const Reading& reading, std::int64_t woken_at, std::int64_t read_at) noexcept {
  const std::int64_t latency = options_.paced ? woken_at - due_ : 0;
  const Placement& placement = options_.placement;
  const std::uint32_t passed = damping_ ? periods(woken_at) : 0;
  const fast::Evaluation evaluation = rendered(placement.to_subject(reading.position), passed);
  const Eigen::Vector3f desired = placement.turned_to_device(evaluation.force);
  const State state = device_.state();
  Verdict verdict{.force = desired};
  if (supervisor_)
    verdict = supervisor_->supervise(reading, state, desired, evaluation.status, static_cast<double>(latency) / 1e9);
  const Eigen::Vector3f force = controller_->limited(reading, verdict.force);
  if (supervisor_) supervisor_->commanded(force, controller_->account().owed());
  device_.allow(controller_->allowance());
  const std::optional<Fault> refused = device_.command(force);
  const std::int64_t commanded_at = system::now();

  const bool late = options_.paced && commanded_at > due_ + period_;
  const double late_ms = milliseconds(latency);
  if (late_ms > result.worst_delay.late_ms)
    result.worst_delay = {
        .tick = result.ticks, .late_ms = late_ms, .before_ms = before_.took_ms, .computed_ms = before_.computed_ms};
  // A tick that was in time cannot delay the next one, whatever it computed.
  const std::int64_t computed = late ? system::processor_time() - computed_ : 0;
  before_ = {.took_ms = milliseconds(commanded_at - woken_at), .computed_ms = milliseconds(computed)};
  if (late) ++result.missed_deadlines;
  if (computed > period_) ++result.overruns;
  if (evaluation.status == Status::invalid) ++result.invalid_positions;
  if (evaluation.status == Status::unfinished) ++result.unfinished_ticks;
  if (!state.forces_on) ++result.forces_off_ticks;
  result.forces_off = state.forces_on ? nullptr : state.forces_off;
  result.peak_force_N = std::max(result.peak_force_N, force.cast<double>().norm());
  if (options_.paced) wakeup_.add(latency);
  compute_.add(commanded_at - read_at);
  tick_.add(commanded_at - woken_at);
  Sample sample = sample_of(reading, placement);
  sample.wall_ns = read_at - start_;
  sample.compute_ns = commanded_at - read_at;
  sample.wakeup_ns = latency;
  sample.law_force = array(evaluation.force);
  sample.force = array(placement.turned_to_subject(force));
  sample.status = static_cast<std::uint8_t>(finished(evaluation.status));
  sample.late = late;
  sample.limited = verdict.limited.bits();
  sample.altered = force != verdict.force;
  sample.tripped = verdict.trip ? static_cast<std::uint8_t>(1 + static_cast<int>(*verdict.trip)) : 0;
  sample.shown = session_.shown();
  sample.temperature = state.temperature;
  sample.device_state = (state.calibrated ? Sample::kCalibrated : 0) | (state.forces_on ? Sample::kForcesOn : 0) |
                        (evaluation.status == Status::unfinished ? Sample::kUnfinished : 0) | passed << Sample::kPeriodsBit;
  if (reading.sent) {
    sample.device_state |= Sample::kReportsSent;
    sample.sent_work = reading.sent->work;
    result.fades = reading.sent->fades;
    result.faded = reading.sent->faded;
    sample.sent_acted = array(reading.sent->acted);
    sample.sent_acting = array(reading.sent->acting);
  }
  push(sample);
  if (verdict.trip) end_with(EndReason::tripped);
  end_with(refused);
}

void Run::finish() noexcept {
  end_with(device_.command(Eigen::Vector3f::Zero()));
  result.end_reason = *end_;
  const std::int64_t elapsed = std::max<std::int64_t>(system::now() - start_, 1);
  result.achieved_rate_hz = static_cast<double>(result.ticks) / (static_cast<double>(elapsed) / 1e9);
  Sample sample = sample_of(last_, options_.placement);
  sample.wall_ns = elapsed;
  sample.status = Sample::kEnd;
  push(sample);
}

}  // namespace

SafetySettings safety_settings(const Capabilities& capabilities, const ServoOptions& options) noexcept {
  SafetySettings settings{.rate_hz = options.rate_hz};
  SupervisorLimits limits = supervisor_limits(capabilities, options.rate_hz);
  limits.watchdog_timeout = options.watchdog_timeout.value_or(limits.watchdog_timeout);
  limits.acts_on_lateness = capabilities.moves_an_arm || options.watchdog_timeout;
  settings.supervised = std::isfinite(capabilities.peak_force);
  if (settings.supervised) {
    limits.dead_man_button = options.dead_man_button;
    settings.passivity = options.passivity;
  }
  settings.limits = limits;
  settings.passivity_settings = passivity_settings(capabilities, options.rate_hz);
  return settings;
}

std::string_view name_of(EndReason reason) noexcept {
  switch (reason) {
    case EndReason::end_of_data: return "end of data";
    case EndReason::time_up: return "time up";
    case EndReason::stopped: return "stopped";
    case EndReason::tripped: return "tripped";
    case EndReason::device_fault: break;
  }
  return "device fault";
}

ServoResult run_servo_loop(Device& device, fast::Session& session, const ServoOptions& options, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw Error(fault);
  check(options, device.capabilities());
  const auto run = std::make_unique<Run>(device, session, options, stop);
  {
    std::optional<system::RealTime> real_time;
    if (options.paced) {
      const auto& [scheduling, memory_locked, cpu] = real_time.emplace(options.cpu).granted();
      run->result.privileges = {scheduling, memory_locked, cpu};
    }
    run->run();
  }
  run->summarise();
  return std::move(run->result);
}

}  // namespace forceshade::device
