// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply_messages.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <regex>

#include "files/csv.h"
#include "files/printable.h"
#include "text/joined.h"

namespace forceshade::device::haply {
namespace {

using Json = nlohmann::json;
using files::shown;

constexpr double kMillimetre = 1e-3;       // m
constexpr double kReach = 2, kMost = 1e3;  // m, N: beyond these a number has another unit, or is nonsense

Json parsed(std::string_view text) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw Error("the Inverse Service: expected JSON, got " + shown(text));
  return json;
}

// Null where it is not there.
const Json& at(const Json& json, const char* key) {
  static const Json kNothing;
  return json.is_object() && json.contains(key) ? json[key] : kNothing;
}

std::string text_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_string() ? value.get<std::string>() : value.is_number_integer() ? value.dump() : "";
}

std::optional<double> number_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::optional<bool> flag_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt;
}

// None where the key is not there.
std::optional<Eigen::Vector3d> vector_at(const Json& json, const char* key, double most) {
  const Json& value = at(json, key);
  if (value.is_null()) return std::nullopt;
  Eigen::Vector3d vector;
  for (const auto& [axis, name] : {std::pair{0, "x"}, {1, "y"}, {2, "z"}}) {
    const std::optional<double> number = number_at(value, name);
    if (!number || !(std::fabs(*number) <= most))
      throw Error(std::string("the Inverse Service: ") + key + ": expected x, y and z of at most " + shortest(most) + ", got " +
                  shown(value.dump(-1, ' ', true, Json::error_handler_t::replace)));
    vector[axis] = *number;
  }
  return vector;
}

// The parts of a mount or transform that are left out are those of the identity, and so is all of one that is not there.
bool is_identity(const Json& json) {
  constexpr double kNothing = 1e-6;  // m, and of 1: less than any sensor sees
  if (json.is_null()) return true;
  if (!json.is_object()) return false;
  const auto is_all = [&](const char* part, std::initializer_list<const char*> names, double value) {
    const Json& numbers = at(json, part);
    return numbers.is_null() || (numbers.is_object() && std::ranges::all_of(names, [&](const char* name) {
                                   const Json& number = at(numbers, name);
                                   return number.is_null() ||
                                          (number.is_number() && std::fabs(number.get<double>() - value) <= kNothing);
                                 }));
  };
  return is_all("position", {"x", "y", "z"}, 0) && is_all("rotation", {"x", "y", "z"}, 0) &&
         is_all("scale", {"x", "y", "z"}, 1);
}

Inverse3 arm_of(const Json& json) {
  const Json &config = at(json, "config"), &info = at(config, "device_info"), &state = at(json, "state"),
             &status = at(json, "status"), &filters = at(config, "filters");
  Inverse3 arm;
  arm.id = text_at(json, "device_id");
  arm.type = text_at(config, "type");
  arm.serial = text_at(info, "uuid");
  if (arm.id.empty()) throw Error("the Inverse Service: expected a device_id of each Inverse3, got none");
  if (arm.serial.empty()) arm.serial = text_at(config, "extended_device_id");
  arm.firmware = text_at(config, "extended_firmware_version");
  arm.handedness = text_at(config, "handedness");
  const Json& basis = at(config, "basis");
  arm.basis = basis.is_string() ? basis.get<std::string>() : text_at(basis, "permutation");
  arm.gravity_compensation = flag_at(at(config, "gravity_compensation"), "enabled");
  arm.gate_gain = number_at(at(filters, "force_gate"), "gain");
  arm.damping = number_at(at(filters, "damping"), "scalar");
  for (const auto& [where, name] : {std::pair{&config, "mount"}, {&config, "transform"}, {&state, "transform"}})
    if (const Json& its = at(*where, name); arm.altered.empty() && !is_identity(its))
      arm.altered = std::string("the Inverse3's ") + name +
                    ": expected the identity, since forces and positions are the laws' only there, got " +
                    shown(its.dump(-1, ' ', true, Json::error_handler_t::replace)) + ": set it so in the service's settings";
  arm.position = vector_at(state, "cursor_position", kReach);
  if (arm.position) *arm.position /= kMillimetre;
  arm.force = vector_at(state, "current_cursor_force", kMost);
  // Some clients know a number instead, of which 2 and more is calibrated.
  arm.calibrated = flag_at(status, "calibrated").value_or(number_at(status, "calibration_state").value_or(0) >= 2);
  arm.in_use = flag_at(status, "in_use").value_or(false);
  arm.powered = flag_at(status, "power_supply").value_or(true);
  arm.ready = flag_at(status, "ready").value_or(true);
  return arm;
}

// A grip with a wire has one button, one without has three.
std::uint16_t buttons_of(const Json& state) {
  if (flag_at(state, "awake") == false) return 0;
  unsigned buttons = flag_at(state, "button").value_or(false) ? 1U : 0U;
  const Json& several = at(state, "buttons");
  for (const auto& [bit, name] : {std::pair{0U, "a"}, {1U, "b"}, {2U, "c"}})
    if (flag_at(several, name).value_or(false)) buttons |= 1U << bit;
  return static_cast<std::uint16_t>(buttons);
}

// The names of the arms, for a choice.
std::string names_of(const Message& message) {
  return files::printable(joined(message.arms, ", ", &Inverse3::id));
}

}  // namespace

Version version_of(const std::string& answer) {
  const Json json = Json::parse(answer, nullptr, false);
  const Json& data = at(json, "data");
  const std::string text = data.is_null() ? answer : data.dump(-1, ' ', true, Json::error_handler_t::replace);
  static const std::regex number(R"((\d{1,4})\.(\d{1,4})(\.\d{1,6})?)");
  std::smatch found;
  if (!std::regex_search(text, found, number))
    throw Error("the Inverse Service's version: expected a number as 3.5.1, got " + shown(answer));
  Version version{.major = std::stoi(found[1]), .minor = std::stoi(found[2]), .text = found[0]};
  if (version.major != 3 || version.minor < 1)
    throw Error("the Inverse Service's version: expected 3.1 or later, below 4, got " + version.text);
  return version;
}

std::optional<std::size_t> sessions_in(const std::string& answer) {
  const Json json = Json::parse(answer, nullptr, false);
  const Json& list = json.is_array() ? json : at(json, "data");
  return list.is_array() ? std::optional(list.size()) : std::nullopt;
}

std::string words_of_other_sessions(std::optional<std::size_t> sessions) {
  if (sessions.value_or(0) <= 1) return "";
  const std::size_t others = *sessions - 1;
  return others == 1 ? "1 other session of the Inverse Service is open; its forces would be added"
                     : std::to_string(others) + " other sessions of the Inverse Service are open; their forces would be added";
}

Message message_of(std::string_view text) {
  const Json json = parsed(text);
  if (!json.is_object()) throw Error("the Inverse Service: expected a JSON object, got " + shown(text));
  Message message;
  for (const Json& arm : at(json, "inverse3")) message.arms.push_back(arm_of(arm));
  for (const char* kind : {"verse_grip", "wireless_verse_grip", "custom_verse_grip"})
    for (const Json& grip : at(json, kind)) {
      if (!message.has_grip) message.buttons = buttons_of(at(grip, "state"));
      message.has_grip = true;
    }
  return message;
}

const Inverse3& chosen(const Message& message, const std::string& name) {
  if (message.arms.empty()) throw Error("no Inverse3 is connected to the Inverse Service: check its cable and its power");
  if (name.empty() && message.arms.size() == 1) return message.arms.front();
  if (name.empty())
    throw Error("several Inverse3 are connected (" + names_of(message) + "): expected --device haply:ID with one of them");
  for (const Inverse3& arm : message.arms)
    if (name == arm.id || name == arm.serial) return arm;
  throw Error("the Inverse3 " + files::printable(name) + " is not connected; the Inverse Service lists " + names_of(message));
}

std::string configuration(const Version& version) {
  Json configure{{"profile", {{"name", "forceshade:run"}}}};
  if (version.is_new()) configure["basis"] = {{"permutation", "XYZ"}};
  return Json{{"session", {{"configure", configure}, {"force_render_full_state", Json::object()}}}}.dump();
}

std::string full_state() {
  return R"({"session":{"force_render_full_state":{}}})";
}

Frames::Frames(const Version& version, const std::string& id) {
  const std::string head = R"({"inverse3":[{"device_id":)" + Json(id).dump() + R"(,"commands":{)";
  begin_ = head + R"("set_cursor_force":{")" + (version.is_new() ? "vector" : "values") + R"(":{"x":)";
  probe_ = head + R"("probe_position":{}}}]})";
}

std::string Frames::with_force(const Eigen::Vector3d& force) const {
  return begin_ + shortest(force.x()) + ",\"y\":" + shortest(force.y()) + ",\"z\":" + shortest(force.z()) + "}}}}]}";
}

}  // namespace forceshade::device::haply
