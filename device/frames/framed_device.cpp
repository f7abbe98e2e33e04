// SPDX-License-Identifier: BSD-3-Clause
#include "device/frames/framed_device.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "device/shortened.h"
#include "files/csv.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

constexpr std::chrono::milliseconds kPollFrames{5};

Capabilities capabilities_of(const FramedDescription& description) {
  Capabilities its = description.capabilities;
  its.model = description.model;
  its.serial = description.serial;
  its.driver = description.driver;
  its.firmware = description.firmware;
  its.forces = description.forces;
  its.latency = true;  // of a frame
  its.paces = true;
  return its;
}

// With as many digits as one part of `whole` has.
std::string rounded(double value, double whole) {
  return shortest(std::round(value * whole) / whole);
}

}  // namespace

FramedDevice::FramedDevice(std::unique_ptr<FrameLink> link, const FramedDescription& description, const FramedOptions& options,
                           Attendant& attendant)
    : description_(description),
      options_(options),
      attendant_(attendant),
      capabilities_(capabilities_of(description_)),
      room_(room_for_words()),
      link_(std::move(link)) {}

FramedDevice::~FramedDevice() {
  if (!frames_) return;
  frames_->end();
  const FrameCount& seen = frames_->count();
  std::string words = description_.partner + " answered " + std::to_string(seen.frames) + " frames, " +
                      std::to_string(seen.late) + " of them began late; the longest took " + rounded(seen.longest_trip, 100) +
                      " ms";
  if (const std::string remark = link_->remark(); !remark.empty()) words += "; " + remark;
  if (seen.says_force)
    words += "; the force that it says it applied differed from the commanded one by at most " +
             rounded(seen.largest_difference, 1000) + " N";
  attendant_.report(words);
}

Fault FramedDevice::failed(const std::string& words) noexcept {
  std::snprintf(room_->data(), room_->size(), "%s", words.c_str());
  return Fault{fault_ = room_->data()};
}

std::optional<Fault> FramedDevice::start(double rate) noexcept {
  if (frames_ || fault_) return Fault{"the device was started before"};
  try {
    frames_ = std::make_unique<FrameThread>(*link_, options_, rate, *room_);
    if (const auto why = why_not_ready(rate)) {
      frames_->end();
      return failed(*why);
    }
  } catch (const std::exception& error) {
    return failed(error.what());
  }
  first_ = frames_->samples.latest().time;
  return std::nullopt;
}

std::optional<std::string> FramedDevice::why_not_ready(double rate) {
  const std::int64_t begin = system::now();
  std::int64_t calibrated_at = begin;
  bool has_reported = false;
  for (;;) {
    system::sleep_for(kPollFrames);
    if (attendant_.has_left()) return "stopped before " + description_.name + " was ready";
    const FrameSample& sample = frames_->samples.latest();
    const std::int64_t now = system::now();
    if (sample.troubled) return std::string(room_->data());
    if (sample.ready) {
      attendant_.report(words_of(*sample.times) + ": " + grade_of(*sample.times));
      return std::nullopt;
    }
    if (sample.time == 0 || sample.state.calibrated) {
      if (now - calibrated_at <= system::in_ns(options_.start)) continue;
      return "communication with " + description_.partner + " is too irregular to send forces: expected " + shortest(rate) +
             " frames a second and no long gap, got " + (sample.times ? words_of(*sample.times) : "too few frames") +
             ": check what else this machine computes";
    }
    if (!has_reported)
      attendant_.report("waiting for the calibration of " + description_.name + ": " + description_.to_calibrate);
    has_reported = true;
    calibrated_at = now;
    if (now - begin > system::in_ns(options_.calibration)) return description_.name + " is not calibrated";
  }
}

std::int64_t FramedDevice::wait_for_frame(std::int64_t deadline) noexcept {
  if (!frames_) return deadline;
  return frames_->samples.wait_for_another(read_, deadline);
}

ReadResult FramedDevice::read() noexcept {
  if (fault_) return Fault{fault_};
  if (!frames_) return Fault{"the device was not started"};
  const FrameSample& sample = frames_->samples.latest();
  read_ = sample.time;
  state_ = {.calibrated = sample.state.calibrated, .forces_on = sample.state.forces_on, .forces_off = sample.state.forces_off};
  if (sample.troubled)
    fault_ = room_->data();
  else if (system::now() - sample.time > system::in_ns(options_.watchdog_timeout))
    fault_ = "no frame of the device came in time: what answers for it, or this machine, is too slow";
  if (fault_) return Fault{fault_};
  return Reading{.position = sample.state.position.cast<float>(),
                 .time = static_cast<double>(sample.time - first_) * 1e-9,
                 .buttons = sample.state.buttons,
                 .sent = sample.sent};
}

std::optional<Fault> FramedDevice::command(const Eigen::Vector3f& force) noexcept {
  const bool finite = force.allFinite();
  Eigen::Vector3d limited = Eigen::Vector3d::Zero();
  if (finite) limited = shortened(force, static_cast<double>(capabilities_.peak_force)).cast<double>();
  if (frames_) frames_->orders.publish({.force = limited, .time = system::now(), .allowance = allowance_});
  if (!finite) return Fault{"a force that is not finite was commanded"};
  return std::nullopt;
}

}  // namespace forceshade::device
