// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/faults/press.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

#include "device/simulated/simulated.h"
#include "forceshade/fast.h"
#include "forceshade/recording.h"
#include "tests/support/kept_samples.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::faults {
namespace {

using device::Fault;

device::Simulated arm_of(const Scene& scene) {
  std::vector<device::Intention::Point> points{{0, {-30, 0, 5}},
                                               {0.1, {-30, 0, 5}},
                                               {0.3, {-30, 0, -scene.depth}},
                                               {0.8, {-30, 0, -scene.depth}},
                                               {1.2, {30, 0, -scene.depth}}};
  if (scene.torn) {
    points.resize(3);
    points.push_back({*scene.torn, {-30, 0, -scene.depth}});
    points.push_back({*scene.torn + 0.01, {90, 0, -scene.depth}});
  }
  const device::Operator hand{device::Grip{}, device::Intention(std::move(points), device::Intention::Between::straight),
                              device::Tremor(1, 0.03), false};
  return {device::premium_1_5(), hand};
}

// The arm, and what is wrong with it; it keeps what it was told to do.
class WrongDevice final : public device::Device {
 public:
  WrongDevice(Device& arm, const Wrong& wrong, const Bench& bench, const Scene& scene, std::string recording)
      : arm_(arm), wrong_(wrong), bench_(bench), scene_(scene), recording_(std::move(recording)) {}

  device::Capabilities capabilities() const noexcept override {
    device::Capabilities capabilities = arm_.capabilities();
    capabilities.moves_an_arm = true;  // it stands for a real one
    if (scene_.dead_man_button) capabilities.buttons = 2;
    if (wrong_.capabilities) wrong_.capabilities(capabilities);
    // The servo loop does not supervise a device that cannot push.
    if (!bench_.supervised) capabilities.peak_force = device::Capabilities::kNone;
    return capabilities;
  }
  std::optional<Fault> start(double rate) noexcept override {
    if (wrong_.start) {
      took_effect = true;
      if (const auto fault = wrong_.start()) return fault;
    }
    return arm_.start(rate);
  }
  device::ReadResult read() noexcept override {
    if (tick() == wrong_.tick) {
      took_effect = true;
      if (scene_.at_fault) scene_.at_fault(recording_);
    }
    device::ReadResult result = arm_.read();
    if (auto* reading = std::get_if<device::Reading>(&result); reading && scene_.dead_man_button) reading->buttons = 3;
    if (wrong_.read && is_wrong()) wrong_.read(result, tick() - wrong_.tick);
    return result;
  }
  void allow(const device::Allowance& allowance) noexcept override { arm_.allow(allowance); }
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    Eigen::Vector3f obeyed = force;
    std::optional<Fault> fault;
    if (wrong_.command && is_wrong()) fault = wrong_.command(obeyed, tick() - wrong_.tick);
    forces.push_back(force);
    const auto refused = arm_.command(obeyed);
    return fault ? fault : refused;
  }
  device::State state() const noexcept override {
    device::State state = arm_.state();
    if (wrong_.state && is_wrong()) wrong_.state(state, tick() - wrong_.tick);
    return state;
  }

  bool took_effect = false;
  std::vector<Eigen::Vector3f> forces;  // commanded, tick by tick, and the zero at the end

 private:
  std::size_t tick() const noexcept { return forces.size(); }
  bool is_wrong() const noexcept { return tick() >= wrong_.tick; }

  Device& arm_;
  const Wrong& wrong_;
  const Bench& bench_;
  const Scene& scene_;
  std::string recording_;
};

class LosesSome final : public device::SampleSink {
 public:
  explicit LosesSome(SampleSink& to) : to_(to) {}
  void push(const device::Sample& sample) noexcept override {
    if (sample.tick % 100 != 99) to_.push(sample);
  }

 private:
  SampleSink& to_;
};

fast::Law law_of(const Scene& scene) {
  return std::get<fast::Law>(fast::Law::build(scene.law, {.radius = 15.24F, .width = 25.4F, .stiffness = scene.stiffness}));
}

device::ServoOptions options_of(const Scene& scene, std::vector<device::SampleSink*> sinks) {
  return {.max_seconds = kEnd / 1000.0, .dead_man_button = scene.dead_man_button, .sinks = std::move(sinks)};
}

// The commands when nothing goes wrong.
std::vector<Eigen::Vector3f> undisturbed(const Scene& scene, const Bench& bench) {
  auto arm = arm_of(scene);
  const Wrong nothing{.tick = kEnd + 1};
  WrongDevice device(arm, nothing, bench, scene, "");
  run_servo_loop(device, law_of(scene), options_of(scene, {}), std::atomic<bool>(false));
  return device.forces;
}

double size_of(const Eigen::Vector3f& force) {
  return force.allFinite() ? force.cast<double>().norm() : std::numeric_limits<double>::infinity();
}

// The end of the run; if it went on, the rules that came to limit a force in the tick of the fault or later.
std::string reaction_of(const device::ServoResult& run, const std::vector<device::Sample>& told, std::size_t fault) {
  if (run.trip) return "trip: " + std::string(name_of(run.trip->rule));
  if (run.end_reason == device::EndReason::device_fault) return std::string("device fault: ") + run.fault;
  if (run.end_reason != device::EndReason::time_up) return "ends: " + std::string(name_of(run.end_reason));
  unsigned limited = 0;
  for (const device::Sample& sample : told)
    if (sample.tick >= fault) limited |= sample.limited;
  if (fault > 0) limited &= ~static_cast<unsigned>(told[fault - 1].limited);
  std::string rules;
  for (std::size_t rule = 0; rule < device::kRules; ++rule)
    if ((limited >> rule & 1U) != 0)
      rules += (rules.empty() ? "limited: " : ", ") + std::string(name_of(static_cast<device::Rule>(rule)));
  return rules.empty() ? "goes on" : rules;
}

// The number of samples that the recording has as the loop told them.
std::size_t kept_in(const std::string& recording, const std::vector<device::Sample>& told) {
  std::unordered_map<std::uint64_t, device::Sample> kept;
  try {
    recorder::Recording(recording).for_each_chunk([&](std::span<const device::Sample> chunk) {
      for (const device::Sample& sample : chunk) kept[sample.tick] = sample;
    });
  } catch (const Error&) {
    // Unreadable samples are lost.
  }
  return static_cast<std::size_t>(std::count_if(told.begin(), told.end(), [&](const device::Sample& sample) {
    const auto found = kept.find(sample.tick);
    return found != kept.end() && std::memcmp(&found->second, &sample, sizeof sample) == 0;
  }));
}

}  // namespace

std::function<void(device::ReadResult&, Wrong::Since)> reading(std::function<void(device::Reading&, Wrong::Since)> alter) {
  return [alter = std::move(alter)](device::ReadResult& result, Wrong::Since since) {
    if (auto* reading = std::get_if<device::Reading>(&result)) alter(*reading, since);
  };
}

Outcome press(const Wrong& wrong, const Bench& bench, const Scene& scene) {
  const tests::TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  auto arm = arm_of(scene);
  WrongDevice device(arm, wrong, bench, scene, path);
  tests::KeptSamples told;
  Outcome outcome;
  recorder::Recorder::Result recorded;
  {
    const fast::Law law = law_of(scene);
    recorder::Recorder recorder(path, {}, scene.recorder);
    LosesSome some(recorder);
    device::SampleSink& sink = bench.records_all ? static_cast<device::SampleSink&>(recorder) : some;
    const std::atomic<bool> never = false;
    try {
      if (scene.before) scene.before();
      const auto run = run_servo_loop(device, law, options_of(scene, {&told, &sink}), scene.stop ? *scene.stop : never);
      outcome.reaction = reaction_of(run, told.samples, wrong.tick);
    } catch (const std::exception& error) {
      outcome.reaction = std::string("refused: ") + error.what();
      outcome.took_effect = true;
    }
    recorded = recorder.close("fault");
  }
  if (outcome.reaction == "goes on" && device.forces == undisturbed(scene, bench)) outcome.reaction += ", same forces";
  if (!recorded.error.empty()) outcome.reaction += "; recorder: " + recorded.error;
  if (recorded.lost > 0) outcome.reaction += "; counted as lost: " + std::to_string(recorded.lost);
  outcome.took_effect |= device.took_effect;
  for (const Eigen::Vector3f& force : device.forces) outcome.highest = std::max(outcome.highest, size_of(force));
  if (wrong.tick > 0 && wrong.tick <= device.forces.size()) outcome.before = size_of(device.forces[wrong.tick - 1]);
  std::size_t zero = device.forces.size();
  while (zero > 0 && device.forces[zero - 1].isZero(0)) --zero;
  const bool went_on = told.samples.size() == kEnd + 1 && zero >= kEnd;
  if (device.forces.empty())
    outcome.to_zero = 0;
  else if (!went_on)
    outcome.to_zero = zero - std::min(wrong.tick, zero);
  outcome.lost = told.samples.size() - kept_in(path, told.samples);
  return outcome;
}

}  // namespace forceshade::faults
