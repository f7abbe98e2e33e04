// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/stand_in_hd/driver.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <stdexcept>

namespace forceshade::stand_in_hd {
namespace {

Memory& shared_or_own() {
  const char* path = std::getenv(kMemory);
  if (!path) return made(nullptr);
  try {
    return opened(path);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "the stand-in for libHD.so cannot use %s: %s\n", kMemory, error.what());
    std::abort();
  }
}

void catch_up(Driver& d) {
  if (d.resets != d.memory.resets) {
    d.errors.clear();
    d.force.setZero();
    d.device = d.running = d.starting = d.calibrated = false;
    d.rate = d.noted.rate;
  }
  if (d.resets != d.memory.resets || d.tellings != d.memory.tellings) d.reported.clear();
  d.resets = d.memory.resets;
  d.tellings = d.memory.tellings;
}

bool reached(const Driver& d, Moment moment, std::uint64_t frame) {
  switch (moment) {
    case Moment::settling: return d.frames >= 10;
    case Moment::frame: return d.frames >= frame;
    case Moment::free: return d.frames_on >= std::max<std::uint64_t>(frame, 1) && d.contacts == 0 && d.force.isZero(0);
    case Moment::contact: return d.in_contact >= kContactFrames;
    default: return false;
  }
}

// From 0 to 1, at rest at both ends.
double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 - 15 * t + 6 * t * t);
}

// mm, in the driver's frame. Shaken aside by less than a hand does, so that no encoder seems to be frozen.
Eigen::Vector3d pressing(const Driver& d) {
  constexpr double kFrom = 3, kTo = -2, kBegin = 0.7, kDuration = 0.2, kShake = 0.1, kShakeHz = 9;
  const double time = static_cast<double>(d.frames) / meant_rate(d), on = static_cast<double>(d.frames_on) / meant_rate(d);
  return {kShake * std::sin(2 * std::numbers::pi * kShakeHz * time), kFrom + (kTo - kFrom) * smooth((on - kBegin) / kDuration),
          0};
}

void tick() {
  Driver& d = driver();
  const std::lock_guard others_wait(d.ticking);
  std::map<HDSchedulerHandle, Callback> callbacks;
  {
    const Lock lock(d.memory);
    if (!d.noted.output && d.phantom) obey(d, {0, 0, 0});
    if (d.orders.hung) return;
    callbacks = d.callbacks;
    d.frames_this_tick = 0;
  }
  for (const auto& [handle, callback] : callbacks) {
    const bool done = callback.function(callback.data) != kCallbackContinue;
    Call call("the callback", Where::anywhere);
    std::erase_if(d.errors, [&](const Error& error) { return error.caused_by == d.scheduler_id; });
    if (d.in_frame) call.breach("left a frame open");
    d.in_frame = false;
    if (done) d.callbacks.erase(handle);
  }
}

}  // namespace

// Never destroyed: a process may end with its scheduler running.
Driver& driver() {
  static auto& it = *new Driver(shared_or_own());
  return it;
}

Call::Call(const char* name, Where where) : name_(name) {
  catch_up(d);
  const auto here = std::this_thread::get_id();
  const bool beside = d.running && here != d.scheduler_id;
  if (where != Where::anywhere && beside) breach("beside the running scheduler");
  if (std::any_of(d.errors.begin(), d.errors.end(), [&](const Error& error) { return error.caused_by == here; }))
    breach("with an error unread");
  if ((where == Where::in_frame || (where == Where::in_frame_if_running && d.running)) && !d.in_frame)
    breach("outside a frame");
}

void Call::breach(const std::string& words) {
  const std::uint64_t n = d.noted.breach_count++;
  if (n < d.noted.breaches.size())
    std::snprintf(d.noted.breaches[n].data(), d.noted.breaches[n].size(), "%s %s", name_, words.c_str());
}

void Call::fail_in_frame(HDerror code) {
  const bool lasts = code >= kWarmMotors;
  if (code != kSuccess && (!lasts || d.orders.errors_repeat || d.reported.emplace(name_, code).second)) fail(code);
}

void obey(Driver& d, const Eigen::Vector3d& force) {
  d.phantom->command(device::turned_to_law(force).cast<float>());
  const Eigen::Vector3d before = d.noted.force;
  if (before == force) return;
  d.noted.changed = Clock::now();
  if (force.isZero(0)) d.noted.pushed_until = d.noted.changed;
  d.noted.force = force;
}

void look(Driver& d) {
  const auto reading = std::get<device::Reading>(d.phantom->read());
  if (d.orders.comm_lost) return;
  d.position = device::turned_to_arm(reading.position.cast<double>());
  std::copy(reading.encoder->begin(), reading.encoder->end(), d.encoder.begin());
  if (d.orders.press) d.position = pressing(d);
  if (d.orders.position) d.position = *d.orders.position;
  const Eigen::Vector3d& quantum = d.model.quantum;
  if (const auto angles = d.model.arm.inverse(d.position * device::kMillimetre); angles && angles->allFinite())
    for (Eigen::Index i = 0; i < 3; ++i) d.encoder[static_cast<std::size_t>(i)] = std::lround((*angles)[i] / quantum[i]);
  for (Eigen::Index i = 0; i < 3; ++i) d.joints[i] = static_cast<double>(d.encoder[static_cast<std::size_t>(i)]) * quantum[i];
}

double meant_rate(const Driver& d) {
  return d.orders.frame_hz > 0 ? d.orders.frame_hz : d.rate;
}

int counted_rate(const Driver& d) {
  return d.orders.comm_lost ? 0 : static_cast<int>(std::lround(meant_rate(d)));
}

Due due(Driver& d, std::optional<Moment> moment) {
  const auto is_due = [&](const auto& order, Memory::Time& done) {
    const bool now = done == Memory::Time{} && (moment ? order.when == *moment : reached(d, order.when, order.frame));
    if (now) done = Clock::now();
    return now;
  };
  Due due;
  if (d.orders.kill.when != Moment::never && is_due(d.orders.kill, d.noted.killed)) {
    due.kill = d.orders.kill;
    d.noted.killed_under = d.noted.force;
  }
  if (d.orders.crash.when != Moment::never && is_due(d.orders.crash, d.noted.crashed)) due.crash = d.orders.crash;
  return due;
}

void happen(const Due& due) {
  if (due.kill) {
    pid_t whom = due.kill->pid;
    if (whom == Kill::kDriver) whom = getpid();
    if (whom == Kill::kParent) whom = getppid();
    kill(whom, due.kill->signal);
  }
  if (!due.crash) return;
  switch (due.crash->how) {
    case Crash::How::segmentation_fault: std::raise(SIGSEGV); break;
    case Crash::How::abort: std::abort();
    case Crash::How::exit: std::exit(0);
    case Crash::How::exception: throw std::runtime_error("thrown by the driver");
    case Crash::How::hang:
      for (;;) pause();
  }
}

void block_if_told(Blocks here) {
  Driver& d = driver();
  const auto told = [&] {
    const Lock lock(d.memory);
    return d.orders.blocks == here;
  };
  if (told())
    for (;;) pause();
}

void run() {
  Driver& d = driver();
  const auto period = [&] {
    const Lock lock(d.memory);
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / meant_rate(d)));
  };
  // An error of the start is there for who has started it.
  const auto started_well = [&] {
    const Lock lock(d.memory);
    return d.errors.empty();
  };
  for (const auto latest = Clock::now() + std::chrono::milliseconds(100); !started_well() && Clock::now() < latest;)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  for (auto next = Clock::now(); !d.stop; next = std::max(next + period(), Clock::now())) {
    std::this_thread::sleep_until(next);
    tick();
  }
}

}  // namespace forceshade::stand_in_hd
