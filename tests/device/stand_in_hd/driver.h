// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stand-in's inside: what its functions and its scheduler share in the process that has loaded it.

// First, so that what is declared in it can be found by its name.
#pragma GCC visibility push(default)
#include "device/phantom/hdapi_abi.h"
#pragma GCC visibility pop

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "device/simulated/model.h"
#include "device/simulated/simulated.h"
#include "tests/device/stand_in_hd/memory.h"

namespace forceshade::stand_in_hd {

using namespace hdapi;
using Clock = std::chrono::steady_clock;

constexpr HHD kDevice = 7;
constexpr double kPeakForce = 8.5;  // N

struct Callback {
  HDCallback function;
  void* data;
};

struct Error {
  HDErrorInfo info;
  std::thread::id caused_by;
};

// Guarded by the memory's lock, which is not held while a callback runs.
struct Driver {
  explicit Driver(Memory& shared) : memory(shared) {}

  Memory& memory;
  Orders& orders = memory.orders;
  Memory::Noted& noted = memory.noted;
  std::uint64_t resets = memory.resets, tellings = memory.tellings;  // that this process knows of

  std::vector<Error> errors;
  std::set<std::pair<std::string_view, HDerror>> reported;  // in frames, since orders were given
  // In this process; running: the scheduler; starting: it was told to run, whether it does or not.
  bool device = false, running = false, starting = false, calibrated = false;
  double rate = 1000;
  std::unique_ptr<device::Simulated> phantom;
  device::Model model = device::premium_1_5();
  bool in_frame = false;
  int frames_this_tick = 0;
  Eigen::Vector3d position{0, 0, 0}, force{0, 0, 0};
  std::array<HDlong, 6> encoder{};
  Eigen::Vector3d joints{0, 0, 0};  // rad
  // Frames since the start, since the output went on, in contact at a stretch, in contact ever.
  std::uint64_t frames = 0, frames_on = 0, in_contact = 0, contacts = 0;

  std::map<HDSchedulerHandle, Callback> callbacks;
  std::recursive_mutex ticking;  // held while callbacks run
  std::thread scheduler;
  std::thread::id scheduler_id;
  std::atomic<bool> stop = false;
};

Driver& driver();

// Sets the force that the arm feels from now on.
void obey(Driver& driver, const Eigen::Vector3d& force);

// Updates the arm's position and its encoders.
void look(Driver& driver);

// Frames a second that are meant; and as the device counts them, which knows nothing of how late this machine runs them.
double meant_rate(const Driver& driver);
int counted_rate(const Driver& driver);

// The orders due at this moment, noted as done; happen() carries them out, without the lock.
struct Due {
  std::optional<Kill> kill;
  std::optional<Crash> crash;
};
Due due(Driver& driver, std::optional<Moment> moment = std::nullopt);
void happen(const Due& due);

void block_if_told(Blocks here);

enum class Where { anywhere, not_beside_scheduler, in_frame, in_frame_if_running };

// One call to the driver: holds the lock, and notes what the caller should not have done.
class Call {
 public:
  Call(const char* name, Where where);
  void breach(const std::string& words);
  void fail(HDerror code) {
    if (code != kSuccess) d.errors.push_back({{code, 42, kDevice}, std::this_thread::get_id()});
  }
  // As in a frame: a condition that lasts is reported once.
  void fail_in_frame(HDerror code);

  Driver& d = driver();

 private:
  Lock lock_{d.memory};
  const char* name_;
};

// Runs the callbacks until told to stop: the scheduler's thread.
void run();

}  // namespace forceshade::stand_in_hd
