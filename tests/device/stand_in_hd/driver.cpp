// SPDX-License-Identifier: BSD-3-Clause
// The vendor's functions, and the scheduler's thread that runs the caller's frames.

// First, so that what is declared in it can be found by its name.
#pragma GCC visibility push(default)
#include "device/phantom/hdapi_abi.h"
#pragma GCC visibility pop

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "tests/device/stand_in_hd/memory.h"

namespace forceshade::stand_in_hd {
namespace {

using namespace hdapi;

constexpr HHD kDevice = 7;

// Guarded by the memory's lock, which is not held while a callback runs.
struct Driver {
  explicit Driver(Memory& shared) : memory(shared) {}

  Memory& memory;
  Orders& orders = memory.orders;
  Memory::Noted& noted = memory.noted;
  std::vector<HDErrorInfo> errors;
  double rate = 1000;
  Eigen::Vector3d position{0, 0, 0}, force{0, 0, 0};
  std::uint64_t frames = 0, frames_on = 0,
                in_contact = 0;  // since the start, since the output went on, in contact at a stretch
  std::optional<std::pair<HDCallback, void*>> callback;
  std::recursive_mutex ticking;  // held while the callback runs
  std::thread scheduler;
  std::atomic<bool> stop = false;
};

// Never destroyed: a process may end with its scheduler running.
Driver& driver() noexcept {
  const char* const path = std::getenv(kMemory);
  static auto& it = *new Driver(path ? opened(path) : made(nullptr));
  return it;
}

// One call to the driver, which holds the lock.
struct Call {
  void fail(HDerror code) {
    if (code != kSuccess) d.errors.push_back({code, 42, kDevice});
  }

  Driver& d = driver();
  const Lock lock{d.memory};
};

// Sets the force that the arm feels from now on.
void obey(Driver& d, const Eigen::Vector3d& force) {
  if (force.isZero(0) && !Eigen::Vector3d(d.noted.force).isZero(0)) d.noted.pushed_until = Clock::now();
  d.noted.force = force;
}

// mm. Shaken aside by less than a hand does, so that no encoder seems to be frozen.
Eigen::Vector3d position_of(const Driver& d) {
  if (d.orders.position) return *d.orders.position;
  constexpr double kFrom = 3, kTo = -2, kBegin = 0.7, kDuration = 0.2, kShake = 0.1, kShakeHz = 9;
  const double time = static_cast<double>(d.frames) / d.rate, on = static_cast<double>(d.frames_on) / d.rate;
  const double t = d.orders.press ? std::clamp((on - kBegin) / kDuration, 0.0, 1.0) : 0;
  return {kShake * std::sin(2 * std::numbers::pi * kShakeHz * time),
          kFrom + (kTo - kFrom) * t * t * t * (10 - 15 * t + 6 * t * t), 0};  // at rest at both ends
}

// The crash that is due at this moment, noted as done; happen() carries it out, without the lock.
std::optional<Crash> due(Driver& d, Moment moment) {
  const Crash& it = d.orders.crash;
  const bool is_due = it.when == moment && d.noted.struck == Clock::time_point{} &&
                      (moment != Moment::frame || d.frames >= it.frame) &&
                      (moment != Moment::contact || d.in_contact >= kContactFrames);
  if (!is_due) return std::nullopt;
  d.noted.struck = Clock::now();
  return it;
}

void happen(const std::optional<Crash>& crash) {
  if (!crash) return;
  switch (crash->how) {
    case Crash::How::segmentation_fault: std::raise(SIGSEGV); break;
    case Crash::How::abort: std::abort();
    case Crash::How::exit: std::exit(0);
    case Crash::How::exception: throw std::runtime_error("thrown by the driver");
    case Crash::How::signal_to_parent: kill(getppid(), crash->signal); break;
    case Crash::How::hang:
      for (;;) pause();
  }
}

void tick() {
  Driver& d = driver();
  const std::lock_guard others_wait(d.ticking);
  std::optional<std::pair<HDCallback, void*>> callback;
  {
    const Lock lock(d.memory);
    if (!d.noted.output) obey(d, {0, 0, 0});
    if (d.orders.hung) return;
    callback = d.callback;
  }
  if (callback) callback->first(callback->second);
}

// Runs the callback until told to stop: the scheduler's thread.
void run() {
  Driver& d = driver();
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / d.rate));
  for (auto next = Clock::now(); !d.stop; next = std::max(next + period, Clock::now())) {
    std::this_thread::sleep_until(next);
    tick();
  }
}

}  // namespace
}  // namespace forceshade::stand_in_hd

namespace forceshade::device::hdapi {
using namespace stand_in_hd;
extern "C" {

HHD hdInitDevice(const char*) {
  std::optional<Crash> crash;
  {
    Call call;
    Driver& d = call.d;
    std::puts("InitLogFile : (null)");
    std::fflush(stdout);
    const bool is_held = d.noted.initialised && d.noted.pid != getpid() && lives(d.noted.pid);
    if (const HDerror error = d.orders.init != kSuccess ? d.orders.init : is_held ? kAlreadyInitiated : kSuccess) {
      call.fail(error);
      return kInvalidDevice;
    }
    d.noted.scheduler = d.noted.output = false;
    d.noted.initialised = true;
    d.noted.pid = getpid();
    crash = due(d, Moment::before_start);
  }
  happen(crash);
  return kDevice;
}

// Ends the force. Waits for a callback that runs, unless it runs on this very thread: then no frame may follow.
void hdDisableDevice(HHD) {
  const std::lock_guard waits(driver().ticking);
  const Call call;
  obey(call.d, {0, 0, 0});
  call.d.noted.initialised = call.d.noted.output = false;
}

void hdBeginFrame(HHD) {
  Call call;
  Driver& d = call.d;
  d.force.setZero();
  ++d.frames;
  if (d.noted.output) ++d.frames_on;
  d.position = position_of(d);
  call.fail(d.orders.begin);
}

void hdEndFrame(HHD) {
  std::optional<Crash> crash;
  {
    const Call call;
    Driver& d = call.d;
    obey(d, d.noted.output ? d.force : Eigen::Vector3d(0, 0, 0));
    d.in_contact = Eigen::Vector3d(d.noted.force).norm() > kContact ? d.in_contact + 1 : 0;
    ++d.noted.frames;
    crash = due(d, Moment::frame);
    if (!crash) crash = due(d, Moment::contact);
  }
  happen(crash);
}

HDErrorInfo hdGetError() {
  const Call call;
  if (call.d.errors.empty()) return {};
  const HDErrorInfo last = call.d.errors.back();
  call.d.errors.pop_back();
  return last;
}

const char* hdGetErrorString(HDerror) {
  return "Some error.";
}

void hdEnable(HDenum) {
  const Call call;
  call.d.noted.output = true;
  call.d.frames_on = 0;
}

// The arm gets to know of it at the next tick: never, once the scheduler has stopped.
void hdDisable(HDenum) {
  const Call call;
  call.d.noted.output = false;
}

HDboolean hdIsEnabled(HDenum) {
  const Call call;
  return call.d.noted.output ? 1 : 0;
}

void hdGetBooleanv(HDenum, HDboolean* value) {
  *value = 0;
}

void hdGetIntegerv(HDenum what, int* value) {
  Call call;
  switch (what) {
    case kButtons: *value = 2; break;
    case kInputDegrees: *value = 6; break;
    case kOutputDegrees: *value = 3; break;
    case kCalibrationStyles: *value = kCalibratesInInkwell; break;
    case kUpdateRate: *value = 1000; break;
    case kInstantaneousRate: *value = static_cast<int>(call.d.rate); break;
    default: call.fail(kInvalidEnum);
  }
}

void hdGetLongv(HDenum, HDlong* values) {
  const Call call;
  std::transform(call.d.position.begin(), call.d.position.end(), values, [](double x) { return std::lround(20 * x); });
}

void hdGetDoublev(HDenum what, double* values) {
  Call call;
  const Eigen::Vector3d &p = call.d.position, joints = p / 200;
  const auto give = [&](std::initializer_list<double> right) { std::copy(right.begin(), right.end(), values); };
  switch (what) {
    case kPosition: return give({p.x(), p.y(), p.z()});
    case kJointAngles: return give({joints.x(), joints.y(), joints.z()});
    case kGimbalAngles: return give({0.1, 0.2, 0.3});
    case kMotorTemperature: return give({0.125, 0.25, 0.0625});
    case kUsableWorkspace: return give({-190, -95, -130, 191, 96, 137});
    case kMaxForce: return give({8.5});
    case kContinuousForce: return give({1.4});
    case kVelocityLimit: return give({1500});
    case kImpulseLimit: return give({4});
    default: call.fail(kInvalidEnum);
  }
}

void hdSetDoublev(HDenum, const double* value) {
  const Call call;
  call.d.force = {value[0], value[1], value[2]};
}

const char* hdGetString(HDenum what) {
  constexpr const char* kStrings[] = {"3.4.0", "Stand-in 1.5", "4.3.3", "Nobody", "S-0042", "192"};
  return kStrings[what - kVersion];
}

HDenum hdCheckCalibration() {
  return kCalibrated;
}

void hdUpdateCalibration(HDenum) {}

// The vendor's library, too, puts its own handler of SIGTERM over the program's.
void hdStartScheduler() {
  const Call call;
  Driver& d = call.d;
  std::signal(SIGTERM, [](int) { _exit(0); });
  d.stop = false;
  d.noted.scheduler = true;
  d.frames = d.frames_on = d.in_contact = 0;
  d.scheduler = std::thread(run);
}

void hdStopScheduler() {
  Driver& d = driver();
  d.stop = true;
  if (d.scheduler.joinable()) d.scheduler.join();
  const Lock lock(d.memory);
  d.noted.scheduler = false;
}

void hdSetSchedulerRate(HDulong hz) {
  const Call call;
  call.d.rate = static_cast<double>(hz);
}

HDSchedulerHandle hdScheduleAsynchronous(HDCallback function, void* data, HDushort) {
  const Call call;
  call.d.callback = {function, data};
  return 0;
}

void hdUnschedule(HDSchedulerHandle) {
  const Call call;
  call.d.callback.reset();
}
}

}  // namespace forceshade::device::hdapi
