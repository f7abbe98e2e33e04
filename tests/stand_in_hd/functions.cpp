// SPDX-License-Identifier: BSD-3-Clause
// The vendor's functions.

#include <algorithm>
#include <initializer_list>

#include "forceshade/tests/stand_in_hd/driver.h"

namespace forceshade::device::hdapi {

using stand_in_hd::Call;
using stand_in_hd::Driver;
using stand_in_hd::driver;
using stand_in_hd::kDevice;
using stand_in_hd::obey;
using stand_in_hd::Where;

extern "C" {

HHD hdInitDevice(const char* name) {
  Call call("hdInitDevice", Where::not_beside_scheduler);
  Driver& d = call.d;
  d.seen.name = name ? std::optional<std::string>(name) : std::nullopt;
  if (d.seen.initialised) call.breach("for a device that is initialised");
  if (d.orders.init != kSuccess) {
    call.fail(d.orders.init);
    return kInvalidDevice;
  }
  if (d.orders.init_fails_silently) return kInvalidDevice;
  d.seen.initialised = true;
  // No latency of its own: what comes late here is what the caller takes its time for.
  d.phantom = std::make_unique<Simulated>(premium_1_5(), Operator{Grip{}, strokes(), Tremor(1, 0.03), false},
                                          Simulated::Options{.latency = false});
  return kDevice;
}

void hdDisableDevice(HHD) {
  Call call("hdDisableDevice", Where::anywhere);
  if (!call.d.seen.initialised) call.breach("without a device");
  if (call.d.seen.scheduler) call.breach("while the scheduler runs");
  if (!call.d.callbacks.empty()) call.breach("with a callback scheduled");
  if (call.d.seen.output) call.breach("with the force output on");
  call.d.seen.initialised = false;
}

void hdBeginFrame(HHD device) {
  Call call("hdBeginFrame", Where::not_beside_scheduler);
  Driver& d = call.d;
  if (device != kDevice) return call.fail(kBadHandle);
  if (!d.seen.scheduler) call.breach("without a scheduler");
  if (d.in_frame || d.frames_this_tick++ > 0) {
    call.breach("twice in a tick");
    return call.fail(kIllegalBegin);
  }
  d.in_frame = true;
  d.force.setZero();
  const auto reading = std::get<Reading>(d.phantom->read());
  d.position = turned_to_arm(reading.position.cast<double>());
  std::copy(reading.encoder->begin(), reading.encoder->end(), d.encoder.begin());
  if (d.orders.position) d.position = *d.orders.position;
  if (d.orders.output_goes_off) d.seen.output = false;
  std::this_thread::sleep_for(d.orders.frame_time);
  call.fail(d.orders.begin);
}

void hdEndFrame(HHD) {
  Call call("hdEndFrame", Where::in_frame);
  Driver& d = call.d;
  if (!d.in_frame) return call.fail(kIllegalEnd);
  d.in_frame = false;
  if (!d.force.allFinite()) call.breach("with a force that is not finite");
  if (d.force.norm() > d.orders.peak_force * (1 + 1e-12)) call.breach("with more than the highest force");
  if (!d.seen.output && !d.force.isZero(0)) call.breach("with a force while the output is off");
  obey(d, d.seen.output ? d.force : Eigen::Vector3d(0, 0, 0));
  d.seen.frames.push_back({d.position, d.force});
  for (const HDerror code : d.orders.end) call.fail(code);
}

HDErrorInfo hdGetError() {
  const std::lock_guard lock(driver().mutex);
  auto& errors = driver().errors;
  if (errors.empty()) return {};
  const HDErrorInfo last = errors.back();
  errors.pop_back();
  return last;
}

const char* hdGetErrorString(HDerror) {
  return "Some error.";
}

void hdEnable(HDenum what) {
  Call call("hdEnable", Where::not_beside_scheduler);
  if (what != kForceOutput) return call.fail(kInvalidEnum);
  if (!call.d.force.isZero(0)) call.breach("with a force set");
  call.d.seen.output = !call.d.orders.output_stays_off;
}

void hdDisable(HDenum what) {
  Call call("hdDisable", Where::not_beside_scheduler);
  if (what != kForceOutput) return call.fail(kInvalidEnum);
  call.d.seen.output = false;
  if (call.d.phantom) obey(call.d, {0, 0, 0});
}

HDboolean hdIsEnabled(HDenum what) {
  Call call("hdIsEnabled", Where::not_beside_scheduler);
  if (what != kForceOutput) call.fail(kInvalidEnum);
  return call.d.seen.output ? 1 : 0;
}

void hdGetIntegerv(HDenum what, int* value) {
  Call call("hdGetIntegerv", what == kButtons ? Where::in_frame : Where::not_beside_scheduler);
  switch (what) {
    case kButtons: *value = 2; break;
    case kInputDegrees: *value = call.d.orders.input_degrees; break;
    case kCalibrationStyles: *value = call.d.orders.styles; break;
    case kUpdateRate: *value = 1000; break;
    default: call.fail(kInvalidEnum);
  }
}

void hdGetLongv(HDenum what, HDlong* value) {
  Call call("hdGetLongv", Where::in_frame);
  if (what != kEncoders) return call.fail(kInvalidEnum);
  call.fail(call.d.orders.get_encoders);
  if (call.d.orders.get_encoders == kSuccess) std::copy(call.d.encoder.begin(), call.d.encoder.end(), value);
}

void hdGetDoublev(HDenum what, double* value) {
  const bool of_state = what == kPosition || what == kGimbalAngles || what == kMotorTemperature;
  Call call("hdGetDoublev", of_state ? Where::in_frame : Where::not_beside_scheduler);
  const stand_in_hd::Orders& orders = call.d.orders;
  const auto give = [&](std::initializer_list<double> values) { std::copy(values.begin(), values.end(), value); };
  const auto give_or = [&](HDerror error, std::initializer_list<double> values) {
    call.fail(error);
    if (error == kSuccess) give(values);
  };
  const Eigen::Vector3d& p = call.d.position;
  switch (what) {
    case kPosition:
      if (orders.withholds_position) return;
      return give_or(orders.get_position, {p.x(), p.y(), p.z()});
    case kGimbalAngles: return give({0.1, 0.2, 0.3});
    case kMotorTemperature: return give_or(orders.get_temperature, {0.125, orders.temperature, 0.0625});
    case kUsableWorkspace: return give({-190, -95, -130, 191, 96, 137});
    case kMaxForce: return give_or(orders.peak, {orders.peak_force});
    case kContinuousForce: return give({1.4});
    default: call.fail(kInvalidEnum);
  }
}

void hdSetDoublev(HDenum what, const double* value) {
  Call call("hdSetDoublev", Where::in_frame);
  if (what != kForce) return call.fail(kInvalidEnum);
  call.d.force = {value[0], value[1], value[2]};
  call.fail(call.d.orders.set);
}

const char* hdGetString(HDenum what) {
  Call call("hdGetString", Where::not_beside_scheduler);
  if (what == kModel) return "Stand-in 1.5";
  call.fail(kInvalidEnum);
  return nullptr;
}

HDenum hdCheckCalibration() {
  Call call("hdCheckCalibration", Where::in_frame);
  return call.d.orders.calibration;
}

void hdUpdateCalibration(HDenum style) {
  Call call("hdUpdateCalibration", Where::in_frame);
  if ((style & static_cast<HDenum>(call.d.orders.styles)) == 0) return call.fail(kInvalidValue);
  ++call.d.seen.updates;
  if (call.d.orders.update_helps) call.d.orders.calibration = kCalibrated;
}

void hdStartScheduler() {
  Call call("hdStartScheduler", Where::anywhere);
  Driver& d = call.d;
  if (d.seen.scheduler) call.breach("twice");
  if (d.orders.start != kSuccess) return call.fail(d.orders.start);
  if (d.phantom) d.phantom->start(d.seen.rate);
  d.stop = false;
  d.seen.scheduler = true;
  d.scheduler = std::thread(stand_in_hd::run, d.seen.rate);
  d.scheduler_id = d.scheduler.get_id();
}

void hdStopScheduler() {
  Driver& d = driver();
  {
    Call call("hdStopScheduler", Where::anywhere);
    if (!d.seen.scheduler) call.breach("before it was started");
    // A caller cannot send anything through a scheduler that hangs.
    if (!d.orders.hung && d.seen.output) call.breach("with the force output on");
    if (!d.orders.hung && !d.force.isZero(0)) call.breach("with a force sent last");
    d.stop = true;
  }
  if (d.scheduler.joinable()) d.scheduler.join();
  const std::lock_guard lock(d.mutex);
  d.seen.scheduler = false;
}

void hdSetSchedulerRate(HDulong hz) {
  Call call("hdSetSchedulerRate", Where::anywhere);
  call.fail(call.d.orders.rate);
  if (call.d.orders.rate == kSuccess) call.d.seen.rate = static_cast<double>(hz);
}

HDSchedulerHandle hdScheduleAsynchronous(HDCallback function, void* data, HDushort) {
  Call call("hdScheduleAsynchronous", Where::anywhere);
  call.fail(call.d.orders.schedule);
  if (call.d.orders.schedule != kSuccess) return kInvalidSchedulerHandle;
  call.d.callbacks[call.d.next_handle] = {function, data};
  return call.d.next_handle++;
}

void hdUnschedule(HDSchedulerHandle handle) {
  Call call("hdUnschedule", Where::anywhere);
  if (call.d.callbacks.erase(handle) == 0) call.fail(kInvalidValue);
}
}

}  // namespace forceshade::device::hdapi
