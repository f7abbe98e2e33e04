// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom_frames.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "system/system.h"

namespace forceshade::device {
namespace {

// All joints at zero, as an uncalibrated Omni or Touch says; a calibrated one gets within a step of its encoders (0.055 mm)
// of it only by chance, and not for long.
const Eigen::Vector3d kUncalibratedPose{0, -110, -35};  // mm
constexpr double kExactly = 1e-3;                       // mm: the driver computes in binary32 here and there
constexpr int kFrozen = 50;                             // frames at that pose
constexpr int kSilent = 100;                            // frames at half the rate or less, by the driver's own count
constexpr int kBetweenUpdates = 100;                    // frames
constexpr int kSwitched = 50;  // frames without force after the safety switch has changed: for the servo loop to see one

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  // so that a get that fails cannot pass for a value
constexpr std::size_t kMostDegrees = 16;  // more than any device has, for a driver that writes more

}  // namespace

unsigned PhantomFrames::tick(void* self) noexcept {
  auto& frames = *static_cast<PhantomFrames*>(self);
  frames.frame();
  frames.samples.publish(frames.sample_);
  frames.shared_.samples.publish(frames.sample_);
  if (frames.sample_.phase == Phase::closed) frames.closed_ = true;
  return hdapi::kCallbackContinue;  // also after trouble: zero is to be sent on
}

void PhantomFrames::abandon() noexcept {
  if (closed_ || abandoned_.exchange(true)) return;
  hd_.hdDisableDevice(device_);
  closed_ = true;
}

void PhantomFrames::note(const hdapi::Trouble& trouble) noexcept {
  if (sample_.troubled) return;
  sample_.troubled = true;
  std::array<char, 512> room{};
  std::snprintf(shared_.trouble.data(), shared_.trouble.size(), "%s", hdapi::sentence(trouble, room));
}

bool PhantomFrames::went_well(const char* step) noexcept {
  return went_well(step, hdapi::drained(hd_));
}

bool PhantomFrames::went_well(const char* step, const hdapi::HDErrorInfo& error) noexcept {
  if (error.code == hdapi::kSuccess) return true;
  note({step, error, hd_.hdGetErrorString(error.code)});
  return false;
}

// For what not every model has: the driver then gives an error of its own for that, and is not asked for it again.
bool PhantomFrames::known_and_well(const char* step, bool& known) noexcept {
  const hdapi::HDErrorInfo error = hdapi::drained(hd_);
  known = error.code < hdapi::kInvalidEnum || error.code > hdapi::kInvalidInputType;
  return known && went_well(step, error);
}

void PhantomFrames::frame() noexcept {
  sample_.time = system::now();
  const auto window = times_.add(sample_.time);
  if (window) sample_.times = window;
  hd_.hdBeginFrame(device_);
  if (went_well("beginning a frame")) measure();
  if (!sample_.troubled && sample_.phase != Phase::closed) {
    watch_calibration();
    watch_rate();
  }

  const ForceOrder& order = shared_.orders.latest();
  const std::int64_t age = sample_.time - order.time;
  if (!order.force.isZero(0) && age > settings_.watchdog_timeout.count()) note({hdapi::kStalled});
  const auto stopping = [&] { return closing_ || sample_.troubled; };
  const bool obeys = sample_.phase == Phase::ready && sample_.forces_on && !stopping();
  sent_.allow(order.allowance);
  sent_.arrived(sample_.position);
  Eigen::Vector3d wanted{0, 0, 0};
  if (obeys) wanted = order.force * share_.next(age);
  const Eigen::Vector3d force = sent_.send(wanted);
  share_.acts(order.force, force);
  sample_.sent = report_of(sent_, share_);
  hd_.hdSetDoublev(hdapi::kForce, force.data());
  went_well("setting the force");
  hd_.hdEndFrame(device_);
  went_well("ending a frame");

  // After the frame: when the output goes on, or off as planned, zero has been sent. After trouble it goes off at once, or
  // when the next frame begins, and that frame sends the zero.
  if (stopping() && sample_.phase != Phase::closed) {
    hd_.hdDisable(hdapi::kForceOutput);
    went_well("switching the force output off");
    sample_.forces_on = false;
    if (force.isZero(0)) sample_.phase = Phase::closed;
  } else if (sample_.phase == Phase::settling && window && is_good()) {
    switch_on();
  }
}

void PhantomFrames::measure() noexcept {
  sample_.position.setConstant(kUnknown);
  hd_.hdGetDoublev(hdapi::kPosition, sample_.position.data());
  went_well("reading the position");
  hd_.hdGetIntegerv(hdapi::kButtons, &sample_.buttons);
  went_well("reading the buttons");
  if (settings_.gimbal) {
    sample_.gimbal.setConstant(kUnknown);
    hd_.hdGetDoublev(hdapi::kGimbalAngles, sample_.gimbal.data());
    went_well("reading the gimbal");
  }
  if (sample_.has_temperature) {
    std::array<double, kMostDegrees> temperatures{};
    temperatures[0] = kUnknown;
    hd_.hdGetDoublev(hdapi::kMotorTemperature, temperatures.data());
    if (known_and_well("reading the motors' temperatures", sample_.has_temperature)) {
      const auto is_one = [](double t) { return std::isfinite(t) && t >= 0; };
      if (!std::all_of(temperatures.begin(), temperatures.end(), is_one)) note({hdapi::kNoTemperature});
      sample_.temperature = *std::max_element(temperatures.begin(), temperatures.end());
    }
  }
  if (has_encoders_) {
    std::array<hdapi::HDlong, kMostDegrees> counts{};
    hd_.hdGetLongv(hdapi::kEncoders, counts.data());
    sample_.encoder.reset();
    if (known_and_well("reading the encoders", has_encoders_)) sample_.encoder = {counts[0], counts[1], counts[2]};
  }
  if (has_joints_) {
    std::array<double, kMostDegrees> angles{};
    hd_.hdGetDoublev(hdapi::kJointAngles, angles.data());
    sample_.joints.reset();
    if (known_and_well("reading the joint angles", has_joints_)) sample_.joints = {angles[0], angles[1], angles[2]};
  }
  if (sample_.phase == Phase::ready && settings_.force) {
    const bool is_on = hd_.hdIsEnabled(hdapi::kForceOutput) != 0;
    went_well("reading whether the force output is on");
    sample_.forces_on = is_on && !is_switched();
  }
  if (!sample_.position.allFinite()) note({hdapi::kNotFinite});
  const bool there = (sample_.position - kUncalibratedPose).cwiseAbs().maxCoeff() <= kExactly;
  at_uncalibrated_pose_ = there ? at_uncalibrated_pose_ + 1 : 0;
  if (at_uncalibrated_pose_ >= kFrozen) note({hdapi::kUncalibratedPose});
}

// The driver says whether the output should be on, also while a switch of the device keeps it off. Which of the switch's two
// values lets forces through depends on the device, but either way they begin anew, gently, after it has changed.
bool PhantomFrames::is_switched() noexcept {
  hdapi::HDboolean value = 0;
  if (has_switch_) {
    hd_.hdGetBooleanv(hdapi::kSafetySwitch, &value);
    if (!known_and_well("reading the safety switch", has_switch_)) value = 0;
  }
  if (switch_ && *switch_ != value) frames_switched_ = kSwitched;
  switch_ = value;
  if (frames_switched_ == 0) return false;
  --frames_switched_;
  return true;
}

// While it settles the user has time to do what the device needs; later only a driver that calibrates a moving device by itself
// is let do so, and not under force, since the position then jumps.
void PhantomFrames::watch_calibration() noexcept {
  const hdapi::HDenum status = hd_.hdCheckCalibration();
  if (!went_well("checking the calibration")) return;
  sample_.calibrated = status == hdapi::kCalibrated;
  ++since_update_;
  if (sample_.calibrated) return;
  times_.restart();
  const bool may =
      sample_.phase == Phase::settling || (settings_.style == hdapi::kCalibratesItself && sent_.report().acting.isZero(0));
  if (status != hdapi::kCalibrationNeedsUpdate || settings_.style == 0 || !may || since_update_ < kBetweenUpdates) return;
  since_update_ = 0;
  hd_.hdUpdateCalibration(settings_.style);
  went_well("updating the calibration");
}

// A driver reports a lost connection once, and only to the first call that reads errors; from then on the position stands
// still.
void PhantomFrames::watch_rate() noexcept {
  if (!sample_.has_rate) return;
  int rate = 0;
  hd_.hdGetIntegerv(hdapi::kInstantaneousRate, &rate);
  if (!known_and_well("reading the device's update rate", sample_.has_rate)) return;
  sample_.update_rate = rate;
  silent_frames_ = rate < settings_.rate / 2 ? silent_frames_ + 1 : 0;
  sample_.answers = silent_frames_ == 0;
  if (sample_.phase == Phase::ready && silent_frames_ >= kSilent) note({hdapi::kNoAnswer});
}

bool PhantomFrames::is_good() const noexcept {
  const FrameTimes::Window& seen = *sample_.times;
  return !sample_.troubled && sample_.calibrated && sample_.answers &&
         std::fabs(seen.rate - settings_.rate) <= settings_.rate_tolerance * settings_.rate &&
         seen.longest_gap <= settings_.longest_gap;
}

void PhantomFrames::switch_on() noexcept {
  if (settings_.force) {
    hd_.hdEnable(hdapi::kForceOutput);
    if (!went_well("switching the force output on")) return;
    sample_.forces_on = hd_.hdIsEnabled(hdapi::kForceOutput) != 0;
    if (!went_well("reading whether the force output is on")) return;
    if (!sample_.forces_on) return note({hdapi::kOutputStaysOff});
  }
  sample_.phase = Phase::ready;
}

}  // namespace forceshade::device
