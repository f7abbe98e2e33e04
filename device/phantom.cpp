// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/phantom.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "forceshade/device/arm.h"
#include "forceshade/device/open_device.h"

namespace forceshade::device {
namespace {

std::atomic<bool> in_use = false;

constexpr std::chrono::milliseconds kPoll{1}, kClosing{200};

// Words of a fault live as long as the program, so that a result can be told after its device is gone.
std::array<char, 512>* room_for_words() {
  static std::mutex mutex;
  static std::deque<std::array<char, 512>> rooms;
  const std::lock_guard lock(mutex);
  return &rooms.emplace_back();
}

}  // namespace

Phantom::Turn::Turn() {
  if (in_use.exchange(true))
    throw DeviceError("this program drives a PHANToM already, and the driver has one scheduler for all");
}

Phantom::Turn::~Turn() {
  in_use = false;
}

bool Phantom::went_well(const char* step) noexcept {
  const hdapi::HDErrorInfo error = hdapi::drained(hd_);
  if (error.code == hdapi::kSuccess) return true;
  if (!trouble_) trouble_ = {step, error, hd_.hdGetErrorString(error.code)};
  return false;
}

Fault Phantom::fault() noexcept {
  return Fault{hdapi::sentence(trouble_, *room_)};
}

Phantom::Phantom(const std::string& name, const Options& options)
    : Phantom(name, options, []() -> Attendant& {
        static Attendant nobody;
        return nobody;
      }()) {}

Phantom::Phantom(const std::string& name, const Options& options, Attendant&)
    : hd_(hdapi::vendor()), options_(options), room_(room_for_words()) {
  // Of whoever used the driver before.
  hdapi::drained(hd_);
  device_ = hd_.hdInitDevice(name.empty() ? nullptr : name.c_str());
  if (!went_well("initialising the PHANToM") || device_ == hdapi::kInvalidDevice) {
    if (!trouble_) trouble_.words = "initialising the PHANToM failed, and the driver says no more";
    throw DeviceError(hdapi::initialisation_advice(name, trouble_));
  }
  try {
    ask_what_it_can();
  } catch (...) {
    hd_.hdDisableDevice(device_);
    hdapi::drained(hd_);
    throw;
  }
}

// Whether the driver knew what it was just asked; what it does not know stays unlimited.
bool Phantom::known() noexcept {
  return hdapi::drained(hd_).code == hdapi::kSuccess;
}

void Phantom::ask_what_it_can() {
  const char* model = hd_.hdGetString(hdapi::kModel);
  if (known() && model) model_ = model;
  capabilities_.model = model_;
  capabilities_.latency = true;       // of a frame, now and then of two
  capabilities_.buttons = 4;          // as many as the driver has bits for; it does not say how many there are
  capabilities_.resolution = 0.055F;  // the driver does not say; the coarsest sheet's, Omni's and Touch's

  std::array<double, 6> box{};
  hd_.hdGetDoublev(hdapi::kUsableWorkspace, box.data());
  if (known()) {
    const Eigen::Vector3d a = turned_to_law({box[0], box[1], box[2]}), b = turned_to_law({box[3], box[4], box[5]});
    capabilities_.workspace_low = a.cwiseMin(b).cast<float>();
    capabilities_.workspace_high = a.cwiseMax(b).cast<float>();
  }
  double continuous = 0;
  hd_.hdGetDoublev(hdapi::kContinuousForce, &continuous);
  if (known()) capabilities_.continuous_force = static_cast<float>(continuous);
  int degrees = 0;
  hd_.hdGetIntegerv(hdapi::kInputDegrees, &degrees);
  capabilities_.gimbal = known() && degrees >= 6;
  hd_.hdGetIntegerv(hdapi::kUpdateRate, &update_rate_);
  if (known()) capabilities_.highest_rate = update_rate_;

  // Without this one there would be no clamp.
  double peak = 0;
  hd_.hdGetDoublev(hdapi::kMaxForce, &peak);
  if (!went_well("asking for the PHANToM's highest force")) throw DeviceError(fault().words);
  if (!(peak > 0 && std::isfinite(peak)))
    throw DeviceError("the PHANToM's highest force: expected a positive number, got " + std::to_string(peak) + " N");
  capabilities_.peak_force = static_cast<float>(peak);
  frames_ = std::make_unique<PhantomFrames>(hd_, device_, capabilities_.gimbal, options_.patience);
}

Phantom::~Phantom() {
  PhantomFrames::Phase phase = PhantomFrames::Phase::closed;
  if (running_) {
    frames_->orders.publish({.time = Clock::now(), .close = true});
    const auto deadline = Clock::now() + kClosing;
    while ((phase = frames_->samples.latest().phase) != PhantomFrames::Phase::closed && Clock::now() < deadline)
      std::this_thread::sleep_for(kPoll);
    hd_.hdStopScheduler();
    hdapi::drained(hd_);
  }
  // The scheduler ran no more frames; now that it is stopped, this thread may switch the output off.
  const bool hung = phase != PhantomFrames::Phase::closed;
  if (hung) {
    hd_.hdDisable(hdapi::kForceOutput);
    hdapi::drained(hd_);
  }
  if (callback_ != hdapi::kInvalidSchedulerHandle) {
    hd_.hdUnschedule(callback_);
    hdapi::drained(hd_);
  }
  hd_.hdDisableDevice(device_);
  hdapi::drained(hd_);
  // A driver that hung may come to and call back after all.
  static auto& kept = *new std::deque<std::unique_ptr<PhantomFrames>>;  // NOLINT(bugprone-unhandled-exception-at-new)
  if (hung) kept.push_back(std::move(frames_));
}

std::optional<Fault> Phantom::start(double rate) noexcept {
  if (running_ || trouble_) return Fault{"the PHANToM was started before"};
  if (const auto hz = std::lround(rate); hz != update_rate_) {
    hd_.hdSetSchedulerRate(static_cast<hdapi::HDulong>(hz));
    if (!went_well("setting the driver's rate (most devices know 1000 and 500 Hz)")) return fault();
  }
  callback_ = hd_.hdScheduleAsynchronous(&PhantomFrames::tick, frames_.get(), hdapi::kDefaultPriority);
  if (!went_well("scheduling the frames")) return fault();
  hd_.hdStartScheduler();
  if (!went_well("starting the driver's scheduler")) return fault();
  running_ = true;

  const auto deadline = Clock::now() + options_.start;
  while (Clock::now() < deadline) {
    const PhantomFrames::Sample& sample = frames_->samples.latest();
    trouble_ = sample.trouble;
    if (trouble_) return fault();
    if (sample.phase == PhantomFrames::Phase::ready) {
      first_ = sample.time;
      return std::nullopt;
    }
    std::this_thread::sleep_for(kPoll);
  }
  trouble_.words = frames_->samples.latest().time == Clock::time_point{} ? hdapi::kNoFrames : hdapi::kNotReady;
  return fault();
}

ReadResult Phantom::read() noexcept {
  if (!running_ && !trouble_) return Fault{"the PHANToM was not started"};
  if (trouble_) return fault();
  const PhantomFrames::Sample& sample = frames_->samples.latest();
  state_ = {
      .calibrated = sample.calibrated, .forces_on = sample.forces_on, .temperature = static_cast<float>(sample.temperature)};
  trouble_ = sample.trouble;
  if (!trouble_ && Clock::now() - sample.time > options_.patience) trouble_.words = hdapi::kSilent;
  if (trouble_) return fault();
  Reading reading{.position = turned_to_law(sample.position).cast<float>(),
                  .time = std::chrono::duration<double>(sample.time - first_).count(),
                  .buttons = static_cast<std::uint16_t>(sample.buttons)};
  if (capabilities_.gimbal) reading.gimbal = sample.gimbal.cast<float>();
  reading.encoder = sample.encoder;
  return reading;
}

std::optional<Fault> Phantom::command(const Eigen::Vector3f& force) noexcept {
  const bool finite = force.allFinite();
  Eigen::Vector3d limited = Eigen::Vector3d::Zero();
  if (finite) limited = turned_to_arm(force.cast<double>());
  const double size = limited.norm(), highest = static_cast<double>(capabilities_.peak_force);
  if (size > highest) limited *= highest / size;
  if (running_) frames_->orders.publish({.force = limited, .time = Clock::now()});
  if (!finite) return Fault{"a force that is not finite was commanded"};
  return std::nullopt;
}

std::unique_ptr<Device> open_phantom(const std::string& name, Attendant& attendant, Forces forces) {
  return std::make_unique<Phantom>(name, Phantom::Options{.force = forces == Forces::as_commanded}, attendant);
}

}  // namespace forceshade::device
