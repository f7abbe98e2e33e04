// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stand-in's inside: what its functions and its scheduler share.

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "forceshade/device/simulated.h"

#pragma GCC visibility push(default)
#include "forceshade/tests/stand_in_hd/stand_in_hd.h"
#pragma GCC visibility pop

namespace forceshade::stand_in_hd {

using namespace hdapi;

constexpr HHD kDevice = 7;

struct Callback {
  HDCallback function;
  void* data;
};

struct Driver {
  std::mutex mutex;  // guards all below, but is not held while a callback runs
  Orders orders;
  Seen seen;
  std::vector<HDErrorInfo> errors;
  std::unique_ptr<device::Simulated> phantom;
  bool in_frame = false, pushes = false;
  int frames_this_tick = 0;
  Eigen::Vector3d position{0, 0, 0}, force{0, 0, 0};
  std::array<HDlong, 6> encoder{};
  std::map<HDSchedulerHandle, Callback> callbacks;
  HDSchedulerHandle next_handle = 1;
  std::thread scheduler;
  std::thread::id scheduler_id;
  std::atomic<bool> stop = false;
};

Driver& driver();

// What the arm feels from now on.
void obey(Driver& driver, const Eigen::Vector3d& force);

enum class Where { anywhere, not_beside_scheduler, in_frame };

// One call to the driver: holds the lock, and notes what the caller should not have done.
class Call {
 public:
  Call(const char* name, Where where) : name_(name) {
    const bool beside = d.seen.scheduler && std::this_thread::get_id() != d.scheduler_id;
    if (where != Where::anywhere && beside) breach("beside the running scheduler");
    // Beside it, the error may be the scheduler thread's own, about to be read there.
    if (!beside && !d.errors.empty()) breach("with an error unread");
    if (where == Where::in_frame && !d.in_frame) breach("outside a frame");
  }
  void breach(const std::string& words) { d.seen.breaches.push_back(std::string(name_) + " " + words); }
  void fail(HDerror code) {
    if (code != kSuccess) d.errors.push_back({code, 42, kDevice});
  }

  Driver& d = driver();

 private:
  std::lock_guard<std::mutex> lock_{d.mutex};
  const char* name_;
};

// Runs the callbacks at this rate until told to stop: the scheduler's thread.
void run(double rate);

}  // namespace forceshade::stand_in_hd
