// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/hd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <utility>

#include "device/simulated/arm.h"
#include "system/process.h"

namespace forceshade::world {

using namespace device::hdapi;

namespace {

constexpr HHD kDevice = 7;
constexpr double kPeakForce = 8.5;  // N
constexpr const char* kStrings[] = {"3.4.0", "Stand-in 1.5", "4.3.3", "Nobody", "S-0042", "192"};

Hd* the_hd = nullptr;

template <typename T>
T to(double value) {
  if constexpr (std::is_floating_point_v<T>) return value;
  constexpr auto kLow = static_cast<double>(std::numeric_limits<T>::lowest());
  if (!(value > kLow)) return std::numeric_limits<T>::lowest();
  return value >= -kLow ? std::numeric_limits<T>::max() : static_cast<T>(value);
}

}  // namespace

struct HdFunctions {
  enum class Where { anywhere, not_beside_scheduler, in_frame };

  static Hd& hd() noexcept { return Hd::current(); }
  static bool is_beside() noexcept { return hd().seen_.scheduler && system::this_thread() != hd().scheduler_id_; }
  static void breach(const char* name, const char* words) { hd().arm_.on_misuse((std::string(name) + " " + words).c_str()); }
  // Each call: others may go on meanwhile, and one that never returns does not.
  static void call(const char* name, Where where, Blocks block = Blocks::nothing) {
    system::step();
    if (block != Blocks::nothing && hd().orders_.blocks == block) current()->be_stuck();
    if (where != Where::anywhere && is_beside()) breach(name, "beside the running scheduler");
    if (!hd().errors_.empty()) breach(name, "with an error unread");
    if (where == Where::in_frame && !hd().in_frame_) breach(name, "outside a frame");
  }
  // Those that use the device wait for a callback that runs on another thread.
  static void wait_for_callback() noexcept {
    while (is_beside() && hd().ticking_ == 1) system::wait_for_change(hd().ticking_, 1, system::kForever);
  }

  static void fail(HDerror code) {
    if (code != kSuccess) hd().errors_.push_back({code, 42, kDevice});
  }
  // A condition that lasts is reported once.
  static void fail_in_frame(const char* name, HDerror code) {
    const bool lasts = code >= kWarmMotors;
    if (code != kSuccess && (!lasts || hd().reported_.emplace(name, code).second)) fail(code);
  }
  template <typename T>
  static void give(const char* name, const Answer& answer, std::initializer_list<T> right, T* values) {
    if (answer.how == Answer::How::right) std::copy(right.begin(), right.end(), values);
    if (answer.how == Answer::How::value) std::fill_n(values, right.size(), to<T>(answer.value));
    if (answer.how == Answer::How::error) hd().in_frame_ ? fail_in_frame(name, answer.error) : fail(answer.error);
  }

  static HHD init(const char* name) {
    call("hdInitDevice", Where::not_beside_scheduler, Blocks::init_device);
    hd().seen_.name = name ? std::optional<std::string>(name) : std::nullopt;
    fail(hd().orders_.init);
    if (hd().orders_.init != kSuccess || hd().orders_.init_fails_silently) return kInvalidDevice;
    hd().seen_.initialised = true;
    hd().calibrated_ = hd().in_frame_ = false;
    hd().callbacks_.clear();
    hd().errors_.clear();
    hd().arm_.open();
    return kDevice;
  }
  // Ends the force. On the scheduler's own thread no frame may follow.
  static void disable_device(HHD) {
    call("hdDisableDevice", Where::anywhere, Blocks::disable_device);
    wait_for_callback();
    if (!hd().seen_.initialised) breach("hdDisableDevice", "without a device");
    if (is_beside()) breach("hdDisableDevice", "while the scheduler runs");
    if (!hd().seen_.scheduler && !hd().callbacks_.empty()) breach("hdDisableDevice", "with a callback scheduled");
    if (!hd().seen_.scheduler && hd().seen_.output) breach("hdDisableDevice", "with the force output on");
    hd().seen_.initialised = hd().seen_.output = false;
    if (!hd().arm_.felt().isZero(0)) hd().arm_.push({0, 0, 0});
    hd().arm_.close();
  }
  static void begin_frame(HHD) {
    call("hdBeginFrame", Where::not_beside_scheduler, Blocks::begin_frame);
    Hd& d = hd();
    if (d.in_frame_) breach("hdBeginFrame", "twice in a tick");
    d.in_frame_ = true;
    d.force_.setZero();
    const int number = d.arm_.frames();
    d.arm_.look();
    d.state_ = d.arm_.state();
    d.state_.forces_on = d.state_.forces_on && d.seen_.output;
    if (d.orders_.output_goes_off) d.seen_.output = false;
    if (!std::exchange(d.has_position_, true) || !d.orders_.comm_lost)
      d.position_ = d.orders_.position ? *d.orders_.position : device::turned_to_arm(d.state_.position);
    if (d.arm_.event_at(number, Event::Kind::garbage)) d.position_.setConstant(std::numeric_limits<double>::quiet_NaN());
    fail_in_frame("hdBeginFrame", d.orders_.begin);
    if (d.orders_.comm_lost) fail_in_frame("hdBeginFrame", kCommunication);
    const Event* late = d.arm_.event_at(number, Event::Kind::late);
    const std::int64_t time = system::in_ns(d.orders_.frame_time) + (late ? static_cast<Ns>(late->milliseconds * 1e6) : 0);
    if (time > 0) system::sleep_until(system::now() + time);
  }
  static void end_frame(HHD) {
    call("hdEndFrame", Where::in_frame);
    Hd& d = hd();
    d.in_frame_ = false;
    if (!d.force_.allFinite()) breach("hdEndFrame", "with a force that is not finite");
    if (d.force_.norm() > d.orders_.peak_force.value_or(kPeakForce) * (1 + 1e-12))
      breach("hdEndFrame", "with more than the highest force");
    if (!d.seen_.output && !d.force_.isZero(0)) breach("hdEndFrame", "with a force while the output is off");
    const Eigen::Vector3d force = d.seen_.output ? d.force_ : Eigen::Vector3d(0, 0, 0);
    d.seen_.frames.push_back({d.position_, force});
    d.arm_.push(device::turned_to_law(force));
    for (const HDerror code : d.orders_.end) fail_in_frame("hdEndFrame", code);
    system::step();
    if (d.orders_.blocks == Blocks::end_frame) current()->be_stuck();
  }
  static HDErrorInfo get_error() {
    if (hd().errors_.empty()) return {};
    const HDErrorInfo last = hd().errors_.back();
    hd().errors_.pop_back();
    return last;
  }
  static void enable(HDenum) {
    call("hdEnable", Where::not_beside_scheduler);
    if (!hd().force_.isZero(0)) breach("hdEnable", "with a force set");
    hd().seen_.output = !hd().orders_.output_stays_off;
  }
  static void disable(HDenum) {
    call("hdDisable", Where::not_beside_scheduler);
    hd().seen_.output = false;
  }
  static HDboolean is_enabled(HDenum) {
    call("hdIsEnabled", Where::not_beside_scheduler);
    const bool event = hd().arm_.event_at(hd().arm_.frames(), Event::Kind::forces_off) != nullptr;
    return hd().seen_.output && !event ? 1 : 0;
  }
  static void get_boolean(HDenum, HDboolean* value) {
    call("hdGetBooleanv", Where::not_beside_scheduler);
    *value = 0;
  }
  static void get_integer(HDenum what, int* value) {
    call("hdGetIntegerv", Where::not_beside_scheduler);
    const auto& orders = hd().orders_;
    switch (what) {
      case kButtons: *value = hd().state_.buttons; break;
      case kInputDegrees: return give("hdGetIntegerv", orders.input_degrees, {6}, value);
      case kCalibrationStyles: *value = orders.styles; break;
      case kUpdateRate: return give("hdGetIntegerv", orders.update_rate, {1000}, value);
      default: return give("hdGetIntegerv", orders.instantaneous_rate, {orders.comm_lost ? 0 : to<int>(rate())}, value);
    }
  }
  static void get_long(HDenum, HDlong* value) {
    call("hdGetLongv", Where::in_frame);
    const Eigen::Vector3d& p = hd().position_;
    if (p.allFinite())
      give("hdGetLongv", hd().orders_.encoders, {std::lround(20 * p.x()), std::lround(20 * p.y()), std::lround(20 * p.z())},
           value);
  }
  static void get_double(HDenum what, double* value) {
    call("hdGetDoublev", Where::not_beside_scheduler);
    const auto& orders = hd().orders_;
    const auto answer = [&](const Answer& given, std::initializer_list<double> right) {
      give("hdGetDoublev", given, right, value);
    };
    switch (what) {
      case kPosition:
        if (orders.withholds_position) return;
        fail_in_frame("hdGetDoublev", orders.get_position);
        if (orders.get_position == kSuccess) std::copy(hd().position_.begin(), hd().position_.end(), value);
        return;
      case kJointAngles:
        return answer(orders.joint_angles, {hd().position_.x() / 200, hd().position_.y() / 200, hd().position_.z() / 200});
      case kGimbalAngles: return answer({}, {0.1, 0.2, 0.3});
      case kMotorTemperature:
        if (orders.output_degrees == 3) return answer(orders.temperature, {0.125, 0.25, 0.0625});
        return answer(orders.temperature, {0.125, 0.25, 0.0625, 0.03125, 0.03125, 0.03125});
      case kUsableWorkspace: return answer(orders.workspace, {-190., -95., -130., 191., 96., 137.});
      case kMaxForce: return answer(orders.peak_force, {kPeakForce});
      case kContinuousForce: return answer(orders.continuous_force, {1.4});
      case kVelocityLimit: return answer(orders.velocity_limit, {1500.});
      default: return answer(orders.impulse_limit, {4.});
    }
  }
  static void set_double(HDenum, const double* value) {
    call("hdSetDoublev", Where::in_frame);
    hd().force_ = {value[0], value[1], value[2]};
    fail_in_frame("hdSetDoublev", hd().orders_.set);
  }
  static HDenum check_calibration() {
    call("hdCheckCalibration", Where::not_beside_scheduler);
    const auto& orders = hd().orders_;
    if (!hd().state_.calibrated) return kCalibrationNeedsHand;
    if (orders.calibration) return *orders.calibration;
    if (hd().calibrated_) return kCalibrated;
    const auto styles = static_cast<HDenum>(orders.styles);
    const bool ready = (styles & kCalibratesItself) != 0 || ((styles & kCalibratesInInkwell) != 0 && orders.in_inkwell);
    return ready ? kCalibrationNeedsUpdate : kCalibrationNeedsHand;
  }
  static void update_calibration(HDenum style) {
    call("hdUpdateCalibration", Where::not_beside_scheduler);
    auto& orders = hd().orders_;
    ++hd().seen_.updates;
    if (!orders.update_helps) return;
    if (orders.calibration) orders.calibration = kCalibrated;
    hd().calibrated_ = style == kCalibratesItself || (style == kCalibratesInInkwell && orders.in_inkwell) ||
                       (style == kCalibratesAtResetPose && orders.in_reset_pose);
  }
  static void start_scheduler() {
    call("hdStartScheduler", Where::anywhere, Blocks::start_scheduler);
    Hd& d = hd();
    if (d.seen_.scheduler) breach("hdStartScheduler", "twice");
    fail(d.orders_.start);
    if (d.orders_.start != kSuccess) return;
    d.stop_ = false;
    d.seen_.scheduler = true;
    d.scheduler_ = system::Thread("scheduler", [&d] { d.run(); });
    fail(d.orders_.start_with_error);
    system::step();
  }
  static void stop_scheduler() {
    call("hdStopScheduler", Where::anywhere, Blocks::stop_scheduler);
    Hd& d = hd();
    // A caller cannot send anything through a scheduler that hangs.
    const bool hangs = d.orders_.hung || (d.scheduler_id_ >= 0 && current()->is_over(d.scheduler_id_));
    if (!hangs && d.seen_.output) breach("hdStopScheduler", "with the force output on");
    if (!hangs && !d.force_.isZero(0)) breach("hdStopScheduler", "with a force sent last");
    d.stop_ = true;
    wait_for_callback();
    if (d.scheduler_.is_joinable()) d.scheduler_.join();
    d.seen_.scheduler = false;
  }
  static void set_rate(HDulong hz) {
    call("hdSetSchedulerRate", Where::anywhere);
    fail(hd().orders_.rate);
    if (hd().orders_.rate == kSuccess) hd().seen_.rate = static_cast<double>(hz);
  }
  static HDSchedulerHandle schedule(HDCallback function, void* data, HDushort) {
    call("hdScheduleAsynchronous", Where::anywhere);
    fail(hd().orders_.schedule);
    if (hd().orders_.schedule != kSuccess) return kInvalidSchedulerHandle;
    hd().callbacks_[0] = {function, data};
    return 0;
  }
  static void unschedule(HDSchedulerHandle handle) {
    call("hdUnschedule", Where::anywhere);
    if (hd().callbacks_.erase(handle) == 0) fail(kInvalidOperation);
  }
  static const char* string(HDenum what) {
    call("hdGetString", Where::not_beside_scheduler);
    return kStrings[what - kVersion];
  }
  static const char* error_string(HDerror) { return "Some error."; }

  static double rate() noexcept { return hd().orders_.frame_hz > 0 ? hd().orders_.frame_hz : hd().seen_.rate; }
};

Hd::Hd(Arm& arm) : arm_(arm) {
  if (the_hd) std::abort();
  the_hd = this;
  world::current()->on_process_end = [this](int process) {
    if (process == 0) return;
    seen_.is_left |= seen_.initialised;
    seen_.initialised = seen_.scheduler = seen_.output = false;
    if (arm_.is_closed()) return;
    if (!arm_.felt().isZero(0) && !arm_.plan().may_be_lost) arm_.on_misuse("its process ends under force");
    arm_.is_out_of_reach = true;
  };
}

Hd::~Hd() {
  the_hd = nullptr;
}

Hd& Hd::current() noexcept {
  return *the_hd;
}

const Functions& Hd::functions() {
  using F = HdFunctions;
  static constexpr Functions all{.hdInitDevice = F::init,
                                 .hdDisableDevice = F::disable_device,
                                 .hdBeginFrame = F::begin_frame,
                                 .hdEndFrame = F::end_frame,
                                 .hdGetError = F::get_error,
                                 .hdGetErrorString = F::error_string,
                                 .hdEnable = F::enable,
                                 .hdDisable = F::disable,
                                 .hdIsEnabled = F::is_enabled,
                                 .hdGetBooleanv = F::get_boolean,
                                 .hdGetIntegerv = F::get_integer,
                                 .hdGetLongv = F::get_long,
                                 .hdGetDoublev = F::get_double,
                                 .hdSetDoublev = F::set_double,
                                 .hdGetString = F::string,
                                 .hdCheckCalibration = F::check_calibration,
                                 .hdUpdateCalibration = F::update_calibration,
                                 .hdStartScheduler = F::start_scheduler,
                                 .hdStopScheduler = F::stop_scheduler,
                                 .hdSetSchedulerRate = F::set_rate,
                                 .hdScheduleAsynchronous = F::schedule,
                                 .hdUnschedule = F::unschedule};
  return all;
}

void Hd::tell(const Orders& orders) {
  orders_ = orders;
  reported_.clear();
}

void Hd::run() {
  scheduler_id_ = system::this_thread();
  // An error of the start is there for who has started it.
  while (!errors_.empty()) system::sleep_for(std::chrono::microseconds(100));
  for (std::int64_t next = system::now(); !stop_;
       next = std::max(next + static_cast<Ns>(1e9 / HdFunctions::rate()), system::now())) {
    system::sleep_until(next);
    if (!orders_.hung) tick();
  }
}

void Hd::tick() {
  ticking_ = 1;
  for (const auto& [handle, callback] : callbacks_) callback.first(callback.second);
  if (arm_.frames() > 0) arm_.answered();
  ticking_ = 0;
  system::wake(ticking_);
}

bool Attends::did(const std::string& words) noexcept {
  asked.push_back(words);
  for (Ns waited = 0; waited < patience && !does && !leaves; waited += 1'000'000)
    system::sleep_for(std::chrono::milliseconds(1));
  return does;
}

namespace {

struct Parts {
  explicit Parts(Arm& arm) : hd(arm) {}
  Hd hd;
  Attends attends;
};
std::unique_ptr<Parts> parts;

}  // namespace

std::unique_ptr<device::Device> OpenPhantom::operator()(Arm& arm) const {
  parts.reset();
  parts = std::make_unique<Parts>(arm);
  parts->hd.tell(orders);
  if (attended) attended(parts->attends);
  return std::make_unique<device::Phantom>("", options, parts->attends, &Hd::functions);
}

Attends& OpenPhantom::attends() noexcept {
  return parts->attends;
}

}  // namespace forceshade::world
