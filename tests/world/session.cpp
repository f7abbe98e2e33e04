// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/session.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "forceshade/fast.h"
#include "tests/world/judge.h"

namespace forceshade::world {
namespace {

using device::FrameState;

constexpr Ns kMillisecond = 1'000'000;
constexpr Ns kAnswer = kMillisecond / 20, kLongestAnswer = 25 * kMillisecond;
constexpr Ns kLongest = 40 * system::kSecond;  // of a session in the world
constexpr int kUntilItStays = 3000;            // ms, after which a force is taken to stay

// The hand's height above the wall: down to 1 mm inside it, every second.
double height_at(Ns time) {
  return 1.5 - 2.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(time) * 1e-9 - 0.9));
}

std::uint64_t mixed(std::uint64_t digest, std::uint64_t value) {
  return (digest ^ value) * 0x100000001b3ULL;
}

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

const Event* Arm::event_at(int frame, Event::Kind kind) const noexcept {
  const auto found = std::ranges::find_if(plan_.events, [&](const Event& event) {
    const bool lasts = event.kind == Event::Kind::uncalibrated || event.kind == Event::Kind::forces_off ||
                       event.kind == Event::Kind::lets_go_of_button;
    const int frames = lasts ? std::max(1, static_cast<int>(event.milliseconds)) : 1;
    return event.kind == kind && frame >= event.frame && frame < event.frame + frames;
  });
  return found == plan_.events.end() ? nullptr : &*found;
}

FrameState Arm::frame(const Eigen::Vector3d& force) {
  push(force);
  const int number = static_cast<int>(sent_.size()) - 1;
  const FrameState its = state();
  if (event_at(number, Event::Kind::garbage)) throw std::runtime_error("the arm sent garbage");
  const Event* late = event_at(number, Event::Kind::late);
  const Ns answer = kAnswer + (late ? static_cast<Ns>(late->milliseconds * 1e6) : 0);
  system::sleep_until(system::now() + std::min(answer, kLongestAnswer));
  answered();
  if (answer > kLongestAnswer) throw std::runtime_error("the arm has not answered in time");
  return its;
}

void Arm::look() {
  const int number = frames();
  if (closed_at_) on_misuse("a frame follows the end");
  if (event_at(number, Event::Kind::jump)) jump();
  const Ns time = current()->outside_now();
  const double seconds = static_cast<double>(time) * 1e-9;
  const Eigen::Vector3d position{0.3 * std::sin(40 * seconds) + offset_, number / kFramesInMillimetre, height_at(time)};
  if (!sent_.empty()) work_ += felt().dot(position - sent_.back().position);
  most_work_ = std::max(most_work_, work_);
  const bool obeys = is_calibrated && has_forces_on && event_at(number, Event::Kind::uncalibrated) == nullptr &&
                     event_at(number, Event::Kind::forces_off) == nullptr;
  next_ = Sent{time, Eigen::Vector3d::Zero(), position, obeys};
}

void Arm::push(const Eigen::Vector3d& force) {
  if (!next_) look();
  next_->time = current()->outside_now();
  next_->force = force;
  sent_.push_back(*next_);
  next_.reset();
  on_sent(sent_.back());
}

FrameState Arm::state() const {
  const int number = next_ ? frames() : frames() - 1;
  return {.position = (next_ ? *next_ : sent_.back()).position,
          .buttons = static_cast<std::uint16_t>(event_at(number, Event::Kind::lets_go_of_button) ? 0 : 1),
          .calibrated = is_calibrated && event_at(number, Event::Kind::uncalibrated) == nullptr,
          .forces_on = has_forces_on && event_at(number, Event::Kind::forces_off) == nullptr};
}

void Arm::lose_client() {
  lost_at_ = current()->outside_now();
  if (on_lost) on_lost();
}

void Arm::close() {
  system::step();
  if (closed_at_) on_misuse("closed twice");
  if (has_forces_on && !sent_.empty() && !sent_.back().force.isZero(0)) on_misuse("closed under a force");
  closed_at_ = current()->outside_now();
}

void Arm::open() noexcept {
  closed_at_.reset();
  is_out_of_reach = false;
}

Ns Arm::felt_until() const noexcept {
  if (sent_.empty() || closed_at_ || !has_forces_on || sent_.back().force.isZero(0)) return 0;
  Ns until = current()->outside_now();
  if (plan_.own_watchdog) until = std::min(until, sent_.back().time + *plan_.own_watchdog);
  if (lost_at_ && sees_end_after) until = std::min(until, *lost_at_ + *sees_end_after);
  return until;
}

Eigen::Vector3d Arm::felt() const noexcept {
  if (felt_until() < current()->outside_now()) return Eigen::Vector3d::Zero();
  return sent_.back().force;
}

std::string Outcome::words() const {
  if (!refused.empty()) return "not opened: " + refused;
  if (end == World::End::dead) return "the loop is dead";
  if (end == World::End::never) return "it never ends";
  std::string words(name_of(result.end_reason));
  if (result.trip) words += ": " + std::string(name_of(result.trip->rule));
  if (result.end_reason == device::EndReason::device_fault) words += std::string(": ") + result.fault;
  return words;
}

Outcome session(const Plan& plan, const Open& open) {
  World world(plan.schedule);
  Arm arm(plan);
  Judge judge(world, arm);
  const Ns begin = world.now();
  world.at_step = [&](long) {
    if (plan.at_step) plan.at_step(arm);
    judge.look();
  };
  Outcome outcome;
  const auto run = [&] {
    Watched device(open(arm), judge);
    const std::atomic<bool> stop = false;
    auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = plan.stiffness}));
    device::ServoOptions options{
        .rate_hz = 1000, .max_seconds = plan.seconds, .follows_device = plan.follows_device, .sinks = {&judge}};
    if (plan.has_dead_man_button) options.dead_man_button = 0;
    outcome.result = device::run_servo_loop(device, law, options, stop);
  };
  outcome.end = world.run(
      [&] {
        try {
          run();
        } catch (const device::DeviceError& error) {
          outcome.refused = error.what();
        }
      },
      kLongest);
  // Everything else goes on if the loop is dead, a library's call that is left alone in any case, and the arm whatever is dead.
  // Another process goes on for ever where that of the loop is not dead.
  const Ns rest = world.processes() > 1 && !world.exit_code(0) ? 200 * kMillisecond : 2 * system::kSecond;
  for (int thread = 0; thread < world.threads(); ++thread)
    if (!world.is_over(thread) && (outcome.end == World::End::dead || world.name(thread) == "calls"))
      world.run_until_over(thread, rest);
  for (int i = 0; i < kUntilItStays && !arm.felt().isZero(0); ++i) {
    world.pass(1);
    judge.look();
  }
  judge.conclude(outcome);
  outcome.driver_exit = world.exit_code(kDriver);
  outcome.violations = judge.violations();
  outcome.decisions = world.decisions();
  outcome.frames = arm.sent().size();
  outcome.lasted = world.now() - begin;
  outcome.steps = world.steps();
  outcome.digest = mixed(static_cast<std::uint64_t>(outcome.lasted), static_cast<std::uint64_t>(outcome.steps));
  for (const Arm::Sent& sent : arm.sent()) {
    outcome.peak = std::max(outcome.peak, sent.force.norm());
    outcome.digest = mixed(mixed(outcome.digest, static_cast<std::uint64_t>(sent.time)), bits_of(sent.force.z()));
  }
  return outcome;
}

}  // namespace forceshade::world
