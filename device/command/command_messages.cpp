// SPDX-License-Identifier: BSD-3-Clause
#include "device/command/command_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "files/csv.h"
#include "files/json_line.h"

namespace forceshade::device::command {
namespace {

using Json = nlohmann::ordered_json;
using files::KeyReader;

constexpr double kReach = 2000, kMost = 1000;  // mm, N: beyond these a number has another unit, or is nonsense
constexpr int kMostButtons = 16;
constexpr const char *kVersion = "forceshade-device", *kVersionWords = "1, the version of the protocol",
                     *kFlag = "true or false";

bool has(const Json& object, const char* key) {
  return object.contains(key);
}

bool flag_in(const KeyReader& its, const char* key) {
  const Json& value = its.value(key, kFlag);
  if (!value.is_boolean()) its.refuse(key, value, kFlag);
  return value.get<bool>();
}

// A whole number from 0 to most.
int whole_in(const KeyReader& its, const char* key, int most, const std::string& expected) {
  const Json& value = its.value(key, expected);
  if (!value.is_number_integer() || value.get<double>() < 0 || value.get<double>() > most) its.refuse(key, value, expected);
  return value.get<int>();
}

Eigen::Vector3d vector_of(const Json& value, double most, const KeyReader& its, const char* key, const std::string& expected) {
  Eigen::Vector3d vector;
  if (!value.is_array() || value.size() != 3) its.refuse(key, value, expected);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!value[i].is_number() || !(std::fabs(value[i].get<double>()) <= most)) its.refuse(key, value, expected);
    vector[static_cast<Eigen::Index>(i)] = value[i].get<double>();
  }
  return vector;
}

Eigen::Vector3d vector_in(const KeyReader& its, const char* key, double most, const char* unit) {
  const std::string expected =
      "[x, y, z] in " + std::string(unit) + ", three numbers from -" + shortest(most) + " to " + shortest(most);
  return vector_of(its.value(key, expected), most, its, key, expected);
}

void read_workspace(const KeyReader& its, Capabilities& capabilities) {
  constexpr const char* kKey = "workspace_mm";
  static const std::string kExpected =
      "[[x, y, z], [x, y, z]] in mm: the lowest and the highest corner of the box that the arm reaches, within 2000 mm";
  const Json& value = its.value(kKey, kExpected);
  if (!value.is_array() || value.size() != 2) its.refuse(kKey, value, kExpected);
  capabilities.workspace_low = vector_of(value[0], kReach, its, kKey, kExpected).cast<float>();
  capabilities.workspace_high = vector_of(value[1], kReach, its, kKey, kExpected).cast<float>();
  if (!(capabilities.workspace_low.array() < capabilities.workspace_high.array()).all()) its.refuse(kKey, value, kExpected);
}

std::string text_or(const KeyReader& its, const Json& object, const char* key, const std::string& otherwise) {
  return has(object, key) ? its.text(key) : otherwise;
}

}  // namespace

Hello hello_of(const std::string& line) {
  const Json said = files::object_in(line, kWhose);
  const KeyReader its(said, "the program's hello");
  if (const Json& version = its.value(kVersion, kVersionWords); version != 1) its.refuse(kVersion, version, kVersionWords);
  its.expect_no_key_but({kVersion, "name", "workspace_mm", "peak_force_N", "continuous_force_N", "resolution_mm", "buttons",
                         "paces", "serial", "firmware", "forces", "to_calibrate"});
  Hello hello{.description = {.name = "the device", .partner = std::string("the ") + kWhose}};
  FramedDescription& description = hello.description;
  description.model = its.text("name");
  description.driver = "a program, by docs/command-device.md";
  description.serial = text_or(its, said, "serial", "");
  description.firmware = text_or(its, said, "firmware", "");
  description.forces = text_or(its, said, "forces", "as commanded; what the program does with them, no certificate covers");
  description.to_calibrate = text_or(its, said, "to_calibrate", "the program does not say how");
  Capabilities& capabilities = description.capabilities;
  read_workspace(its, capabilities);
  capabilities.peak_force = static_cast<float>(
      its.number("peak_force_N", 1e-3, kMost, "a number of N from 0.001 to 1000: the highest force that the device can give"));
  capabilities.continuous_force = static_cast<float>(
      its.number("continuous_force_N", 1e-3, static_cast<double>(capabilities.peak_force),
                 "a number of N from 0.001 to peak_force_N: the force that it can give for as long as one likes"));
  capabilities.resolution = static_cast<float>(
      its.number("resolution_mm", 1e-6, 10, "a number of mm from 1e-6 to 10: the smallest step it measures"));
  capabilities.buttons = whole_in(its, "buttons", kMostButtons, "a whole number from 0 to 16: how many buttons it has");
  hello.paces = flag_in(its, "paces");
  return hello;
}

std::string line_of(const Eigen::Vector3d& force) {
  return R"({"force_N":[)" + shortest(force.x()) + ',' + shortest(force.y()) + ',' + shortest(force.z()) + "]}";
}

FrameState Answers::state_of(const std::string& line) {
  const Json said = files::object_in(line, kWhose);
  const KeyReader its(said, "the program's answer");
  its.expect_no_key_but({"time_s", "position_mm", "buttons", "calibrated", "forces_on", "applied_N"});
  const double time = its.number("time_s", -1e12, 1e12, "a number of s: when the position was measured, by any clock");
  if (!(time > last_))
    its.refuse("time_s", said.at("time_s"), "a later time than " + shortest(last_) + ", that of the answer before");
  last_ = time;
  FrameState state{.position = vector_in(its, "position_mm", kReach, "mm")};
  const int most = (1 << buttons_) - 1;
  state.buttons = static_cast<std::uint16_t>(whole_in(
      its, "buttons", most, "a whole number from 0 to " + std::to_string(most) + ": bit k is set while button k is down"));
  if (has(said, "calibrated")) state.calibrated = flag_in(its, "calibrated");
  if (has(said, "forces_on")) state.forces_on = flag_in(its, "forces_on");
  if (has(said, "applied_N")) state.applied = vector_in(its, "applied_N", kMost, "N");
  return state;
}

}  // namespace forceshade::device::command
