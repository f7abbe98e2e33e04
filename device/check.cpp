// SPDX-License-Identifier: BSD-3-Clause
#include "device/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/simulated/model.h"
#include "text/formatted.h"
#include "text/joined.h"

namespace forceshade::device {
namespace {

constexpr double kRateTolerance = 0.05;
constexpr double kLongestGap = 20;  // ms: a servo loop that waits as long is stopped by its watchdog

std::string numbers_of(std::uint16_t buttons) {
  std::vector<std::string> numbers;
  for (int k = 0; k < std::numeric_limits<std::uint16_t>::digits; ++k)
    if ((buttons >> k & 1) != 0) numbers.push_back(std::to_string(k));
  return joined(numbers, ", ");
}

Check check_rate(const Observed& seen, double rate) {
  const std::string words = formatted("%.1f readings a second over %.2f s; jitter %.3f ms rms, longest gap %.3f ms", seen.rate,
                                      seen.seconds, seen.jitter, seen.longest_gap);
  const std::string drivers =
      seen.state.update_rate > 0 ? formatted("; the driver counts %.0f a second", seen.state.update_rate) : "";
  if (seen.rate == 0) return {"update rate", Grade::wrong, "no reading was newer than the first: the device does not answer"};
  if (std::abs(seen.rate - rate) > kRateTolerance * rate)
    return {"update rate", Grade::wrong, words + drivers + formatted("; expected %.0f within 5 %%", rate)};
  if (seen.longest_gap > kLongestGap)
    return {"update rate", Grade::wrong,
            words + drivers + formatted("; after %.0f ms without a reading a run is stopped", kLongestGap)};
  return {"update rate", Grade::ok, words + drivers};
}

bool is_at_rest(const Observed& seen) {
  return seen.extent.maxCoeff() <= kAtRest;
}

Check check_encoders(const Observed& seen) {
  if (!seen.finite) return {"encoders", Grade::wrong, "a position is not a number"};
  if (!seen.counts_moved) return {"encoders", Grade::unknown, "the device shows none"};
  const auto& [a, b, c] = *seen.counts_moved;
  if (a == 0 && b == 0 && c == 0) {
    if (!is_at_rest(seen)) return {"encoders", Grade::wrong, "the position moved and no count changed"};
    return {"encoders", Grade::ok, "at rest: no count changed; move the arm during the check to see that they count"};
  }
  return {"encoders", Grade::ok,
          formatted("moving: over %lld, %lld and %lld counts", static_cast<long long>(a), static_cast<long long>(b),
                    static_cast<long long>(c))};
}

Check check_kinematics(const Observed& seen, std::string_view model) {
  if (!model_named(model))
    return {"kinematics", Grade::unknown, "the kinematics of the model \"" + std::string(model) + "\" are not known here"};
  if (!seen.kinematics) return {"kinematics", Grade::unknown, "the device shows no joint angles"};
  const std::string words =
      (std::isfinite(seen.kinematics->error)
           ? formatted("positions are at most %.3f mm from where the joint angles put the tip", seen.kinematics->error)
           : std::string("a position or a joint angle is not a number")) +
      (seen.kinematics->left ? ", the turret's angle counted to the left" : "");
  if (seen.kinematics->error <= kKinematicTolerance) return {"kinematics", Grade::ok, words};
  return {"kinematics", Grade::wrong,
          words + formatted("; expected %.0f mm: calibrate, and check that the driver is set up for this model",
                            kKinematicTolerance)};
}

Check check_buttons(const Observed& seen, int buttons) {
  if (buttons == 0) return {"buttons", Grade::unknown, "the device has none"};
  if (seen.pressed == 0 && seen.released == 0)
    return {"buttons", Grade::ok, "none was pressed or released; press them during the check to see them"};
  const auto list = [](std::uint16_t those) { return those == 0 ? std::string("none") : numbers_of(those); };
  return {"buttons", Grade::ok, "pressed: " + list(seen.pressed) + "; released: " + list(seen.released)};
}

Check check_noise(const Observed& seen) {
  if (!is_at_rest(seen))
    return {"noise at rest", Grade::unknown,
            formatted("the arm moved by (%.2f, %.2f, %.2f) mm; leave it at rest during the check", seen.extent.x(),
                      seen.extent.y(), seen.extent.z())};
  return {"noise at rest", Grade::ok,
          formatted("rms (%.4f, %.4f, %.4f) mm, peak to peak (%.4f, %.4f, %.4f) mm", seen.noise.x(), seen.noise.y(),
                    seen.noise.z(), seen.extent.x(), seen.extent.y(), seen.extent.z())};
}

}  // namespace

std::string_view name_of(Grade grade) noexcept {
  switch (grade) {
    case Grade::ok: return "ok";
    case Grade::lacking: return "lacking";
    case Grade::wrong: return "wrong";
    case Grade::unknown: break;
  }
  return "cannot be checked";
}

Check check_name(const DriverFolder& folder, const std::string& name) {
  const char* what = "device names";
  if (!folder.problem.empty()) return {what, Grade::unknown, folder.problem};
  if (folder.names.empty())
    return {what, Grade::wrong, folder.path.string() + " holds none: set the device up with the vendor's set-up program"};
  const std::string words = folder.path.string() + " holds " + joined(folder.names, ", ");
  const bool known = std::find(folder.names.begin(), folder.names.end(), name) != folder.names.end();
  if (!name.empty() && !known) return {what, Grade::wrong, words + ", and not \"" + name + '"'};
  return {what, Grade::ok, words};
}

Check check_nodes(const std::vector<DeviceNode>& nodes) {
  const char* what = "device nodes";
  const auto described = [](const std::vector<DeviceNode>& all) {
    std::vector<std::string> words;
    for (const DeviceNode& node : all) {
      std::string one = node.path + (node.accessible ? " can be read and written" : " cannot be read and written by this user");
      if (!node.accessible && (node.group == "root" || node.group.empty()))
        one += ": only root may; a udev rule has to allow it";
      else if (!node.accessible)
        one += ": join its group with \"sudo adduser $USER " + node.group + "\", then log in again";
      words.push_back(one);
    }
    return joined(words, "; ");
  };
  if (nodes.empty())
    return {what, Grade::unknown,
            "there is no /dev/ttyACM*, /dev/hidraw* or /dev/fw*: the device is not plugged in or not switched on, or is one on "
            "Ethernet"};
  std::vector<DeviceNode> vendors;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(vendors), [](const DeviceNode& node) { return node.vendors; });
  if (vendors.empty()) return {what, Grade::unknown, "none is known to be the vendor's; " + described(nodes)};
  const bool all = std::all_of(vendors.begin(), vendors.end(), [](const DeviceNode& node) { return node.accessible; });
  return {what, all ? Grade::ok : Grade::wrong, described(vendors)};
}

std::vector<Check> phantom_checks(const std::string& name) {
  return {check_name(driver_folder(), name), check_nodes(device_nodes())};
}

Check check_identity(const Capabilities& capabilities) {
  std::vector<std::string> words;
  for (const auto& [what, value] : {std::pair<const char*, std::string_view>{"model", capabilities.model},
                                    {"serial number", capabilities.serial},
                                    {"driver", capabilities.driver},
                                    {"firmware", capabilities.firmware}})
    words.push_back(std::string(what) + ' ' + (value.empty() ? "not given" : std::string(value)));
  return {"device", capabilities.model.empty() ? Grade::wrong : Grade::ok, joined(words, ", ")};
}

std::vector<Check> check_readings(const Observed& seen, const Capabilities& capabilities, double rate) {
  if (seen.fault) return {{"readings", Grade::wrong, seen.fault->words}};
  if (seen.readings == 0) return {{"readings", Grade::wrong, "the device gave none"}};
  const Check calibration = seen.state.calibrated ? Check{"calibration", Grade::ok, "the device is calibrated"}
                                                  : Check{"calibration", Grade::wrong, "the device is not calibrated"};
  return {calibration,
          check_rate(seen, rate),
          check_encoders(seen),
          check_kinematics(seen, capabilities.model),
          check_buttons(seen, capabilities.buttons),
          check_noise(seen)};
}

}  // namespace forceshade::device
