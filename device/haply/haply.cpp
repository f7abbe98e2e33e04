// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "device/haply/open_haply.h"
#include "device/monotonic.h"
#include "device/shortened.h"
#include "files/csv.h"
#include "files/printable.h"

namespace forceshade::device {
namespace {

using haply::Answer;
using haply::Inverse3;
using std::chrono::milliseconds;

constexpr milliseconds kHttp{1000}, kRepeat{1000}, kPollFrames{5};
constexpr const char* kService = "FORCESHADE_HAPLY_SERVICE";

// The service says none of these. The origin of the device is the middle of its workspace, which two clients agree on; the
// boxes are those in which the vendor's tutorials keep their targets. The forces are the least that clients use: nobody
// publishes continuous ones.
const Eigen::Vector3d kMiddle{0, -150, 200};  // mm, in the service's frame
struct Limits {
  float reach;             // mm from the middle, along each axis
  float peak, continuous;  // N
};
constexpr Limits kInverse3{100, 5, 2}, kMinverse{40, 2, 1};
constexpr float kResolution = 0.05F;  // mm

haply::Address service() {
  const char* text = std::getenv(kService);
  try {
    return haply::address_of(text ? text : "localhost:10001");
  } catch (const std::invalid_argument& error) {
    throw DeviceError(std::string(kService) + ": " + error.what());
  }
}

// A page of the vendor's has HTTP at the port of the WebSocket, another at the one before.
haply::Version version_of_service(const haply::Address& address) {
  std::string first;
  for (const int port : {address.port, address.port - 1}) {
    if (port < 1) continue;
    try {
      return haply::version_of(haply::http_get({address.host, port}, "/version", kHttp));
    } catch (const haply::Unexpected&) {
      throw;
    } catch (const std::runtime_error& error) {
      if (first.empty()) first = error.what();
    }
  }
  throw DeviceError("no Inverse Service answers at " + address.words() + " (" + first +
                    "): start Haply's Inverse Service, or name its " + "address in " + kService);
}

std::string or_unknown(const std::string& text) {
  return text.empty() ? "not said" : text;
}

std::string filters_of(const Inverse3& arm) {
  const auto number = [](const std::optional<double>& value) { return value ? files::shortest(*value) : "not said"; };
  return "force gate gain " + number(arm.gate_gain) + ", damping " + number(arm.damping);
}

}  // namespace

Haply::Haply(const std::string& name, const HaplyOptions& options, Attendant& attendant)
    : options_(options), attendant_(attendant), room_(room_for_words()) {
  try {
    connect(name);
  } catch (const DeviceError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw DeviceError(error.what());
  }
}

Haply::~Haply() {
  if (!frames_) return;
  frames_->end();
  const haply::FrameCount& seen = frames_->count();
  std::string words = "the Inverse Service answered " + std::to_string(seen.frames) + " frames, " + std::to_string(seen.late) +
                      " of them began late; the longest took " + files::shortest(std::round(seen.longest_trip * 100) / 100) +
                      " ms";
  if (seen.unasked > 0) words += "; " + std::to_string(seen.unasked) + " messages came unasked";
  if (seen.says_force)
    words += "; the force that it says it applied differed from the commanded one by at most " +
             files::shortest(std::round(seen.largest_difference * 1000) / 1000) + " N";
  attendant_.report(words);
}

haply::Message Haply::next_message() {
  const Answer answer = socket_->receive(options_.open);
  if (answer.kind == Answer::Kind::late) throw DeviceError("the Inverse Service accepted the connection and said nothing");
  if (answer.kind == Answer::Kind::closed)
    throw DeviceError("the Inverse Service closed the connection (" + socket_->why() + ")");
  return haply::message_of(answer.text);
}

void Haply::connect(const std::string& name) {
  const haply::Address address = service();
  settings_.version = version_of_service(address);
  socket_ = std::make_unique<haply::Socket>(address, options_.open);
  haply::Message message = next_message();
  const std::string configuration = haply::configuration(settings_.version);
  const auto deadline = std::chrono::steady_clock::now() + options_.open;
  bool is_first = true;
  // A device that was just plugged in is listed a moment later.
  while (is_first || message.arms.empty()) {
    if (attendant_.has_left()) throw DeviceError("stopped before the Inverse3 was ready");
    if (!is_first && std::chrono::steady_clock::now() > deadline) break;
    if (!is_first) std::this_thread::sleep_for(kRepeat);
    if (!message.arms.empty() && haply::chosen(message, name).in_use)
      throw DeviceError("another program uses the Inverse3 " + haply::chosen(message, name).id +
                        ": forces of several programs add up, so end the other one");
    const Answer answer = socket_->ask(is_first ? configuration : haply::full_state(), options_.open);
    if (answer.kind != Answer::Kind::message)
      throw DeviceError("the Inverse Service did not answer the session's first message");
    message = haply::message_of(answer.text);
    is_first = false;
  }
  const Inverse3& arm = haply::chosen(message, name);
  if (!arm.basis.empty() && arm.basis != "XYZ")
    throw DeviceError("the Inverse Service's basis: expected XYZ, got " + arm.basis + ": set it so in the service's settings");
  settings_.id = arm.id;
  describe(arm, message.has_grip);
  try {
    const auto sessions = haply::sessions_in(haply::http_get(address, "/sessions", kHttp));
    if (sessions && *sessions > 1)
      attendant_.report(std::to_string(*sessions - 1) +
                        " other sessions of the Inverse Service are open; their forces would be added");
  } catch (const std::runtime_error&) {  // it is only said
  }
}

void Haply::describe(const Inverse3& arm, bool has_grip) {
  model_ = arm.type.empty() ? "Inverse3" : arm.type;
  serial_ = arm.serial.empty() ? arm.id : arm.serial;
  driver_ = "Inverse Service " + settings_.version.text;
  firmware_ = arm.firmware;
  forces_ = "as commanded; the Inverse Service filters and rations them (" + filters_of(arm) + "), which no certificate covers";
  const Limits& limits = arm.type == "minverse" ? kMinverse : kInverse3;
  capabilities_ = {.model = model_,
                   .serial = serial_,
                   .driver = driver_,
                   .firmware = firmware_,
                   .forces = forces_,
                   .workspace_low = Eigen::Vector3f::Constant(-limits.reach),
                   .workspace_high = Eigen::Vector3f::Constant(limits.reach),
                   .resolution = kResolution,
                   .peak_force = limits.peak,
                   .continuous_force = limits.continuous,
                   .latency = true,  // of a frame
                   .paces = true,
                   .buttons = has_grip ? 3 : 0};
  const auto enabled = [](const std::optional<bool>& on) { return !on ? "not said" : *on ? "on" : "off"; };
  attendant_.report("Inverse3 " + files::printable(arm.id) + ": handedness " + files::printable(or_unknown(arm.handedness)) +
                    ", basis " + or_unknown(arm.basis) + ", gravity compensation " + enabled(arm.gravity_compensation) + ", " +
                    filters_of(arm));
}

Fault Haply::failed_with(const std::string& words) noexcept {
  failed_ = true;
  std::snprintf(room_->data(), room_->size(), "%s", words.c_str());
  return fault();
}

std::optional<Fault> Haply::start(double rate) noexcept {
  if (frames_ || failed_) return Fault{"the Inverse3 was started before"};
  settings_.force = options_.force;
  settings_.watchdog_timeout = options_.watchdog_timeout;
  settings_.rate = rate;
  settings_.window = std::max(1, static_cast<int>(rate / 2));
  settings_.rate_tolerance = options_.rate_tolerance;
  settings_.longest_gap = std::chrono::duration<double>(options_.watchdog_timeout).count() / 2;
  try {
    frames_ = std::make_unique<haply::FrameThread>(std::move(socket_), settings_, *room_);
    if (const auto why = why_not_ready()) {
      frames_->end();
      return failed_with(*why);
    }
  } catch (const std::exception& error) {
    return failed_with(error.what());
  }
  first_ = frames_->samples.latest().time;
  return std::nullopt;
}

std::optional<std::string> Haply::why_not_ready() {
  const auto begin = std::chrono::steady_clock::now();
  auto calibrated_at = begin;
  bool has_reported = false;
  for (;;) {
    std::this_thread::sleep_for(kPollFrames);
    if (attendant_.has_left()) return "stopped before the Inverse3 was ready";
    const haply::FrameSample& sample = frames_->samples.latest();
    const auto now = std::chrono::steady_clock::now();
    if (sample.troubled) return std::string(room_->data());
    if (sample.ready) {
      attendant_.report(words_of(*sample.times) + ": " + grade_of(*sample.times));
      return std::nullopt;
    }
    if (sample.time == 0 || sample.calibrated) {
      if (now - calibrated_at <= options_.start) continue;
      return "communication with the Inverse Service is too irregular to send forces: expected " +
             files::shortest(settings_.rate) + " frames a second and no long gap, got " +
             (sample.times ? words_of(*sample.times) : "too few frames") + ": check what else this machine computes";
    }
    if (!has_reported)
      attendant_.report(
          "waiting for the Inverse3's calibration: let the arm go home by itself, or put its grip into the inkwell");
    has_reported = true;
    calibrated_at = now;
    if (now - begin > options_.calibration) return "the Inverse3 is not calibrated";
  }
}

std::int64_t Haply::wait_for_frame(std::int64_t deadline) noexcept {
  if (!frames_) return deadline;
  return frames_->samples.wait_for_another(read_, deadline);
}

ReadResult Haply::read() noexcept {
  if (failed_) return fault();
  if (!frames_) return Fault{"the Inverse3 was not started"};
  const haply::FrameSample& sample = frames_->samples.latest();
  read_ = sample.time;
  state_ = {.calibrated = sample.calibrated, .forces_on = sample.forces_on};
  if (sample.troubled) {
    failed_ = true;
    return fault();
  }
  if (monotonic_now() - sample.time > std::chrono::nanoseconds(options_.watchdog_timeout).count()) {
    failed_ = true;
    return Fault{"no frame of the Inverse3 came in time: the Inverse Service or this machine is too slow"};
  }
  return Reading{.position = (sample.position - kMiddle).cast<float>(),
                 .time = static_cast<double>(sample.time - first_) * 1e-9,
                 .buttons = sample.buttons,
                 .sent = sample.sent};
}

std::optional<Fault> Haply::command(const Eigen::Vector3f& force) noexcept {
  const bool finite = force.allFinite();
  Eigen::Vector3d limited = Eigen::Vector3d::Zero();
  if (finite) limited = shortened(force, static_cast<double>(capabilities_.peak_force)).cast<double>();
  if (frames_) frames_->orders.publish({.force = limited, .time = monotonic_now(), .allowance = allowance_});
  if (!finite) return Fault{"a force that is not finite was commanded"};
  return std::nullopt;
}

std::unique_ptr<Device> open_haply(const std::string& name, Attendant& attendant, Forces forces) {
  return std::make_unique<Haply>(name, HaplyOptions{.force = forces == Forces::as_commanded}, attendant);
}

std::vector<Check> haply_checks(const std::string&) {
  const char* what = "service";
  try {
    const haply::Address address = service();
    return {{what, Grade::ok, "the Inverse Service " + version_of_service(address).text + " answers at " + address.words()}};
  } catch (const std::runtime_error& error) {
    return {{what, Grade::wrong, error.what()}};
  }
}

}  // namespace forceshade::device
