// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply.h"

#include <chrono>
#include <cstdlib>
#include <optional>
#include <utility>

#include "device/frames/framed_device.h"
#include "device/haply/haply_link.h"
#include "device/haply/haply_socket.h"
#include "files/csv.h"
#include "files/printable.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

using haply::Answer;
using haply::Inverse3;
using std::chrono::milliseconds;

constexpr milliseconds kHttp{1000}, kRepeat{1000};
constexpr const char* kService = "FORCESHADE_HAPLY_SERVICE";

// The service says none of these. The boxes are those in which the vendor's tutorials keep their targets. The forces are the
// least that clients use: no continuous ones are published.
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
haply::Version version_of_service(const haply::Address& address, milliseconds longest = kHttp) {
  std::string first;
  for (const int port : {address.port, address.port - 1}) {
    if (port < 1) continue;
    try {
      return haply::version_of(haply::http_get({address.host, port}, "/version", longest));
    } catch (const Error&) {
      throw;
    } catch (const std::runtime_error& error) {
      if (first.empty()) first = error.what();
    }
  }
  throw DeviceError("no Inverse Service answers at " + address.words() + " (" + first +
                    "): start Haply's Inverse Service, or name its " + "address in " + kService);
}

std::string or_unknown(const std::string& text) {
  return text.empty() ? "unknown" : text;
}

std::string filters_of(const Inverse3& arm) {
  const auto number = [](const std::optional<double>& value) { return value ? shortest(*value) : "unknown"; };
  return "force gate gain " + number(arm.gate_gain) + ", damping " + number(arm.damping);
}

FramedDescription description_of(const Inverse3& arm, const haply::Version& version, bool has_grip) {
  const Limits& limits = arm.type == "minverse" ? kMinverse : kInverse3;
  return {.name = "the Inverse3",
          .partner = "the Inverse Service",
          .to_calibrate = "let the arm go home by itself, or put its grip into the inkwell",
          .model = arm.type.empty() ? "Inverse3" : arm.type,
          .serial = arm.serial.empty() ? arm.id : arm.serial,
          .driver = "Inverse Service " + version.text,
          .firmware = arm.firmware,
          .forces = "as commanded; the Inverse Service filters and rations them (" + filters_of(arm) +
                    "), which no certificate covers",
          .capabilities = {.workspace_low = Eigen::Vector3f::Constant(-limits.reach),
                           .workspace_high = Eigen::Vector3f::Constant(limits.reach),
                           .resolution = kResolution,
                           .peak_force = limits.peak,
                           .continuous_force = limits.continuous,
                           .buttons = has_grip ? 3 : 0}};
}

haply::Message first_message(haply::Conversation& service, const FramedOptions& options) {
  const Answer answer = service.receive(options.open);
  if (answer.kind == Answer::Kind::late) throw DeviceError("the Inverse Service accepted the connection and sent nothing");
  if (answer.kind == Answer::Kind::closed)
    throw DeviceError("the Inverse Service closed the connection (" + service.why() + ")");
  return haply::message_of(answer.text);
}

// Begins the session. The service's list of devices, with the one of this name, which no other program uses.
haply::Message begun(haply::Conversation& service, const haply::Version& version, const std::string& name,
                     const FramedOptions& options, const Attendant& attendant) {
  haply::Message message = first_message(service, options);
  const std::string configuration = haply::configuration(version);
  const std::int64_t deadline = system::now() + system::in_ns(options.open);
  bool is_first = true;
  // A device that was just plugged in is listed a moment later.
  while (is_first || message.arms.empty()) {
    if (attendant.has_left()) throw DeviceError("stopped before the Inverse3 was ready");
    if (!is_first && system::now() > deadline) break;
    if (!is_first) system::sleep_for(kRepeat);
    if (!message.arms.empty() && haply::chosen(message, name).in_use)
      throw DeviceError("another program uses the Inverse3 " + haply::chosen(message, name).id +
                        ": forces of several programs add up, so end the other one");
    const Answer answer = service.ask(is_first ? configuration : haply::full_state(), options.open);
    if (answer.kind != Answer::Kind::message)
      throw DeviceError("the Inverse Service did not answer the session's first message");
    message = haply::message_of(answer.text);
    is_first = false;
  }
  return message;
}

void report(const Inverse3& arm, Attendant& attendant) {
  const auto enabled = [](const std::optional<bool>& on) { return !on ? "unknown" : *on ? "on" : "off"; };
  attendant.report("Inverse3 " + files::printable(arm.id) + ": handedness " + files::printable(or_unknown(arm.handedness)) +
                   ", basis " + or_unknown(arm.basis) + ", gravity compensation " + enabled(arm.gravity_compensation) + ", " +
                   filters_of(arm));
}

void report_other_sessions(const haply::Address& address, Attendant& attendant) {
  try {
    const std::string words = haply::words_of_other_sessions(haply::sessions_in(haply::http_get(address, "/sessions", kHttp)));
    if (!words.empty()) attendant.report(words);
  } catch (const std::runtime_error&) {  // only a report
  }
}

}  // namespace

std::unique_ptr<Device> haply::open(std::unique_ptr<Conversation> service, const Version& version, const std::string& name,
                                    const FramedOptions& options, Attendant& attendant) {
  const Message message = begun(*service, version, name, options, attendant);
  const Inverse3& arm = chosen(message, name);
  if (!arm.basis.empty() && arm.basis != "XYZ")
    throw DeviceError("the Inverse Service's basis: expected XYZ, got " + arm.basis + ": set it so in the service's settings");
  if (!arm.altered.empty()) throw DeviceError(arm.altered);
  report(arm, attendant);
  return std::make_unique<FramedDevice>(std::make_unique<Link>(std::move(service), version, arm.id, options),
                                        description_of(arm, version, message.has_grip), options, attendant);
}

std::unique_ptr<Device> open_haply(const std::string& name, const FramedOptions& options, Attendant& attendant) try {
  const haply::Address address = service();
  const haply::Version version = version_of_service(address, options.open);
  auto device = haply::open(std::make_unique<haply::Socket>(address, options.open), version, name, options, attendant);
  report_other_sessions(address, attendant);
  return device;
} catch (const DeviceError&) {
  throw;
} catch (const std::runtime_error& error) {
  throw DeviceError(error.what());
}

std::unique_ptr<Device> open_haply(const std::string& name, Attendant& attendant, Forces forces) {
  return open_haply(name, {.force = forces == Forces::as_commanded}, attendant);
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
