// SPDX-License-Identifier: BSD-3-Clause
// The vendor's functions, but for those that get something.

#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "tests/device/stand_in_hd/driver.h"

namespace forceshade::device::hdapi {

using namespace stand_in_hd;

namespace {

void print() {
  std::puts("InitLogFile : (null)");
  std::fflush(stdout);
}

// The device is this process's from now on.
bool take(Call& call) {
  Memory::Noted& noted = call.d.noted;
  if (call.d.device) call.breach("for a device that is initialised");
  if (!call.d.device && noted.initialised) {
    if (noted.pid != getpid() && lives(noted.pid)) return false;
    noted.scheduler = noted.output = false;
  }
  call.d.device = noted.initialised = true;
  noted.pid = getpid();
  noted.rate = call.d.rate;
  return true;
}

}  // namespace

extern "C" {

HHD hdInitDevice(const char* name) {
  block_if_told(Blocks::init_device);
  Due due;
  {
    Call call("hdInitDevice", Where::not_beside_scheduler);
    Driver& d = call.d;
    if (d.orders.prints) print();
    d.noted.named = name != nullptr;
    std::snprintf(d.noted.name.data(), d.noted.name.size(), "%s", name ? name : "");
    if (d.orders.init != kSuccess) {
      call.fail(d.orders.init);
      return kInvalidDevice;
    }
    if (d.orders.init_fails_silently) return kInvalidDevice;
    const Crash& crash = d.orders.crash;
    if (crash.when != Moment::before_start || crash.how != Crash::How::exception) {
      if (!take(call)) {
        call.fail(kAlreadyInitiated);
        return kInvalidDevice;
      }
      // No latency of its own: what comes late here is what the caller takes its time for.
      d.phantom = std::make_unique<Simulated>(d.model, Operator{Grip{}, strokes(), Tremor(1, 0.03), false},
                                              Simulated::Options{.latency = false});
    }
    due = stand_in_hd::due(d, Moment::before_start);
  }
  happen(due);
  return kDevice;
}

// Ends the force. Waits for a callback that runs, unless it runs on this very thread: then no frame may follow.
void hdDisableDevice(HHD) {
  block_if_told(Blocks::disable_device);
  const std::lock_guard waits(driver().ticking);
  Call call("hdDisableDevice", Where::anywhere);
  Driver& d = call.d;
  const bool is_last_resort = d.running && std::this_thread::get_id() == d.scheduler_id;
  if (!d.device) call.breach("without a device");
  if (!is_last_resort) {
    if (d.running) call.breach("while the scheduler runs");
    if (!d.callbacks.empty()) call.breach("with a callback scheduled");
    if (d.noted.output) call.breach("with the force output on");
  }
  if (d.phantom) obey(d, {0, 0, 0});
  d.device = d.noted.initialised = d.noted.output = false;
}

void hdBeginFrame(HHD device) {
  block_if_told(Blocks::begin_frame);
  std::chrono::milliseconds frame_time{0};
  {
    Call call("hdBeginFrame", Where::not_beside_scheduler);
    Driver& d = call.d;
    if (device != kDevice) return call.fail(kBadHandle);
    if (!d.device) call.breach("without a device");
    if (!d.running) call.breach("without a scheduler");
    if (d.in_frame || d.frames_this_tick++ > 0) {
      call.breach("twice in a tick");
      return call.fail(kIllegalBegin);
    }
    d.in_frame = true;
    d.force.setZero();
    ++d.frames;
    if (d.noted.output) ++d.frames_on;
    look(d);
    if (d.orders.output_goes_off) d.noted.output = false;
    if (d.orders.calibration_lost_at == d.frames) d.calibrated = false;
    frame_time = d.orders.frame_time;
    call.fail_in_frame(d.orders.begin);
    if (d.orders.comm_lost) call.fail_in_frame(kCommunication);
  }
  std::this_thread::sleep_for(frame_time);
}

void hdEndFrame(HHD) {
  Due due;
  {
    Call call("hdEndFrame", Where::in_frame);
    Driver& d = call.d;
    if (!d.in_frame) return call.fail(kIllegalEnd);
    d.in_frame = false;
    const double highest = d.orders.peak_force.value_or(kPeakForce);
    if (!d.force.allFinite()) call.breach("with a force that is not finite");
    if (d.force.norm() > highest * (1 + 1e-12)) call.breach("with more than the highest force");
    if (!d.noted.output && !d.force.isZero(0)) call.breach("with a force while the output is off");
    obey(d, d.noted.output ? d.force : Eigen::Vector3d(0, 0, 0));
    const bool contact = Eigen::Vector3d(d.noted.force).norm() > kContact;
    d.in_contact = contact ? d.in_contact + 1 : 0;
    if (contact) ++d.contacts;
    d.memory.frames[d.noted.frame_count % d.memory.frames.size()] = {
        .position = d.position, .force = d.force, .time = Clock::now(), .output = d.noted.output};
    ++d.noted.frame_count;
    for (const HDerror code : d.orders.end) call.fail_in_frame(code);
    due = stand_in_hd::due(d);
  }
  happen(due);
  block_if_told(Blocks::end_frame);
}

HDErrorInfo hdGetError() {
  Driver& d = driver();
  const Lock lock(d.memory);
  if (d.errors.empty()) return {};
  const HDErrorInfo last = d.errors.back().info;
  d.errors.pop_back();
  return last;
}

const char* hdGetErrorString(HDerror) {
  return "Some error.";
}

void hdEnable(HDenum what) {
  Call call("hdEnable", Where::not_beside_scheduler);
  if (what != kForceOutput) return call.fail(kInvalidEnum);
  if (!call.d.force.isZero(0)) call.breach("with a force set");
  call.d.noted.output = !call.d.orders.output_stays_off;
  call.d.frames_on = 0;
}

// The arm gets to know of it at the next tick: never, once the scheduler has stopped.
void hdDisable(HDenum what) {
  Call call("hdDisable", Where::not_beside_scheduler);
  if (what != kForceOutput) return call.fail(kInvalidEnum);
  call.d.noted.output = false;
}

void hdSetDoublev(HDenum what, const double* value) {
  Call call("hdSetDoublev", Where::in_frame);
  if (what != kForce) return call.fail(kInvalidEnum);
  call.d.force = {value[0], value[1], value[2]};
  call.fail_in_frame(call.d.orders.set);
}

HDenum hdCheckCalibration() {
  const Call call("hdCheckCalibration", Where::in_frame_if_running);
  const Orders& orders = call.d.orders;
  if (orders.calibration) return *orders.calibration;
  if (call.d.calibrated) return kCalibrated;
  const auto styles = static_cast<HDenum>(orders.styles);
  const bool ready = (styles & kCalibratesItself) != 0 || ((styles & kCalibratesInInkwell) != 0 && orders.in_inkwell);
  return ready ? kCalibrationNeedsUpdate : kCalibrationNeedsHand;
}

void hdUpdateCalibration(HDenum style) {
  Call call("hdUpdateCalibration", Where::in_frame_if_running);
  Driver& d = call.d;
  if ((style & static_cast<HDenum>(d.orders.styles)) == 0) return call.fail(kInvalidValue);
  ++d.noted.updates;
  if (!d.orders.update_helps) return;
  if (d.orders.calibration) d.orders.calibration = kCalibrated;
  d.calibrated = style == kCalibratesItself || (style == kCalibratesInInkwell && d.orders.in_inkwell) ||
                 (style == kCalibratesAtResetPose && d.orders.in_reset_pose);
}

void hdStartScheduler() {
  block_if_told(Blocks::start_scheduler);
  Call call("hdStartScheduler", Where::anywhere);
  Driver& d = call.d;
  if (d.running) call.breach("twice");
  d.starting = true;
  if (d.orders.start != kSuccess) return call.fail(d.orders.start);
  if (d.orders.prints) print();
  if (d.orders.steals_signals) std::signal(SIGTERM, [](int) { _exit(0); });
  if (d.phantom) d.phantom->start(meant_rate(d));
  d.stop = false;
  d.running = d.noted.scheduler = true;
  d.frames = d.frames_on = d.in_contact = d.contacts = 0;
  d.scheduler = std::thread(run);
  d.scheduler_id = d.scheduler.get_id();
  call.fail(d.orders.start_with_error);
}

void hdStopScheduler() {
  block_if_told(Blocks::stop_scheduler);
  Driver& d = driver();
  {
    Call call("hdStopScheduler", Where::anywhere);
    if (!d.starting) call.breach("before it was started");
    // A caller cannot send anything through a scheduler that hangs.
    if (!d.orders.hung && d.noted.output) call.breach("with the force output on");
    if (!d.orders.hung && !d.force.isZero(0)) call.breach("with a force sent last");
    d.stop = true;
  }
  if (d.scheduler.joinable()) d.scheduler.join();
  const Lock lock(d.memory);
  d.running = d.starting = d.noted.scheduler = false;
}

void hdSetSchedulerRate(HDulong hz) {
  Call call("hdSetSchedulerRate", Where::anywhere);
  call.fail(call.d.orders.rate);
  if (call.d.orders.rate == kSuccess) call.d.noted.rate = call.d.rate = static_cast<double>(hz);
}

HDSchedulerHandle hdScheduleAsynchronous(HDCallback function, void* data, HDushort) {
  Call call("hdScheduleAsynchronous", Where::anywhere);
  call.fail(call.d.orders.schedule);
  if (call.d.orders.schedule != kSuccess) return kInvalidSchedulerHandle;
  HDSchedulerHandle handle = 0;
  while (call.d.callbacks.contains(handle)) ++handle;
  call.d.callbacks[handle] = {function, data};
  return handle;
}

void hdUnschedule(HDSchedulerHandle handle) {
  Call call("hdUnschedule", Where::anywhere);
  if (call.d.callbacks.erase(handle) == 0) call.fail(kInvalidOperation);
}
}

}  // namespace forceshade::device::hdapi
