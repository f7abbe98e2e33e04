// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/tests/stand_in_hd/driver.h"

#include <algorithm>
#include <cstdlib>

namespace forceshade::stand_in_hd {
namespace {

using Clock = std::chrono::steady_clock;

Orders first_orders() {
  Orders orders;
  if (const char* code = std::getenv("STAND_IN_HD_INIT")) orders.init = static_cast<HDerror>(std::strtoul(code, nullptr, 0));
  return orders;
}

void tick() {
  Driver& d = driver();
  std::map<HDSchedulerHandle, Callback> callbacks;
  {
    const std::lock_guard lock(d.mutex);
    if (d.orders.hung) return;
    callbacks = d.callbacks;
    d.frames_this_tick = 0;
  }
  for (const auto& [handle, callback] : callbacks) {
    const bool done = callback.function(callback.data) != kCallbackContinue;
    Call call("the callback", Where::anywhere);
    d.errors.clear();
    if (d.in_frame) call.breach("left a frame open");
    d.in_frame = false;
    if (done) d.callbacks.erase(handle);
  }
}

}  // namespace

// Never destroyed: a process may end with its scheduler running.
Driver& driver() {
  static auto& it = *[] {
    auto* fresh = new Driver;
    fresh->orders = first_orders();
    return fresh;
  }();
  return it;
}

void obey(Driver& d, const Eigen::Vector3d& force) {
  d.phantom->command(device::turned_to_law(force).cast<float>());
  const bool pushed = d.pushes;
  d.pushes = !force.isZero(0);
  if (pushed && !d.pushes) d.seen.pushed_until = Clock::now();
}

void run(double rate) {
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate));
  for (auto due = Clock::now(); !driver().stop; due = std::max(due + period, Clock::now())) {
    std::this_thread::sleep_until(due);
    tick();
  }
}

void reset() {
  Driver& d = driver();
  const std::lock_guard lock(d.mutex);
  d.orders = first_orders();
  d.seen = {};
  d.errors.clear();
  d.force.setZero();
}

void tell(const Orders& orders) {
  const std::lock_guard lock(driver().mutex);
  driver().orders = orders;
}

Seen seen() {
  const std::lock_guard lock(driver().mutex);
  return driver().seen;
}

}  // namespace forceshade::stand_in_hd
