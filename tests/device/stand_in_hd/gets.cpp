// SPDX-License-Identifier: BSD-3-Clause
// The vendor's functions that get something.

#include <algorithm>
#include <cmath>
#include <csignal>
#include <initializer_list>
#include <limits>

#include "tests/device/stand_in_hd/driver.h"

namespace forceshade::device::hdapi {

using namespace stand_in_hd;

namespace {

// The nearest of the type's numbers, for one that it does not have.
template <typename T>
T to(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    constexpr auto kLow = static_cast<double>(std::numeric_limits<T>::lowest());
    if (!(value > kLow)) return std::numeric_limits<T>::lowest();
    return value >= -kLow ? std::numeric_limits<T>::max() : static_cast<T>(value);
  }
}

// Writes as many values as there are right ones.
template <typename T>
void give(Call& call, const Answer& answer, std::initializer_list<T> right, T* values) {
  switch (answer.how) {
    case Answer::How::right: std::copy(right.begin(), right.end(), values); break;
    case Answer::How::value: std::fill_n(values, right.size(), to<T>(answer.value)); break;
    case Answer::How::error: call.d.in_frame ? call.fail_in_frame(answer.error) : call.fail(answer.error); break;
    case Answer::How::nothing: break;
  }
}

}  // namespace

extern "C" {

// Without a device the vendor's library crashes.
HDboolean hdIsEnabled(HDenum what) {
  Call call("hdIsEnabled", Where::not_beside_scheduler);
  if (!call.d.device) std::raise(SIGSEGV);
  if (what != kForceOutput) call.fail(kInvalidEnum);
  return call.d.noted.output ? 1 : 0;
}

void hdGetBooleanv(HDenum what, HDboolean* value) {
  Call call("hdGetBooleanv", Where::in_frame_if_running);
  switch (what) {
    case kSafetySwitch: *value = call.d.orders.safety_switch ? 1 : 0; break;
    case kInkwellSwitch: *value = call.d.orders.in_inkwell ? 1 : 0; break;
    default: call.fail(kInvalidEnum);
  }
}

void hdGetIntegerv(HDenum what, int* value) {
  Call call("hdGetIntegerv", what == kButtons ? Where::in_frame : Where::not_beside_scheduler);
  const Orders& orders = call.d.orders;
  switch (what) {
    case kButtons: *value = 2; break;
    case kInputDegrees: return give(call, orders.input_degrees, {6}, value);
    case kOutputDegrees: *value = orders.output_degrees; break;
    case kCalibrationStyles: *value = orders.styles; break;
    case kUpdateRate: return give(call, orders.update_rate, {1000}, value);
    case kInstantaneousRate: return give(call, orders.instantaneous_rate, {counted_rate(call.d)}, value);
    default: call.fail(kInvalidEnum);
  }
}

void hdGetLongv(HDenum what, HDlong* value) {
  Call call("hdGetLongv", Where::in_frame);
  if (what != kEncoders) return call.fail(kInvalidEnum);
  const auto& e = call.d.encoder;
  give(call, call.d.orders.encoders, {e[0], e[1], e[2], e[3], e[4], e[5]}, value);
}

void hdGetDoublev(HDenum what, double* value) {
  const bool of_state = what == kPosition || what == kJointAngles || what == kGimbalAngles || what == kMotorTemperature;
  Call call("hdGetDoublev", of_state ? Where::in_frame : Where::not_beside_scheduler);
  const Driver& d = call.d;
  const Orders& orders = d.orders;
  // As the vendor's library does, which reports nothing.
  if (!d.device) return void(*value = -11);
  switch (what) {
    case kPosition:
      if (orders.withholds_position) return;
      call.fail_in_frame(orders.get_position);
      if (orders.get_position == kSuccess) std::copy(d.position.begin(), d.position.end(), value);
      return;
    case kJointAngles: return give(call, orders.joint_angles, {d.joints[0], d.joints[1], d.joints[2]}, value);
    case kGimbalAngles: return give(call, {}, {0.1, 0.2, 0.3}, value);
    case kMotorTemperature:
      if (orders.output_degrees == 3) return give(call, orders.temperature, {0.125, 0.25, 0.0625}, value);
      return give(call, orders.temperature, {0.125, 0.25, 0.0625, 0.03125, 0.03125, 0.03125}, value);
    case kUsableWorkspace: return give(call, orders.workspace, {-190., -95., -130., 191., 96., 137.}, value);
    case kMaxForce: return give(call, orders.peak_force, {kPeakForce}, value);
    case kContinuousForce: return give(call, orders.continuous_force, {1.4}, value);
    case kVelocityLimit: return give(call, orders.velocity_limit, {1500.}, value);
    case kImpulseLimit: return give(call, orders.impulse_limit, {4.}, value);
    default: call.fail(kInvalidEnum);
  }
}

const char* hdGetString(HDenum what) {
  Call call("hdGetString", Where::not_beside_scheduler);
  switch (what) {
    case kVersion: return "3.4.0";
    case kModel: return "Stand-in 1.5";
    case kDriverVersion: return "4.3.3";
    case kVendor: return "Nobody";
    case kSerialNumber: return "S-0042";
    case kFirmware: return "192";
    default: call.fail(kInvalidEnum); return nullptr;
  }
}
}

}  // namespace forceshade::device::hdapi
