// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM's, through the stand-in for its driver: real threads and real time.

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "device/phantom/phantom.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "forceshade/recording.h"
#include "tests/device/faults/press.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/kept_samples.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/wait_until.h"

namespace forceshade::faults {
namespace {

using namespace std::chrono_literals;
using device::Phantom;
using stand_in_hd::Frame;
using stand_in_hd::Orders;
using stand_in_hd::seen;
using stand_in_hd::tell;
using Clock = std::chrono::steady_clock;
namespace hdapi = device::hdapi;

// Instead of 25 ms, where ms are judged. Where frames are counted no time is judged, and a loop that the machine keeps waiting
// is not to end the run before the fault does.
constexpr std::chrono::milliseconds kTimeout{200}, kLongTimeout{600'000};
constexpr double kTimeoutMs = 200;
constexpr double kClosingMs = 200;  // what a driver that hangs is waited for at the end

// Ticks of the run: free, two steps slower than a frozen encoder's, the ramp up to some 0.2 N, and then the fault.
constexpr std::size_t kDown = 60, kDeeper = 65, kFault = 320, kTicks = 360;

Orders at_height(double z) {  // mm above the surface
  return {.position = Eigen::Vector3d(0, z, 0)};
}

double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

struct Trouble {
  std::function<void(Orders&)> orders = {};
  std::chrono::milliseconds stall{0};  // of the loop
  bool waits = false;                  // the loop, until the frames have let the arm go by themselves
};

// What a run is judged by, as its loop saw it.
struct Watched {
  std::uint64_t fault = 0;  // the number of its orders; 0: none were given
  Clock::time_point since{};
};

// One tick for each frame, however late: what is tried here is not the loop's own deadlines.
class FrameByFrame final : public device::Device {
 public:
  FrameByFrame(Phantom& phantom, const Trouble& trouble, const Bench& bench)
      : phantom_(phantom), trouble_(trouble), bench_(bench) {}

  device::Capabilities capabilities() const noexcept override {
    device::Capabilities capabilities = phantom_.capabilities();
    if (!bench_.supervised) capabilities.peak_force = device::Capabilities::kNone;
    return capabilities;
  }
  std::optional<device::Fault> start(double rate) noexcept override { return phantom_.start(rate); }
  device::ReadResult read() noexcept override {
    if (tick_ == kDown) tell(at_height(-0.1));
    if (tick_ == kDeeper) tell(at_height(-0.25));
    if (tick_ == kFault) begin_fault();
    ++tick_;
    for (;; std::this_thread::sleep_for(100us)) {
      device::ReadResult result = phantom_.read();
      const auto* reading = std::get_if<device::Reading>(&result);
      if (reading && reading->time == last_) continue;
      if (reading) last_ = reading->time;
      return result;
    }
  }
  std::optional<device::Fault> command(const Eigen::Vector3f& force) noexcept override { return phantom_.command(force); }
  device::State state() const noexcept override { return phantom_.state(); }

  Watched watched;

 private:
  void begin_fault() {
    Orders orders = at_height(-0.25);
    if (trouble_.orders) trouble_.orders(orders);
    watched.since = Clock::now();
    watched.fault = tell(orders);
    std::this_thread::sleep_for(trouble_.stall);
    if (trouble_.waits) tests::wait_until([] { return stand_in_hd::arm().force.isZero(0); });
  }

  Phantom& phantom_;
  const Trouble& trouble_;
  const Bench& bench_;
  std::size_t tick_ = 0;
  double last_ = -1;
};

enum class Unit { frames, ms };

// The call of a frame that is the first to show the fault to the program. The program cannot do anything about the fault before
// that call. A frame that is under way when the fault happens shows it if that call is still to come; if not, the next frame
// does.
using ShownBy = std::uint64_t Frame::*;
constexpr ShownBy kBegun = &Frame::begun, kSet = &Frame::set, kEnded = &Frame::ended;

Outcome drive(const Orders& before, const Trouble& trouble, Unit unit, ShownBy shown_by, const Bench& bench) {
  setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  stand_in_hd::reset();
  tell(before);
  const tests::TemporaryDirectory directory;
  // Its thread begins after the driver's process: the thread sanitizer follows no process that is forked beside a thread.
  std::optional<recorder::Recorder> recorder;
  tests::KeptSamples told;
  Outcome outcome;
  Watched watched;
  bool goes_on = false;
  try {
    const auto timeout = unit == Unit::frames ? kLongTimeout : kTimeout;
    Phantom phantom("", {.watchdog_timeout = timeout, .open = 600s, .start = 600s, .calibration = 200ms, .rate_tolerance = 1});
    recorder.emplace(directory.file("run.fsr"), recorder::Metadata{});
    FrameByFrame device(phantom, trouble, bench);
    const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 1.5F}));
    const auto run = run_servo_loop(device, law, {.max_seconds = kTicks / 1000.0, .paced = false, .sinks = {&told, &*recorder}},
                                    std::atomic<bool>(false));
    watched = device.watched;
    goes_on = run.end_reason == device::EndReason::time_up && !tests::vector(told.samples[kTicks - 1].force).isZero(0);
    outcome.reaction = reaction_of(run, told.samples, kFault);
  } catch (const device::DeviceError& error) {
    outcome.reaction = std::string("refused: ") + error.what();
  }
  if (recorder) {
    recorder->close("fault");
    outcome.lost = static_cast<double>(told.samples.size() - kept_in(directory.file("run.fsr"), told.samples));
  }

  const auto seen_all = seen();
  for (const std::string& breach : seen_all.breaches) outcome.reaction += "; breach: " + breach;
  const auto& frames = seen_all.frames;
  std::size_t shown = 0;  // the frame in which
  while (shown < frames.size() && frames[shown].*shown_by < watched.fault) ++shown;
  outcome.took_effect = watched.fault > 0 ? unit == Unit::ms || shown < frames.size() : told.samples.size() <= 1;
  std::size_t zero = frames.size();
  while (zero > shown && frames[zero - 1].force.isZero(0)) --zero;
  if (shown > 0) outcome.before = frames[shown - 1].force.norm();
  for (const Frame& frame : frames) outcome.highest = std::max(outcome.highest, frame.force.norm());
  if (!goes_on)
    outcome.to_zero = unit == Unit::frames ? static_cast<double>(zero - shown)
                                           : std::max(0.0, milliseconds(seen_all.pushed_until - watched.since));
  if (seen_all.initialised || seen_all.scheduler || seen_all.output) outcome.reaction += "; not closed";
  return outcome;
}

Fault phantom(std::string what, std::string reaction, std::optional<double> to_zero, Unit unit, Trouble trouble,
              ShownBy shown_by = kBegun) {
  return {.kind = Kind::device,
          .what = "PHANToM: " + std::move(what),
          .reaction = std::move(reaction),
          .to_zero = to_zero,
          .unit = unit == Unit::frames ? "frames" : "ms",
          .is_timed = unit == Unit::ms,
          .run = [=](const Bench& bench) { return drive(at_height(0.05), trouble, unit, shown_by, bench); }};
}

// While it runs, and answered by the frame itself, however late the machine runs the frame, and before the loop does anything:
// what its beginning shows leaves that frame no force. What is shown when the force is set or sent comes too late for that one,
// and the next has none.
Fault in_frame(std::string what, std::string reaction, ShownBy shown_by, std::function<void(Orders&)> orders) {
  return phantom(std::move(what), std::move(reaction), shown_by == kBegun ? 0 : 1, Unit::frames,
                 {.orders = std::move(orders), .waits = true}, shown_by);
}

// Before there is any force.
Fault at_start(std::string what, std::string reaction, std::function<void(Orders&)> alter) {
  Orders orders = at_height(0.05);
  alter(orders);
  return {.kind = Kind::device,
          .what = "PHANToM: " + std::move(what),
          .reaction = std::move(reaction),
          .to_zero = 0,
          .unit = "frames",
          .under_force = false,
          .run = [=](const Bench& bench) { return drive(orders, {}, Unit::frames, kBegun, bench); }};
}

}  // namespace

std::vector<Fault> phantom_faults() {
  return {
      in_frame("communication is lost", "communication with the device failed", kBegun,
               [](Orders& o) { o.begin = hdapi::kCommunication; }),
      in_frame("communication is lost, reported once", "communication with the device failed", kBegun,
               [](Orders& o) { o.comm_lost = true; }),
      in_frame("motor temperatures are NaN", "motor temperatures that are no numbers", kBegun,
               [](Orders& o) { o.temperature = std::nan(""); }),
      in_frame("motors too warm for the driver", "the motors are too warm", kEnded,
               [](Orders& o) { o.end = {hdapi::kWarmMotors}; }),
      in_frame("highest force exceeded", "the highest force was exceeded", kEnded,
               [](Orders& o) { o.end = {hdapi::kExceededForce}; }),
      in_frame("highest velocity exceeded", "the highest velocity was exceeded", kEnded,
               [](Orders& o) { o.end = {hdapi::kExceededVelocity}; }),
      in_frame("the device reports a fault", "the device reports a fault", kEnded,
               [](Orders& o) { o.end = {hdapi::kDeviceFault}; }),
      in_frame("the force cannot be sent", "the force could not be sent", kSet, [](Orders& o) { o.set = hdapi::kForceError; }),
      in_frame("position is NaN", "position is not finite", kBegun,
               [](Orders& o) { o.position = Eigen::Vector3d(std::nan(""), 0, 0); }),
      in_frame("the driver gives no position and no error", "position is not finite", kBegun,
               [](Orders& o) { o.withholds_position = true; }),
      // As late as the loop may be to answer a frame: from then on the frames let go by themselves.
      phantom("position jumps by 20 mm", "trip: jump", kTimeoutMs, Unit::ms,
              {.orders = [](Orders& o) { o.position = Eigen::Vector3d(20, -0.25, 0); }}),
      phantom("position jumps to where an uncalibrated one says it is", "trip: jump", kTimeoutMs, Unit::ms,
              {.orders = [](Orders& o) { o.position = Eigen::Vector3d(0, -110, -35); }}),
      phantom("motors warmer than allowed", "limited: warm motors", kTimeoutMs, Unit::ms,
              {.orders = [](Orders& o) { o.temperature = 1.1; }}),
      phantom("the calibration is lost", "trip: uncalibrated", kTimeoutMs, Unit::ms,
              {.orders = [](Orders& o) { o.calibration = hdapi::kCalibrationNeedsUpdate; }}),
      // After 20 ticks without a changed bit, of a frame each.
      phantom("encoders freeze after a fast step", "trip: frozen encoder", 20 + kTimeoutMs, Unit::ms,
              {.orders = [](Orders& o) { o.position = Eigen::Vector3d(0.4, -0.25, 0); }}),
      in_frame("the emergency switch is pressed", "limited: dead-man switch", kBegun,
               [](Orders& o) { o.output_goes_off = true; }),
      // Found after the loop's timeout, which then closes; and two threads wake up for it.
      phantom("the driver hangs", "stopped running frames", 3 * kTimeoutMs + kClosingMs, Unit::ms,
              {.orders = [](Orders& o) { o.hung = true; }}),
      phantom("the loop stalls", "the servo loop stalled", 2 * kTimeoutMs, Unit::ms, {.stall = 3 * kTimeout}),
      phantom("frames take 20 ms", "goes on", std::nullopt, Unit::frames, {.orders = [](Orders& o) { o.frame_time = 20ms; }}),
      at_start("uncalibrated", "is not calibrated", [](Orders& o) { o.calibration = hdapi::kCalibrationNeedsHand; }),
      at_start("nobody holds the arm in its reset pose", "is not calibrated: hold it in its reset pose",
               [](Orders& o) {
                 o.calibration = std::nullopt;
                 o.styles = hdapi::kCalibratesAtResetPose;
               }),
      at_start("stands frozen where an uncalibrated one says it is", "uncalibrated Omni or Touch",
               [](Orders& o) { o.position = Eigen::Vector3d(0, -110, -35); }),
      at_start("force output stays off", "is still off: check its power supply", [](Orders& o) { o.output_stays_off = true; }),
      at_start("no licence", "refused ... the vendor's licence is missing", [](Orders& o) { o.init = hdapi::kNoLicence; }),
      at_start("the scheduler does not start", "starting the driver's scheduler", [](Orders& o) { o.start = hdapi::kTimer; }),
      at_start("the scheduler starts with an error", "starting the driver's scheduler",
               [](Orders& o) { o.start_with_error = hdapi::kTimer; }),
      at_start("the library crashes while the device is opened", "refused ... was ended by a signal (Segmentation fault)",
               [](Orders& o) { o.crash = {.when = stand_in_hd::Moment::before_start}; }),
      at_start("highest force is NaN", "refused ... the PHANToM's highest force: expected a number of newtons above 0",
               [](Orders& o) { o.peak_force = std::nan(""); }),
  };
}

}  // namespace forceshade::faults
