// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/phantom_frames.h"

#include <limits>

namespace forceshade::device {
namespace {

// All joints at zero, as an uncalibrated Omni or Touch says; a calibrated one gets within a step of its encoders (0.055 mm)
// of it only by chance, and not for long.
const Eigen::Vector3d kUncalibratedPose{0, -110, -35};  // mm
constexpr double kExactly = 1e-3;                       // mm: the driver computes in binary32 here and there

// So that a get that fails cannot pass for a position.
const Eigen::Vector3d kUnknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

}  // namespace

unsigned PhantomFrames::tick(void* self) noexcept {
  auto& frames = *static_cast<PhantomFrames*>(self);
  frames.frame(frames.orders.latest());
  frames.samples.publish(frames.sample_);
  return hdapi::kCallbackContinue;  // also after trouble: zero is to be sent on
}

void PhantomFrames::note(const char* words) noexcept {
  if (!sample_.trouble) sample_.trouble.words = words;
}

bool PhantomFrames::went_well(const char* step) noexcept {
  return went_well(step, hdapi::drained(hd_));
}

bool PhantomFrames::went_well(const char* step, const hdapi::HDErrorInfo& error) noexcept {
  if (error.code == hdapi::kSuccess) return true;
  if (!sample_.trouble) sample_.trouble = {step, error, hd_.hdGetErrorString(error.code)};
  return false;
}

// For what not every model has: the driver then says that it does not know what it is asked for, and is not asked again.
bool PhantomFrames::known_and_well(const char* step, bool& known) noexcept {
  const hdapi::HDErrorInfo error = hdapi::drained(hd_);
  known = error.code < hdapi::kInvalidEnum || error.code > hdapi::kInvalidInputType;
  return known && went_well(step, error);
}

void PhantomFrames::frame(const Order& order) noexcept {
  sample_.time = Clock::now();
  hd_.hdBeginFrame(device_);
  if (went_well("beginning a frame")) measure();
  if (sample_.phase == Phase::settling && !sample_.trouble) check_calibration();
  const bool pushes = !order.force.isZero(0);
  if (pushes && sample_.time - order.time > patience_) note(hdapi::kStalled);

  const auto stopping = [&] { return order.close || sample_.trouble; };
  const bool obeys = sample_.phase == Phase::ready && sample_.forces_on && !stopping();
  const Eigen::Vector3d force = obeys ? order.force : Eigen::Vector3d::Zero();
  hd_.hdSetDoublev(hdapi::kForce, force.data());
  went_well("setting the force");
  hd_.hdEndFrame(device_);
  went_well("ending a frame");

  // After the frame: when the output goes on, or off as planned, zero has been sent. After trouble it goes off at once, and the
  // next frame sends the zero.
  if (stopping() && sample_.phase != Phase::closed) {
    hd_.hdDisable(hdapi::kForceOutput);
    went_well("switching the force output off");
    sample_.forces_on = false;
    if (force.isZero(0)) sample_.phase = Phase::closed;
  } else if (sample_.phase == Phase::settling && ++good_frames_ >= kSettling) {
    switch_on();
  }
}

void PhantomFrames::measure() noexcept {
  sample_.position = kUnknown;
  hd_.hdGetDoublev(hdapi::kPosition, sample_.position.data());
  went_well("reading the position");
  hd_.hdGetIntegerv(hdapi::kButtons, &sample_.buttons);
  went_well("reading the buttons");
  if (has_gimbal_) {
    hd_.hdGetDoublev(hdapi::kGimbalAngles, sample_.gimbal.data());
    went_well("reading the gimbal");
  }
  if (has_temperature_) {
    Eigen::Vector3d temperatures{0, 0, 0};
    hd_.hdGetDoublev(hdapi::kMotorTemperature, temperatures.data());
    if (known_and_well("reading the motors' temperatures", has_temperature_)) sample_.temperature = temperatures.maxCoeff();
  }
  if (has_encoders_) {
    std::array<hdapi::HDlong, 6> counts{};
    hd_.hdGetLongv(hdapi::kEncoders, counts.data());
    sample_.encoder.reset();
    if (known_and_well("reading the encoders", has_encoders_)) sample_.encoder = {counts[0], counts[1], counts[2]};
  }
  if (sample_.phase == Phase::ready) {
    sample_.forces_on = hd_.hdIsEnabled(hdapi::kForceOutput) != 0;
    went_well("asking whether the force output is on");
  }
  if (!sample_.position.allFinite()) note(hdapi::kNotFinite);
  const bool there = (sample_.position - kUncalibratedPose).cwiseAbs().maxCoeff() <= kExactly;
  at_uncalibrated_pose_ = there ? at_uncalibrated_pose_ + 1 : 0;
  if (at_uncalibrated_pose_ >= kSettling) note(hdapi::kUncalibratedPose);
}

void PhantomFrames::check_calibration() noexcept {
  const hdapi::HDenum status = hd_.hdCheckCalibration();
  if (!went_well("checking the calibration")) return;
  sample_.calibrated = status == hdapi::kCalibrated;
  if (sample_.calibrated) return;
  if (status != hdapi::kCalibrationNeedsUpdate || updated_calibration_) return note(hdapi::kNotCalibrated);

  // The driver has what it needs, as when the stylus is in its inkwell. At the reset pose only the user can know.
  int styles = 0;
  hd_.hdGetIntegerv(hdapi::kCalibrationStyles, &styles);
  if (!went_well("asking how the device is calibrated")) return;
  const hdapi::HDenum known = static_cast<hdapi::HDenum>(styles) & (hdapi::kCalibratesInInkwell | hdapi::kCalibratesItself);
  if (known == 0) return note(hdapi::kNotCalibrated);
  hd_.hdUpdateCalibration((known & hdapi::kCalibratesInInkwell) != 0 ? hdapi::kCalibratesInInkwell : hdapi::kCalibratesItself);
  went_well("updating the calibration");
  updated_calibration_ = true;
  good_frames_ = 0;
}

void PhantomFrames::switch_on() noexcept {
  hd_.hdEnable(hdapi::kForceOutput);
  if (!went_well("switching the force output on")) return;
  sample_.forces_on = hd_.hdIsEnabled(hdapi::kForceOutput) != 0;
  if (!went_well("asking whether the force output is on")) return;
  if (!sample_.forces_on) return note(hdapi::kOutputStaysOff);
  sample_.phase = Phase::ready;
}

}  // namespace forceshade::device
