// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom_host.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "device/phantom/ending.h"
#include "device/phantom/hdapi_library.h"
#include "device/phantom/phantom_end.h"
#include "device/phantom/phantom_frames.h"
#include "device/phantom/phantom_limits.h"
#include "device/phantom/phantom_shared.h"
#include "files/csv.h"
#include "forceshade/device.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

using Kind = PhantomMessage::Kind;
using std::chrono::milliseconds;

constexpr milliseconds kHostPoll{1}, kHostWatch{10};
constexpr int kMeasured = 2;  // Hz: a window of frames is half a second

class Host {
 public:
  Host(system::Packets& packets, PhantomShared& shared, const std::string& name, const PhantomOptions& options,
       LastWords& last_words, PhantomEnd& end, const hdapi::Functions& hd)
      : packets_(packets), shared_(shared), name_(name), options_(options), last_words_(last_words), end_(end), hd_(hd) {}

  // Opens the device, starts it when the other process orders it, and holds it until the other process is gone. Throws
  // DeviceError.
  void hold() {
    open();
    PhantomMessage message;
    if (next(message) != Kind::start) return;
    start(message.rate);
    send_words(packets_, Kind::ready, "");
    next(message);
  }

  // Zero force, output off, scheduler stopped, device released, in this order.
  void close() noexcept;
  // A frame did not end, and the device was released from its thread: the last that can be done.
  bool was_abandoned() const noexcept { return frames_ && frames_->abandoned(); }

 private:
  void open();
  PhantomDescription described();
  void start(double rate);
  hdapi::HDenum preferred_style();
  void calibrate_by_hand();
  void wait_until_ready();

  // The next message's kind; none where the other end is closed.
  std::optional<Kind> next(PhantomMessage& message) const {
    using Received = system::Packets::Received;
    Received received = Received::nothing_yet;
    while (received == Received::nothing_yet && !packets_.is_alone())
      received = packets_.receive(&message, sizeof message, system::now() + system::in_ns(kHostWatch));
    return received == Received::message ? std::optional(message.kind) : std::nullopt;
  }
  void report(const std::string& words) const { send_words(packets_, Kind::report, words); }
  bool is_confirmed(const std::string& words) const {
    send_words(packets_, Kind::asked, words);
    PhantomMessage answer;
    return next(answer) == Kind::yes;
  }

  void expect_success(const char* step) {
    const hdapi::HDErrorInfo error = hdapi::drained(hd_);
    if (error.code == hdapi::kSuccess) return;
    std::array<char, 512> room{};
    throw DeviceError(hdapi::sentence({step, error, hd_.hdGetErrorString(error.code)}, room));
  }
  // False where the last call failed; its value is then unknown.
  bool has_answered() noexcept { return hdapi::drained(hd_).code == hdapi::kSuccess; }
  std::optional<double> number(hdapi::HDenum what) noexcept {
    std::array<double, 16> value{};
    value[0] = std::numeric_limits<double>::quiet_NaN();
    hd_.hdGetDoublev(what, value.data());
    return has_answered() ? std::optional(value[0]) : std::nullopt;
  }
  int whole(hdapi::HDenum what) noexcept {
    int value = 0;
    hd_.hdGetIntegerv(what, &value);
    return has_answered() ? value : 0;
  }
  template <std::size_t size>
  void copy_words(hdapi::HDenum what, std::array<char, size>& to) noexcept {
    const char* words = hd_.hdGetString(what);
    if (has_answered() && words) std::snprintf(to.data(), to.size(), "%s", words);
  }

  // Scheduled with this.
  static unsigned tick(void* host) noexcept {
    auto& it = *static_cast<Host*>(host);
    it.end_.meet_driver();
    return PhantomFrames::tick(it.frames_.get());
  }

  system::Packets& packets_;
  PhantomShared& shared_;
  const std::string& name_;
  const PhantomOptions& options_;
  LastWords& last_words_;
  PhantomEnd& end_;
  const hdapi::Functions& hd_;
  hdapi::HHD device_ = hdapi::kInvalidDevice;
  PhantomDescription description_;
  std::optional<system::RealTime> real_time_;
  std::unique_ptr<PhantomFrames> frames_;
  std::optional<hdapi::HDSchedulerHandle> callback_;
  hdapi::HDenum style_ = 0;
  double rate_ = 0;  // Hz
  bool scheduler_ = false;
};

void Host::open() {
  system::before_end(end_);
  hdapi::drained(hd_);
  device_ = hd_.hdInitDevice(name_.empty() ? nullptr : name_.c_str());
  const hdapi::HDErrorInfo error = hdapi::drained(hd_);
  if (error.code != hdapi::kSuccess || device_ == hdapi::kInvalidDevice) {
    hdapi::Trouble trouble{"initialising the PHANToM failed, and the driver says no more"};
    if (error.code != hdapi::kSuccess) trouble = {"initialising the PHANToM", error, hd_.hdGetErrorString(error.code)};
    throw DeviceError(hdapi::initialisation_advice(name_, trouble));
  }
  PhantomMessage message{.kind = Kind::described, .description = described()};
  description_ = message.description;
  send_message(packets_, message);
}

PhantomDescription Host::described() {
  PhantomDescription it;
  copy_words(hdapi::kModel, it.model);
  copy_words(hdapi::kSerialNumber, it.serial);
  copy_words(hdapi::kDriverVersion, it.driver);
  copy_words(hdapi::kFirmware, it.firmware);

  DriversLimits driver{.peak = number(hdapi::kMaxForce),
                       .continuous = number(hdapi::kContinuousForce),
                       .speed = number(hdapi::kVelocityLimit),
                       .impulse = number(hdapi::kImpulseLimit)};
  std::array<double, 16> box{};
  box.fill(std::numeric_limits<double>::quiet_NaN());
  hd_.hdGetDoublev(hdapi::kUsableWorkspace, box.data());
  if (has_answered()) driver.workspace = {box[0], box[1], box[2], box[3], box[4], box[5]};
  const auto limits = phantom_limits(driver);
  if (const auto* why = std::get_if<std::string>(&limits)) throw DeviceError(*why);
  const auto& [peak, continuous, speed, slew, low, high, words] = std::get<PhantomLimits>(limits);
  it.peak = peak;
  it.continuous = continuous;
  it.speed = speed;
  it.slew = slew;
  it.low = low;
  it.high = high;
  if (!words.empty()) report(words);
  it.rate = std::max(0, whole(hdapi::kUpdateRate));
  it.gimbal = whole(hdapi::kInputDegrees) == 6;
  return it;
}

// The first in the vendor's order of preference, where a device has several: one that needs no person comes first.
hdapi::HDenum Host::preferred_style() {
  const auto styles = static_cast<hdapi::HDenum>(whole(hdapi::kCalibrationStyles));
  for (const hdapi::HDenum style : {hdapi::kCalibratesItself, hdapi::kCalibratesInInkwell, hdapi::kCalibratesAtResetPose})
    if ((styles & style) != 0) return style;
  return 0;
}

// Before the scheduler runs. Each process has to, and no other program can do it for this one.
void Host::calibrate_by_hand() {
  for (int tries = 0; tries < 3; ++tries) {
    const hdapi::HDenum status = hd_.hdCheckCalibration();
    expect_success("checking the calibration");
    if (status == hdapi::kCalibrated) return;
    if (!is_confirmed(hdapi::kHoldInResetPose)) break;
    hd_.hdUpdateCalibration(hdapi::kCalibratesAtResetPose);
    expect_success("updating the calibration");
  }
  const hdapi::HDenum status = hd_.hdCheckCalibration();
  expect_success("checking the calibration");
  if (status != hdapi::kCalibrated) throw DeviceError(hdapi::kNotCalibrated);
}

void Host::start(double rate) {
  style_ = preferred_style();
  if (style_ == hdapi::kCalibratesAtResetPose) calibrate_by_hand();
  rate_ = std::round(rate);
  if (rate_ != description_.rate) {
    hd_.hdSetSchedulerRate(static_cast<hdapi::HDulong>(rate_));
    expect_success("setting the driver's rate (most devices have 1000 and 500 Hz)");
  }
  FrameSettings settings{.gimbal = description_.gimbal,
                         .style = style_,
                         .force = options_.force,
                         .watchdog_timeout = options_.watchdog_timeout,
                         .rate = rate_,
                         .window = std::max(1, static_cast<int>(rate_) / kMeasured),
                         .rate_tolerance = options_.rate_tolerance,
                         .longest_gap = std::chrono::duration<double>(options_.watchdog_timeout).count() / 2};
  frames_ = std::make_unique<PhantomFrames>(hd_, device_, settings, shared_);
  end_.hold(frames_.get());
  callback_ = hd_.hdScheduleAsynchronous(&Host::tick, this, hdapi::kDefaultPriority);
  if (*callback_ == hdapi::kInvalidSchedulerHandle) callback_.reset();
  expect_success("scheduling the frames");

  // The driver's thread inherits this one's priority and processor.
  real_time_.emplace(system::processor_before_last(), system::RealTime::kFramesPriority);
  // It may run although an error is reported: it is stopped either way.
  scheduler_ = true;
  last_words_.say_unless_taken_back(hdapi::kNoStart, options_.start);
  hd_.hdStartScheduler();
  system::before_end(end_);
  last_words_.take_back();
  expect_success("starting the driver's scheduler");
  wait_until_ready();
}

std::string why_not_ready(const PhantomSample& sample, double rate) {
  if (sample.time == 0) return hdapi::kNoFrames;
  if (!sample.times) return "the PHANToM did not get ready in time: the driver runs its frames too slowly";
  if (!sample.answers && sample.times->rate > rate / 2) return hdapi::kNoAnswer;
  return "communication with the PHANToM is too irregular to switch forces on: expected " + shortest(rate) +
         " frames a second and no long gap, got " + words_of(*sample.times) +
         ": check cable and power, and what else this machine computes";
}

void Host::wait_until_ready() {
  const system::RealTime::Granted& granted = real_time_->granted();
  report(std::string("the driver's thread has ") +
         (granted.scheduling ? "real-time priority" : "ordinary priority, because real-time priority was refused") +
         (granted.cpu ? ", on processor " + std::to_string(*granted.cpu) : ""));
  const std::int64_t begin = system::now();
  std::int64_t calibrated_at = begin;
  bool has_reported = false;
  for (;;) {
    system::sleep_for(kHostPoll);
    if (packets_.is_alone()) throw DeviceError("the other process is gone");
    const PhantomSample& sample = frames_->samples.latest();
    const std::int64_t now = system::now();
    if (sample.troubled) throw DeviceError(shared_.trouble.data());
    if (sample.phase == PhantomSample::Phase::ready) {
      if (!sample.has_temperature) report(hdapi::kTemperatureUnknown);
      if (!sample.has_rate) report(hdapi::kRateUnknown);
      return report(words_of(*sample.times) + ": " + grade_of(*sample.times));
    }
    if (sample.time == 0 || sample.calibrated) {
      if (now - calibrated_at > system::in_ns(options_.start)) throw DeviceError(why_not_ready(sample, rate_));
      continue;
    }
    if (!has_reported)
      report(std::string("waiting for the PHANToM's calibration: ") +
             (style_ == hdapi::kCalibratesItself ? hdapi::kMoveItAbout : hdapi::kRestInInkwell));
    has_reported = true;
    calibrated_at = now;
    if (now - begin > system::in_ns(options_.calibration)) throw DeviceError(hdapi::kNotCalibrated);
  }
}

void Host::close() noexcept {
  if (scheduler_) {
    end_.let_go();
    if (was_abandoned()) return;  // nor does any call of the driver's return now
    hd_.hdStopScheduler();
    hdapi::drained(hd_);
    // The scheduler ran no more frames. Now that it is stopped, this thread may switch the output off; a driver that does so at
    // the next frame ends the force when it disables the device, below.
    if (!frames_->closed()) {
      hd_.hdDisable(hdapi::kForceOutput);
      hdapi::drained(hd_);
    }
  }
  end_.hold(nullptr);
  if (callback_) {
    hd_.hdUnschedule(*callback_);
    hdapi::drained(hd_);
  }
  if (device_ == hdapi::kInvalidDevice) return;
  hd_.hdDisableDevice(device_);
  hdapi::drained(hd_);
}

}  // namespace

int run_phantom_host(system::Packets& packets, PhantomShared& shared, const std::string& name, const PhantomOptions& options,
                     HdapiLibrary library) {
  // Objects that other threads still use when this one returns live as long as the process.
  auto& last_words = *new LastWords;
  auto& end = *new PhantomEnd;
  auto& host = *new std::optional<Host>;
  watch_for_the_end(packets, end, last_words);
  try {
    host.emplace(packets, shared, name, options, last_words, end, library()).hold();
    host->close();
    return host->was_abandoned() ? kStuck : kLetGo;
  } catch (const std::exception& error) {
    const bool of_ours = dynamic_cast<const DeviceError*>(&error) != nullptr;
    const std::string why = (of_ours ? "" : "the vendor's library failed: ") + std::string(error.what());
    last_words.say_unless_taken_back(why, longest_of(Ending::released));
    if (host) host->close();
    send_words(packets, Kind::failed, why);
    return host && host->was_abandoned() ? kStuck : kRefused;
  }
}

}  // namespace forceshade::device
